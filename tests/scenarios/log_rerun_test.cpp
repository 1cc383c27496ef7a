// palacectl log rerun: a log becomes tables and maps, decided to the bit as in flight.
#include <map>
#include <string>
#include <vector>

#include "engine/core/hash.h"
#include "tests/scenarios/csv_table.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr double kLimit_s = 120;

class LogRerun : public Scenario {
 protected:
  /// Some seconds of a flight up to its first sites, on disk as records/<stamp>/flight.lcm.
  std::filesystem::path Fly() {
    WriteFile("look.script", "wait state PROPOSED 20\nset slad.max_slope_deg 9\nwait seconds 1\n");
    const ProcessResult flight = RunProcess(
        Palace({"--headless", "--seed", "3", "--record", "records", "--script", "look.script"}),
        kLimit_s);
    EXPECT_EQ(flight.exit_code, 0) << flight.err;
    const auto flights = FlightsIn(folder_ / "records");
    EXPECT_EQ(flights.size(), 1u);
    return flights.empty() ? folder_ : flights.front() / "flight.lcm";
  }
  ProcessResult Rerun(const std::filesystem::path& log, std::vector<std::string> more) {
    std::vector<std::string> words = {"log", "rerun", log.string()};
    words.insert(words.end(), more.begin(), more.end());
    return RunProcess(Palacectl(words), kLimit_s);
  }
};

TEST_F(LogRerun, AnExportOfALogWithoutDecisionsSaysSoAndHowToDecide) {
  const ProcessResult flown = RunProcess(
      Palacectl({"simulate", "--log", "vehicle.lcm", "--fast", "--duration-s", "2"}), kLimit_s);
  ASSERT_EQ(flown.exit_code, 0) << flown.err;
  const ProcessResult exported =
      RunProcess(Palacectl({"log", "export", "vehicle.lcm", "--out", "csv"}), kLimit_s);
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_NE(exported.out.find("no maps, sites or decisions"), std::string::npos) << exported.out;
  EXPECT_NE(exported.out.find("palacectl log rerun vehicle.lcm"), std::string::npos);
}

TEST_F(LogRerun, ALogThatGivesNoMapSaysWhyAndIsNoSuccess) {
  ASSERT_EQ(
      RunProcess(Palacectl({"simulate", "--log", "vehicle.lcm", "--fast", "--duration-s", "1"}),
                 kLimit_s)
          .exit_code,
      0);
  WriteFile("exchanged.toml",
            "[channels]\ncamera_left = \"CAMERA_RIGHT\"\ncamera_right = \"CAMERA_LEFT\"\n");
  const ProcessResult blind = Rerun("vehicle.lcm", {"--out", "no", "--channels", "exchanged.toml"});
  EXPECT_EQ(blind.exit_code, 1) << blind.out;
  EXPECT_NE(blind.err.find("no frame gave a map, so nothing was decided: "), std::string::npos);
  EXPECT_NE(blind.err.find(" frames: Left and right camera look exchanged"), std::string::npos)
      << blind.err;
}

TEST_F(LogRerun, DecidesAsInFlightAndWritesEverySiteAndMap) {
  const std::filesystem::path log = Fly();
  const ProcessResult same = Rerun(log, {"--out", "same", "--maps", "every 0.5 s"});
  ASSERT_EQ(same.exit_code, 0) << same.err;
  const CsvTable decisions = ReadTable(folder_ / "same/decisions.csv");
  ASSERT_GT(decisions.size(), 10u);
  for (const auto& row : decisions) {
    EXPECT_EQ(row.at("same"), "1") << row.at("time_us");
    EXPECT_EQ(row.at("decision_hash"), row.at("recorded_decision_hash"));
  }
  // The maps of the flight, as it recorded them, by their hashes.
  ASSERT_EQ(
      RunProcess(Palacectl({"log", "export", log.string(), "--out", "csv"}), kLimit_s).exit_code,
      0);
  std::map<std::string, std::string> flown;
  for (const auto& row : ReadTable(folder_ / "csv/sites.csv")) {
    flown[row.at("time_us") + "/" + row.at("rank")] = row.at("map_hash") + row.at("letter");
  }
  std::size_t compared = 0;
  for (const auto& row : ReadTable(folder_ / "same/sites.csv")) {
    const auto it = flown.find(row.at("time_us") + "/" + row.at("rank"));
    if (it != flown.end()) {
      EXPECT_EQ(row.at("map_hash") + row.at("letter"), it->second) << row.at("time_us");
      ++compared;
    }
  }
  EXPECT_GT(compared, 10u);
  const CsvTable maps = ReadTable(folder_ / "same/maps.csv");
  ASSERT_GT(maps.size(), 2u);
  for (const auto& row : maps) {
    EXPECT_GE(std::stoi(row.at("rows")), 100);  // as many as the view needs
    EXPECT_TRUE(std::filesystem::exists(folder_ / "same" / (row.at("stem") + "_elevation.tif")));
  }
  const ProcessResult read =
      RunProcess(Palacectl({"analyze", "--elevation",
                            "same/" + maps.back().at("stem") + "_elevation.tif", "--out", "again"}),
                 kLimit_s);
  EXPECT_EQ(read.exit_code, 0) << read.err;
}

