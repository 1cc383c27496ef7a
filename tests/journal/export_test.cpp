// Tables of a log: columns with units, full precision, every action and event by its name.
#include "engine/journal/export.h"

#include <signal.h>
#include <sys/resource.h>

#include <fstream>
#include <map>

#include "tests/journal/replay_flight.h"

namespace palace {
namespace {

TEST_F(JournalTest, AMapWithoutASiteHasARowWithItsReasonAndItsGrid) {
  TerrainDecision decision;
  auto hazards = std::make_shared<HazardMaps>();
  hazards->geometry = {40, 50, 0.25, -4, 3};
  decision.hazards = hazards;
  decision.selection.none_reason = "71 % slope, 29 % unknown";
  auto writer = LogWriter::Create(folder_ / "map.lcm");
  ASSERT_TRUE(writer->Write(EncodeProposal(decision, {7}, {})).ok());
  ASSERT_TRUE(writer->Close().ok());
  ASSERT_TRUE(ExportCsv(folder_ / "map.lcm", folder_ / "csv", {}).ok());
  std::ifstream table(folder_ / "csv" / "sites.csv");
  std::string head, row, more;
  ASSERT_TRUE(std::getline(table, head) && std::getline(table, row));
  EXPECT_FALSE(std::getline(table, more));
  for (const char* column : {"frames_fused", "unknown_cells", "normal_north", "pixel_x"}) {
    EXPECT_NE(head.find(column), std::string::npos) << column;
  }
  EXPECT_NE(row.find(",40,50,0.25,-4,3,"), std::string::npos) << row;
  EXPECT_NE(row.find("71 % slope, 29 % unknown"), std::string::npos) << row;
}

TEST_F(JournalTest, EveryActionOfEveryOriginIsExportedByItsName) {
  const std::pair<CommandAction, const char*> actions[] = {
      {SetSetting{"slad.max_slope_deg", 8}, "set_setting"},
      {ApplySettings{}, "apply"},
      {DiscardSettings{}, "discard"},
      {SelectSite{3}, "select"},
      {DisarmSite{}, "disarm"},
      {ApproveSite{3, 4}, "approve"},
      {LookAtSite{3, 4, 12}, "look"},
      {TurnApproach{3, 2}, "turn_approach"},
      {RefuseSite{3}, "refuse"},
      {HoldHere{}, "hold"},
      {WaveOff{}, "wave_off"},
      {AcknowledgeAlarm{"gps_error"}, "acknowledge_alarm"},
      {AcknowledgeWaveOff{}, "acknowledge_wave_off"},
      {AddBookmark{"here"}, "bookmark"},
      {AskForCommand{false}, "ask_for_command"},
      {AskForCommand{true}, "take_over"},
      {ReleaseCommand{}, "release_command"},
      {FlyTo{{1, 2, -15}, 0.5}, "fly_to"},
      {SetFlyArea{{{{0, 0}, {20, 0}, {20, 30}}, 25}}, "set_area"},
      {ClearFlyArea{}, "clear_area"},
      {CommandLost{"to the other station"}, "command_lost"}};
  const std::pair<CommandOrigin, const char*> origins[] = {{CommandOrigin::kOperator, "operator"},
                                                           {CommandOrigin::kScript, "script"},
                                                           {CommandOrigin::kReplay, "replay"},
                                                           {CommandOrigin::kStation, "station"}};
  std::vector<std::string> expected;
  auto writer = LogWriter::Create(folder_ / "all.lcm");
  for (const auto& [origin, origin_name] : origins) {
    for (const auto& [action, name] : actions) {
      ASSERT_TRUE(writer->Write(EncodeCommand({origin, action}, {7}, {})).ok());
      expected.push_back(std::string("7,") + origin_name + "," + name + ",");
    }
  }
  ASSERT_TRUE(writer->Close().ok());
  const auto exported = ExportCsv(folder_ / "all.lcm", folder_ / "csv");
  ASSERT_TRUE(exported.ok()) << exported.error().message;
  EXPECT_EQ(exported->left_out, 0u);
  std::ifstream table(folder_ / "csv" / "decisions.csv");
  std::string row;
  std::getline(table, row);
  for (const std::string& begin : expected) {
    ASSERT_TRUE(std::getline(table, row)) << begin;
    EXPECT_EQ(row.substr(0, begin.size()), begin);
  }
  EXPECT_NE(row.find("to the other station"), std::string::npos) << row;
  EXPECT_FALSE(std::getline(table, row));
}

TEST_F(JournalTest, EveryKindOfEventIsExportedByItsName) {
  const char* const names[] = {"state", "site",     "decision", "setting",
                               "alarm", "bookmark", "vehicle",  "fault"};
  auto writer = LogWriter::Create(folder_ / "events.lcm");
  for (std::size_t kind = 0; kind < std::size(names); ++kind) {
    ASSERT_TRUE(writer->Write(EncodeEvent({{7}, static_cast<EventKind>(kind), "x"}, {})).ok());
  }
  ASSERT_TRUE(writer->Close().ok());
  const auto exported = ExportCsv(folder_ / "events.lcm", folder_ / "csv");
  ASSERT_TRUE(exported.ok()) << exported.error().message;
  std::ifstream table(folder_ / "csv" / "events.csv");
  std::string row;
  std::getline(table, row);
  for (const char* name : names) {
    ASSERT_TRUE(std::getline(table, row)) << name;
    EXPECT_EQ(row, std::string("7,") + name + ",x");
  }
}

TEST_F(ReplayTest, ExportsTablesWithUnitsAndFullPrecision) {
  const auto tables = ExportCsv(flight_.log, folder_ / "csv");
  ASSERT_TRUE(tables.ok()) << tables.error().message;
  std::map<std::string, std::uint64_t> rows;
  for (const ExportedTable& table : tables->tables) {
    rows[table.file.filename().string()] = table.rows;
  }
  std::size_t truths = 0;
  std::size_t commands = 0;
  for (const RecordItem& item : flight_.items) {
    truths += item.bundle->truth.size();
    commands += item.commands.size();
  }
  EXPECT_EQ(rows["truth.csv"], truths);
  EXPECT_EQ(rows["decisions.csv"], commands);
  EXPECT_EQ(rows["estimates.csv"], flight_.items.size());
  EXPECT_EQ(rows["sites.csv"], 2 * flight_.items.size());
  EXPECT_EQ(rows["status.csv"], flight_.items.size());
  std::ifstream truth(folder_ / "csv" / "truth.csv");
  std::string header;
  std::string row;
  std::getline(truth, header);
  std::getline(truth, row);
  EXPECT_EQ(header.rfind("time_us,north_m,east_m,down_m,", 0), 0u) << header;
  const std::size_t comma = row.find(',');
  EXPECT_EQ(std::stod(row.substr(comma + 1)), flight_.items[0].bundle->truth[0].X_WB.p.x());
}

/// A table that does not fit has no name: what bears one is whole.
TEST_F(ReplayTest, AFullDiskLeavesNoCutTable) {
  constexpr rlim_t kRoom = 3000;  // bytes a file
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto ignored = signal(SIGXFSZ, SIG_IGN);
  const rlimit small{kRoom, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const auto tables = ExportCsv(flight_.log, folder_ / "csv");
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, ignored);
  ASSERT_FALSE(tables.ok());
  EXPECT_NE(tables.error().message.find(".csv; choose a folder"), std::string::npos)
      << tables.error().message;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "csv")) {
    EXPECT_EQ(entry.path().extension(), ".csv");
    EXPECT_LT(entry.file_size(), kRoom) << entry.path();
  }
}

}  // namespace
}  // namespace palace
