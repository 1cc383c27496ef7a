// A recorded flight replays to equal bundles with the commands that came before each.
#include <chrono>
#include <thread>

#include "engine/journal/export.h"
#include "engine/journal/log_tools.h"
#include "engine/journal/replay_source.h"
#include "engine/wire/convert.h"
#include "tests/journal/journal_world.h"

namespace palace {
namespace {

class ReplayTest : public JournalTest {
 protected:
  ReplayTest() : flight_(RecordFlight(folder_, 12, 61)) {}
  std::unique_ptr<ReplaySource> Open(ReplayOptions options) {
    auto source = ReplaySource::Open(flight_.log, options);
    EXPECT_TRUE(source.ok()) << source.error().message;
    return std::move(*source);
  }
  static ReplayOptions Fast() {
    ReplayOptions options;
    options.speed = 0;
    return options;
  }
  RecordedFlight flight_;
};

std::vector<std::vector<std::uint8_t>> Payloads(const FrameBundle& bundle) {
  std::vector<std::vector<std::uint8_t>> payloads;
  for (WireMessage& message : EncodeBundle(bundle, {})) {
    payloads.push_back(std::move(message.payload));
  }
  return payloads;
}

TEST_F(ReplayTest, GivesTheBundlesThatWereRecorded) {
  const auto source = Open(Fast());
  EXPECT_TRUE(source->IsLockstep());
  for (const RecordItem& item : flight_.items) {
    const auto got = source->Next({});
    ASSERT_TRUE(got.ok()) << got.error().message;
    EXPECT_EQ(Payloads(**got), Payloads(*item.bundle));
    EXPECT_FALSE((*got)->discontinuity);
    ASSERT_EQ((*got)->recorded_commands.size(), item.commands.size());
    for (std::size_t i = 0; i < item.commands.size(); ++i) {
      EXPECT_EQ((*got)->recorded_commands[i].origin, item.commands[i].origin);
      EXPECT_EQ(EncodeCommand((*got)->recorded_commands[i], {}, {}).payload,
                EncodeCommand(item.commands[i], {}, {}).payload);
    }
  }
  EXPECT_EQ(source->Next({}).error().code, ErrorCode::kEnd);
  EXPECT_TRUE(source->Status().ended);
  EXPECT_EQ(source->Status().damage, "");
}

TEST_F(ReplayTest, TellsWhatTheFlightDecided) {
  const auto record = Open(Fast())->recorded();
  ASSERT_EQ(record->samples.size(), flight_.items.size());
  for (std::size_t i = 0; i < record->samples.size(); ++i) {
    const EngineSnapshot& snapshot = *flight_.items[i].snapshot;
    EXPECT_EQ(record->samples[i].state, snapshot.flight->mission.state);
    EXPECT_EQ(record->samples[i].decision_hash, snapshot.decision_hash);
    EXPECT_EQ(record->samples[i].best_site, "C");
  }
  EXPECT_EQ(record->events.size(), flight_.items.size());
  EXPECT_TRUE(record->has_settings);
  ASSERT_EQ(record->settings.size(), 1u);
  EXPECT_EQ(record->settings[0].settings, record->settings_at_start);
  EXPECT_EQ(record->settings_at_start, flight_.items[0].snapshot->session->settings);
  EXPECT_NEAR(record->duration_s, 1.1, 1e-9);
}

TEST_F(ReplayTest, SeeksAndMarksTheJump) {
  const auto source = Open(Fast());
  struct Case {
    double seek_s;
    std::size_t bundle;
  };
  for (const Case& c : {Case{0.5, 5}, Case{0.0, 0}, Case{0.95, 10}, Case{99, 11}, Case{-3, 0}}) {
    SCOPED_TRACE(c.seek_s);
    source->Control({PlaybackControl::Kind::kSeek, c.seek_s});
    const auto got = source->Next({});
    ASSERT_TRUE(got.ok());
    EXPECT_TRUE((*got)->discontinuity);
    FrameBundle recorded = *flight_.items[c.bundle].bundle;
    recorded.discontinuity = true;
    EXPECT_EQ(Payloads(**got), Payloads(recorded));
    EXPECT_EQ((*got)->recorded_commands.size(), flight_.items[c.bundle].commands.size());
    if (c.bundle + 1 < flight_.items.size()) {
      const auto next = source->Next({});
      EXPECT_FALSE((*next)->discontinuity);
      EXPECT_EQ((*next)->sequence, c.bundle + 1);
    }
  }
}

TEST_F(ReplayTest, StepsBothWaysWhilePaused) {
  ReplayOptions options = Fast();
  options.paused = true;
  const auto source = Open(options);
  const auto step = [&](PlaybackControl::Kind kind) {
    source->Control({kind, 0});
    return (*source->Next({}))->sequence;
  };
  using Kind = PlaybackControl::Kind;
  EXPECT_EQ(step(Kind::kStepForward), 0u);
  EXPECT_EQ(step(Kind::kStepForward), 1u);
  EXPECT_EQ(step(Kind::kStepForward), 2u);
  EXPECT_EQ(step(Kind::kStepBack), 1u);
  EXPECT_EQ(step(Kind::kStepBack), 0u);
  EXPECT_EQ(step(Kind::kStepBack), 0u);
  EXPECT_EQ(step(Kind::kStepForward), 1u);
  EXPECT_TRUE(source->Status().paused);
}

TEST_F(ReplayTest, PausedNextWaitsUntilToldOrStopped) {
  ReplayOptions options = Fast();
  options.paused = true;
  options.wait_at_end = true;
  const auto source = Open(options);
  std::stop_source stop;
  Result<std::shared_ptr<const FrameBundle>> got = InvalidError("nothing yet");
  std::jthread reader([&] { got = source->Next(stop.get_token()); });
  stop.request_stop();
  reader.join();
  EXPECT_EQ(got.error().code, ErrorCode::kEnd);
  std::jthread player([&] { source->Control({PlaybackControl::Kind::kPlay, 0}); });
  for (std::size_t i = 0; i < flight_.items.size(); ++i) {
    ASSERT_TRUE(source->Next({}).ok());
  }
  std::jthread seeker([&] { source->Control({PlaybackControl::Kind::kSeek, 0.3}); });
  const auto again = source->Next({});  // waits at the end until the seek
  ASSERT_TRUE(again.ok());
  EXPECT_EQ((*again)->sequence, 3u);
}

TEST_F(ReplayTest, SaysThatItEndedAndPlaysFromTheStartAgain) {
  ReplayOptions options = Fast();
  options.wait_at_end = true;
  const auto source = Open(options);
  for (std::size_t i = 0; i < flight_.items.size(); ++i) {
    EXPECT_FALSE(source->Status().ended);
    ASSERT_TRUE(source->Next({}).ok());
  }
  EXPECT_TRUE(source->Status().ended) << "with the last bundle, not when somebody asks for more";
  source->Control({PlaybackControl::Kind::kPlay, 0});
  EXPECT_FALSE(source->Status().ended);
  const auto first = source->Next({});
  ASSERT_TRUE(first.ok());
  EXPECT_EQ((*first)->sequence, 0u);
}

TEST_F(ReplayTest, TellsGapsAndWhatEachMapProposed) {
  auto record = Open(Fast())->recorded();
  EXPECT_TRUE(record->gaps.empty());
  ASSERT_FALSE(record->proposals.empty());
  const auto& sites = flight_.items[0].snapshot->terrain->applied->selection.sites;
  ASSERT_EQ(record->proposals[0].places.size(), sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_EQ(record->proposals[0].places[i].letter, sites[i].letter);
    EXPECT_EQ(record->proposals[0].places[i].id, sites[i].id);
    EXPECT_EQ(record->proposals[0].places[i].north_east_m, sites[i].p_WS.head<2>());
  }
}

TEST_F(ReplayTest, KeepsTheRecordedPace) {
  ReplayOptions options;
  options.speed = 10;  // 1.1 s of data in 0.11 s
  const auto source = Open(options);
  const auto start = std::chrono::steady_clock::now();
  while (source->Next({}).ok()) {
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_GE(took.count(), 0.10);
}

TEST_F(ReplayTest, TellsThatALogIsCut) {
  EXPECT_EQ(Open(Fast())->Status().damage, "");
  const auto bytes = std::filesystem::file_size(flight_.log);
  std::filesystem::resize_file(flight_.log, bytes * 6 / 10);
  EXPECT_NE(Open(Fast())->Status().damage, "");
}

TEST_F(ReplayTest, SkipsADamagedPictureAndGoesOn) {
  auto bytes = ReadBytes(flight_.log);
  const auto index = BuildIndex(*LogFile::Open(flight_.log));
  std::size_t pictures = 0;
  for (const LogEntry& entry : index->entries) {
    if (index->channels[entry.channel] == "CAMERA_RIGHT" && ++pictures == 4) {
      bytes[entry.offset + 200] ^= 1;
    }
  }
  WriteBytes(flight_.log, bytes);
  const auto source = Open(Fast());
  int with = 0;
  int bundles = 0;
  for (auto got = source->Next({}); got; got = source->Next({})) {
    ++bundles;
    with += (*got)->stereo ? 1 : 0;
  }
  EXPECT_EQ(bundles, 12);
  EXPECT_EQ(with, 11);
  EXPECT_EQ(source->Status().damage, "1 not decoded so far");
}

// Seconds of two clocks have no common timeline.
TEST_F(JournalTest, OfALogInWhichTheVehicleRestartedEachPartIsPlayedByItself) {
  const RecordedFlight flight = RecordFlight(folder_, 30, 65, /*restart=*/18);
  struct Case {
    int part;
    int played;
    std::size_t first, bundles;
  };
  for (const Case& c : {Case{0, 1, 0, 18}, Case{1, 1, 0, 18}, Case{2, 2, 18, 12}}) {
    SCOPED_TRACE(c.part);
    ReplayOptions options;
    options.speed = 0;
    options.part = c.part;
    const auto source = ReplaySource::Open(flight.log, options);
    ASSERT_TRUE(source.ok()) << source.error().message;
    const SourceStatus status = (*source)->Status();
    EXPECT_EQ(status.part, c.played);
    EXPECT_EQ(status.parts, 2);
    EXPECT_EQ(status.frame_count, c.bundles);
    EXPECT_NEAR(*status.duration_s, 0.1 * static_cast<double>(c.bundles - 1), 1e-9);
    const auto record = (*source)->recorded();
    EXPECT_EQ(record->samples.size(), c.bundles);
    EXPECT_TRUE(record->has_settings);  // those of the first part go on
    EXPECT_EQ(record->settings_at_start, flight.items[0].snapshot->session->settings);
    EXPECT_EQ(record->settings.front().from, (*source)->bundles().front().time);
    for (std::size_t i = 0; i < c.bundles; ++i) {
      const auto got = (*source)->Next({});
      ASSERT_TRUE(got.ok()) << got.error().message;
      EXPECT_EQ(Payloads(**got), Payloads(*flight.items[c.first + i].bundle));
    }
    EXPECT_EQ((*source)->Next({}).error().code, ErrorCode::kEnd);
    (*source)->Control({PlaybackControl::Kind::kSeek, 0.5});
    EXPECT_EQ((*(*source)->Next({}))->time, flight.items[c.first + 5].bundle->time);
  }
  ReplayOptions none;
  none.part = 3;
  const auto refused = ReplaySource::Open(flight.log, none);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("parts 1 to 2"), std::string::npos)
      << refused.error().message;
  const auto described = DescribeLog(flight.log, false);
  ASSERT_TRUE(described.ok());
  ASSERT_EQ(described->parts.size(), 2u);
  EXPECT_NEAR(described->parts[1].duration_s, 1.1, 1e-9);
}

TEST_F(ReplayTest, LogWithoutBundlesSaysWhatItNeeds) {
  auto writer = LogWriter::Create(folder_ / "imu.lcm");
  ASSERT_TRUE(writer->Write({"IMU", {5}, {1, 2, 3}}).ok());
  ASSERT_TRUE(writer->Close().ok());
  const auto source = ReplaySource::Open(folder_ / "imu.lcm");
  ASSERT_FALSE(source.ok());
  EXPECT_NE(source.error().message.find("needs CAMERA_RIG"), std::string::npos)
      << source.error().message;
}

TEST_F(JournalTest, WhatWasGivenAndSentBetweenFramesIsInTheLog) {
  RandomStream random(62);
  const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
  auto recorder = FlightRecorder::Open(folder_, "flight");
  ASSERT_TRUE(recorder.ok());
  const auto between = [](std::uint64_t number) {
    RecordItem item;
    item.commands = {{CommandOrigin::kOperator, HoldHere{}}};
    item.sent.emplace_back(HoldRequest{number, "Held by the operator"});
    return item;
  };
  RecordItem frame;
  frame.bundle = RandomBundle(random, 0, rig);
  ASSERT_TRUE((*recorder)->Record(frame).ok());
  ASSERT_TRUE((*recorder)->Record(between(1)).ok());
  frame.bundle = RandomBundle(random, 1, rig);
  ASSERT_TRUE((*recorder)->Record(frame).ok());
  ASSERT_TRUE((*recorder)->Record(between(2)).ok());
  ASSERT_TRUE((*recorder)->Close().ok());
  auto log = LogFile::Open((*recorder)->Path());
  ASSERT_TRUE(log.ok());
  const auto index = BuildIndex(*log);
  ASSERT_TRUE(index.ok());
  std::string order;
  std::vector<std::uint64_t> holds;
  for (const LogEntry& entry : index->entries) {
    const auto message = ReadEvent(*log, entry, index->channels);
    ASSERT_TRUE(message.ok());
    if (message->channel == ChannelNames{}.camera_rig) {
      order += "frame ";
    } else if (message->channel == ChannelNames{}.site_decision) {
      order += "command ";
    } else if (message->channel == ChannelNames{}.command) {
      order += "sent ";
      holds.push_back(std::get<HoldRequest>(DecodeVehicleMessage(*message, {}).value()).command_id);
    }
  }
  EXPECT_EQ(order, "frame command sent frame command sent ");
  EXPECT_EQ(holds, (std::vector<std::uint64_t>{1, 2}));
}

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
      {RefuseSite{3}, "refuse"},
      {HoldHere{}, "hold"},
      {WaveOff{}, "wave_off"},
      {AcknowledgeAlarm{"gps_error"}, "acknowledge_alarm"},
      {AcknowledgeWaveOff{}, "acknowledge_wave_off"},
      {AddBookmark{"here"}, "bookmark"},
      {AskForCommand{false}, "ask_for_command"},
      {AskForCommand{true}, "take_over"},
      {ReleaseCommand{}, "release_command"},
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

/// One byte of a message differs under a sidecar that fits: nothing but the checksum tells.
TEST_F(JournalTest, WhatDiffersFromItsChecksumIsCountedByWhoeverLeavesItOut) {
  const std::filesystem::path log = folder_ / "bit.lcm";
  auto writer = LogWriter::Create(log);
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(writer->Write(EncodeEvent({{1'000'000 * (i + 1)}, EventKind::kState, "x"}, {})));
  }
  ASSERT_TRUE(writer->Close().ok());
  auto bytes = ReadBytes(log);
  bytes[bytes.size() - 2] ^= 1;  // the text of the last
  WriteBytes(log, bytes);
  const auto exported = ExportCsv(log, folder_ / "csv");
  ASSERT_TRUE(exported.ok()) << exported.error().message;
  EXPECT_EQ(exported->left_out, 1u);
  const auto repaired = RepairLog(log, folder_ / "repaired.lcm");
  ASSERT_TRUE(repaired.ok()) << repaired.error().message;
  EXPECT_EQ(repaired->events, 29u);
  EXPECT_EQ(repaired->left_out, 1u);
  const auto end = CutLog(log, folder_ / "end.lcm", 20, 100);
  EXPECT_EQ(end->left_out, 1u);
  const auto start = CutLog(log, folder_ / "start.lcm", 0, 10);
  EXPECT_EQ(start->left_out, 0u) << "only what was asked for";
}

TEST_F(JournalTest, UnwritableFolderLeavesNothingBehind) {
  WriteBytes(folder_ / "file", {1});
  const auto recorder = FlightRecorder::Open(folder_ / "file", "flight");
  ASSERT_FALSE(recorder.ok());
  EXPECT_EQ(recorder.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(recorder.error().message.find("--record DIR"), std::string::npos);
  const auto first = FlightRecorder::Open(folder_, "same");
  ASSERT_TRUE(first.ok());
  EXPECT_FALSE(FlightRecorder::Open(folder_, "same").ok());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "same" / "flight.lcm"));
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

TEST_F(ReplayTest, CutKeepsWholeBundlesAndReplays) {
  const auto cut = CutLog(flight_.log, folder_ / "cut.lcm", 0.35, 0.75);
  ASSERT_TRUE(cut.ok()) << cut.error().message;
  auto source = ReplaySource::Open(folder_ / "cut.lcm", Fast());
  ASSERT_TRUE(source.ok()) << source.error().message;
  ASSERT_EQ((*source)->bundles().size(), 4u);
  for (std::size_t i = 4; i < 8; ++i) {
    const auto got = (*source)->Next({});
    EXPECT_EQ(Payloads(**got), Payloads(*flight_.items[i].bundle));
  }
}

TEST_F(ReplayTest, RepairKeepsEveryReadableEvent) {
  auto bytes = ReadBytes(flight_.log);
  const std::size_t events = BuildIndex(*LogFile::Open(flight_.log))->entries.size();
  bytes.resize(bytes.size() - 5);
  bytes.insert(bytes.begin(), 50, 0x11);
  WriteBytes(folder_ / "broken.lcm", bytes);
  const auto written = RepairLog(folder_ / "broken.lcm", folder_ / "whole.lcm");
  ASSERT_TRUE(written.ok()) << written.error().message;
  EXPECT_EQ(written->events, events - 1);
  EXPECT_EQ(written->left_out, 0u) << "what is no event any more is said by the check of the log";
  const auto index = VerifyLog(*LogFile::Open(folder_ / "whole.lcm"));
  EXPECT_EQ(index->entries.size(), events - 1);
  EXPECT_FALSE(index->report.damaged());
}

TEST_F(ReplayTest, DescribesALogAndItsHealth) {
  const auto whole = DescribeLog(flight_.log, true);
  ASSERT_TRUE(whole.ok());
  EXPECT_FALSE(whole->report.damaged());
  EXPECT_EQ(whole->bundles, 12u);
  EXPECT_NEAR(whole->duration_s, 1.1, 1e-9);
  bool found = false;
  for (const ChannelSummary& row : whole->channels) {
    found = found || (row.name == "CAMERA_LEFT" && row.events == 12);
  }
  EXPECT_TRUE(found);
}

/// Forty bundles, 0.1 s apart. B is refused in number 1; a refusal in number 3 is not taken. A is
/// selected in number 2 and approved in number 5; from number 7 on the vehicle stands on the ground
/// and no map is made. From number 10 to 29 bundles come in which nothing was heard.
class LandedFlight : public JournalTest {
 protected:
  static constexpr int kBundles = 40;
  LandedFlight() {
    RandomStream random(71);
    const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
    auto recorder = FlightRecorder::Open(folder_, "flight", {});
    EXPECT_TRUE(recorder.ok());
    auto events = std::make_shared<std::vector<Event>>();
    for (int i = 0; i < kBundles; ++i) {
      RecordItem item;
      auto bundle = RandomBundle(random, static_cast<std::uint64_t>(i), rig);
      if (i >= 10 && i < 30) {
        bundle->stereo = nullptr;
        bundle->pose_at_exposure.reset();
        bundle->poses.clear();
        bundle->imu.clear();
        bundle->truth.clear();
        bundle->laser.clear();
        bundle->gps.clear();
        bundle->status.reset();
      }
      const auto say = [&](const char* text) {
        events->push_back({bundle->time, EventKind::kDecision, text, events->size() + 1});
      };
      if (i == 1) {
        item.commands.push_back({CommandOrigin::kOperator, RefuseSite{2}});
        say("Site B refused by the operator");
      } else if (i == 2) {
        item.commands.push_back({CommandOrigin::kOperator, SelectSite{1}});
      } else if (i == 3) {
        item.commands.push_back({CommandOrigin::kOperator, RefuseSite{1}});
        say("Refuse refused: No site is proposed");
      } else if (i == 5) {
        item.commands.push_back({CommandOrigin::kOperator, ApproveSite{1, 4}});
        say("Site A approved");
      }
      auto snapshot = std::make_shared<EngineSnapshot>(RandomSnapshot(random, *bundle));
      auto decision = std::make_shared<TerrainDecision>(*snapshot->terrain->applied);
      decision->selection.sites[0].id = 1;
      decision->selection.sites[1].id = 2;
      decision->selection.sites[0].p_WS = p_WS_;
      decision->map_time = i < 7 ? bundle->time : map_time_;
      decision->map_hash = 5;
      map_time_ = decision->map_time;
      snapshot->terrain.Edit().applied = decision;
      MissionStatus& mission = snapshot->flight.Edit().mission;
      mission.state = i < 2   ? MissionState::kProposed
                      : i < 5 ? MissionState::kArmed
                      : i < 7 ? MissionState::kDescending
                              : MissionState::kLanded;
      mission.distance_to_site_m = 0.1 * i;
      snapshot->session.Edit().events = std::make_shared<const std::vector<Event>>(*events);
      if (i == 7) {
        const Eigen::Vector3d skid_W =
            bundle->truth.back().X_WB * Settings{}.slad.lander.skid_centre_B();
        true_miss_m_ = (skid_W - p_WS_).head<2>().norm();
      }
      item.bundle = bundle;
      item.snapshot = snapshot;
      times_.push_back(bundle->time);
      EXPECT_TRUE((*recorder)->Record(item).ok());
    }
    EXPECT_TRUE((*recorder)->Close().ok());
    auto source = ReplaySource::Open((*recorder)->Path());
    EXPECT_TRUE(source.ok());
    record_ = (*source)->recorded();
  }
  const Eigen::Vector3d p_WS_{1, 2, 0};
  Timestamp map_time_;
  double true_miss_m_ = NAN;
  std::vector<Timestamp> times_;
  std::shared_ptr<const FlightRecord> record_;
};

TEST_F(LandedFlight, TellsItsTouchdownByTheStationAndByTruth) {
  ASSERT_EQ(record_->touchdowns.size(), 1U);
  EXPECT_EQ(record_->touchdowns[0].time, times_[7]);
  EXPECT_NEAR(record_->touchdowns[0].miss_m, 0.7, 1e-12);
  EXPECT_NEAR(record_->touchdowns[0].true_miss_m, true_miss_m_, 1e-9);
}

TEST_F(LandedFlight, TellsWhatTheOperatorRefusedAndTheStationTook) {
  ASSERT_EQ(record_->refusals.size(), 1U);
  EXPECT_EQ(record_->refusals[0].from, times_[1]);
  EXPECT_EQ(record_->refusals[0].site_ids, std::vector<std::uint64_t>{2});
}

TEST_F(LandedFlight, TellsWithWhichBundlesAMapCame) {
  for (int i = 0; i < kBundles; ++i) {
    EXPECT_EQ(record_->samples[static_cast<std::size_t>(i)].new_map, i < 7) << i;
  }
}

TEST_F(LandedFlight, TellsWhenItHeardEachChannelAndASilenceThoughBundlesCame) {
  const auto& left = record_->heard[static_cast<std::size_t>(ChannelId::kCameraLeft)];
  ASSERT_EQ(left.size(), 20U);
  EXPECT_EQ(left[9], times_[9]);
  EXPECT_EQ(left[10], times_[30]);
  ASSERT_EQ(record_->gaps.size(), 1U);
  EXPECT_NEAR(record_->gaps[0].from_s, 0.9, 1e-9);
  EXPECT_NEAR(record_->gaps[0].to_s, 3.0, 1e-9);
}

}  // namespace
}  // namespace palace
