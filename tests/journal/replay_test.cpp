// A recorded flight replays to equal bundles with the commands that came before each.
#include <chrono>
#include <thread>

#include "engine/journal/log_tools.h"
#include "tests/journal/replay_flight.h"

namespace palace {
namespace {

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

TEST_F(ReplayTest, SeeksAndMarksTheJump) {
  const auto source = Open(Fast());
  struct Case {
    double seek_s;
    std::size_t bundle;
  };
  std::uint64_t jumps = 0;
  for (const Case& c : {Case{0.5, 5}, Case{0.0, 0}, Case{0.95, 10}, Case{99, 11}, Case{-3, 0}}) {
    SCOPED_TRACE(c.seek_s);
    source->Control({PlaybackControl::Kind::kSeek, c.seek_s});
    EXPECT_EQ(source->Status().jumps, ++jumps);
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

/// The log with each event written once more, right after itself.
std::vector<std::uint8_t> Doubled(const std::filesystem::path& log, bool numbered_anew) {
  const auto bytes = ReadBytes(log);
  const auto index = BuildIndex(*LogFile::Open(log));
  std::vector<std::uint8_t> doubled;
  for (const LogEntry& entry : index->entries) {
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(entry.offset);
    doubled.insert(doubled.end(), first, first + entry.length);
    doubled.insert(doubled.end(), first, first + entry.length);
    if (numbered_anew) {
      doubled[doubled.size() - entry.length + 4] ^= 1;  // of its number, after the sync word
    }
  }
  return doubled;
}

TEST_F(ReplayTest, TakesAnEventOnceThatIsWrittenTwice) {
  const auto events = BuildIndex(*LogFile::Open(flight_.log))->entries.size();
  const auto twice = Doubled(flight_.log, false);
  const auto anew = Doubled(flight_.log, true);
  flight_.log = folder_ / "twice.lcm";
  WriteBytes(flight_.log, twice);
  const auto source = Open(Fast());
  for (const RecordItem& item : flight_.items) {
    const auto got = source->Next({});
    ASSERT_TRUE(got.ok()) << got.error().message;
    EXPECT_EQ(Payloads(**got), Payloads(*item.bundle));
    EXPECT_EQ((*got)->recorded_commands.size(), item.commands.size());
  }
  EXPECT_EQ(source->Next({}).error().code, ErrorCode::kEnd);
  EXPECT_EQ(source->Status().damage, std::to_string(events) + " events written twice, taken once");
  // What has a number of its own was heard twice.
  WriteBytes(flight_.log, anew);
  EXPECT_EQ(Open(Fast())->Status().damage.find("written twice"), std::string::npos);
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

}  // namespace
}  // namespace palace