/// The hash of the limits that a replay in palace judged under, in the digits of its report.
std::string HashOfReport(const std::filesystem::path& report) {
  std::ifstream file(report);
  std::stringstream text;
  text << file.rdbuf();
  const std::string heading = "Limits in force, ";
  const std::size_t at = text.str().find(heading);
  return at == std::string::npos ? "" : text.str().substr(at + heading.size(), ShortHash(0).size());
}

TEST_F(LogRerun, AndAReplayOfTheWindowJudgeUnderTheSameLimits) {
  WriteFile("look.script", "wait state PROPOSED 20\nquit\n");
  // The flight itself began with other limits than the built-in ones.
  const ProcessResult flight =
      RunProcess(Palace({"--headless", "--seed", "3", "--record", "records", "--script",
                         "look.script", "--set", "slad.max_step_m=0.12"}),
                 kLimit_s);
  ASSERT_EQ(flight.exit_code, 0) << flight.err;
  const std::string log = (FlightsIn(folder_ / "records").front() / "flight.lcm").string();
  const ProcessResult rerun = Rerun(log, {"--out", "again", "--set", "slad.max_slope_deg=6"});
  ASSERT_EQ(rerun.exit_code, 0) << rerun.err;
  WriteFile("watch.script", "wait state PROPOSED 20\nquit\n");
  const ProcessResult window =
      RunProcess(Palace({"--headless", "--replay", log, "--record", "shown", "--script",
                         "watch.script", "--set", "slad.max_slope_deg=6"}),
                 kLimit_s);
  ASSERT_EQ(window.exit_code, 0) << window.err;
  Settings both;
  both.slad.limits.max_step_m = 0.12;
  both.slad.limits.max_slope_deg = 6;
  EXPECT_EQ(ReadTable(folder_ / "again/decisions.csv").back().at("settings_hash"),
            std::to_string(HashOf(both)));
  EXPECT_EQ(HashOfReport(FlightsIn(folder_ / "shown").front() / "report.html"),
            ShortHash(HashOf(both)));
}

TEST_F(LogRerun, OtherLimitsSayWhyThereIsNoSite) {
  const std::filesystem::path log = Fly();
  const ProcessResult steep =
      Rerun(log, {"--out", "steep", "--set", "slad.max_slope_deg=0.5", "--maps", "last"});
  ASSERT_EQ(steep.exit_code, 0) << steep.err;
  EXPECT_NE(steep.out.find("(settings were changed)"), std::string::npos) << steep.out;
  std::size_t without = 0;
  for (const auto& row : ReadTable(folder_ / "steep/sites.csv")) {
    without += row.at("rank").empty() && row.at("reason") != "" ? 1 : 0;
  }
  EXPECT_GT(without, 3u);
  EXPECT_EQ(ReadTable(folder_ / "steep/maps.csv").size(), 1u);
}

TEST_F(LogRerun, RefusesWhatItCannotDoAndLeavesNothing) {
  const auto log = WriteFile("not_a.log", "this is no log");
  const struct {
    std::vector<std::string> words;
    int exit_code;
    const char* says;
  } kTable[] = {
      {{"--out", "o", "--maps", "often"}, 2, "every N s"},
      {{"--out", "o", "--maps", "every -1 s"}, 2, "0.1 to 3600"},
      {{"--out", "o", "--maps", "every nan s"}, 2, "0.1 to 3600"},
      {{"--out", "o"}, 1, "not_a.log"},
  };
  for (const auto& row : kTable) {
    const ProcessResult result = Rerun(log, row.words);
    EXPECT_EQ(result.exit_code, row.exit_code) << result.err;
    EXPECT_NE(result.err.find(row.says), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "o"));
  }
}

}  // namespace
}  // namespace palace
