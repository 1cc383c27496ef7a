// A disk that fills up, at any byte: the log stays whole, pictures go first, decisions last.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <map>

#include "engine/journal/log_index.h"
#include "engine/journal/log_tools.h"
#include "engine/journal/replay_source.h"
#include "engine/wire/convert.h"
#include "tests/journal/journal_world.h"

namespace palace {
namespace {

/// A disk with so many bytes left, over the real one. As a real one it writes what still fits.
class SmallDisk {
 public:
  explicit SmallDisk(std::uint64_t room) : room_(room) {
    disk_ = {.write = [this](int file, const void* data,
                             std::size_t size) { return Write(file, data, size); },
             .cut = [this](int file, off_t size) { return Cut(file, size); },
             .sync = [](int) { return 0; },
             .set_aside = [this](int file, off_t size) { return SetAside(file, size); },
             .free_bytes = [this](const auto&) { return std::optional(room_); }};
  }
  const Disk& disk() const { return disk_; }
  void AddRoom(std::uint64_t bytes) { room_ += bytes; }
  void TakeRoom(std::uint64_t bytes) { room_ -= bytes; }
  std::uint64_t room() const { return room_; }

 private:
  ssize_t Write(int file, const void* data, std::size_t size) {
    if (room_ == 0) {
      errno = ENOSPC;
      return -1;
    }
    const ssize_t written = ::write(file, data, std::min<std::uint64_t>(size, room_));
    room_ -= static_cast<std::uint64_t>(written);
    taken_[file] += static_cast<std::uint64_t>(written);
    return written;
  }
  int Cut(int file, off_t size) {
    room_ += taken_[file] - static_cast<std::uint64_t>(size);
    taken_[file] = static_cast<std::uint64_t>(size);
    return ::ftruncate(file, size);
  }
  bool SetAside(int file, off_t size) {
    if (static_cast<std::uint64_t>(size) > room_) {
      return false;
    }
    room_ -= static_cast<std::uint64_t>(size);
    taken_[file] = static_cast<std::uint64_t>(size);
    return true;
  }

  std::uint64_t room_;
  std::map<int, std::uint64_t> taken_;
  Disk disk_;
};

class FullDisk : public JournalTest {
 protected:
  std::filesystem::path Log() const { return folder_ / "flight" / "flight.lcm"; }

  /// What a log holds, read back and checked in full.
  LogIndex Read() const {
    const auto index = VerifyLog(*LogFile::Open(Log()));
    return index ? *index : LogIndex{};
  }
  int Count(const std::string& channel) const {
    const LogIndex index = Read();
    int count = 0;
    for (const LogEntry& entry : index.entries) {
      count += index.channels[entry.channel] == channel ? 1 : 0;
    }
    return count;
  }
  std::vector<std::string> Told() const {
    const LogIndex index = Read();
    std::vector<std::string> texts;
    const auto file = LogFile::Open(Log());
    for (const LogEntry& entry : index.entries) {
      if (index.channels[entry.channel] == "EVENT") {
        texts.push_back(DecodeEvent(*ReadEvent(*file, entry, index.channels))->text);
      }
    }
    return texts;
  }
  static bool Mentions(const std::vector<std::string>& texts, const std::string& words) {
    return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
      return text.find(words) != std::string::npos;
    });
  }
};

TEST_F(FullDisk, WhateverByteFailsOnlyWholeEventsStay) {
  RandomStream random(81);
  std::vector<WireMessage> messages;
  for (int i = 0; i < 9; ++i) {
    messages.push_back({i % 3 == 0 ? "CAMERA_LEFT" : "IMU", {1'000'000 + i}, {}});
    messages.back().payload.resize(static_cast<std::size_t>(random.Index(i % 3 == 0 ? 300 : 60)));
  }
  std::uint64_t needed = 0;
  for (std::uint64_t room = 12; needed == 0; ++room) {
    SCOPED_TRACE(room);
    std::filesystem::remove_all(folder_ / "flight");
    std::filesystem::create_directories(folder_ / "flight");
    SmallDisk small(room);
    auto writer = LogWriter::Create(Log(), small.disk());
    ASSERT_TRUE(writer.ok());
    std::size_t whole = 0;  // events of the flushes that succeeded, three at a time
    Status last = Ok();
    for (std::size_t i = 0; i < messages.size() && last; ++i) {
      last = writer->Write(messages[i]);
      if (i % 3 == 2 && last) {
        last = writer->Flush();
        whole = last ? i + 1 : whole;
      }
    }
    const LogMark end = writer->mark();
    (void)writer->Close();
    needed = last ? room : 0;
    ASSERT_EQ(std::filesystem::file_size(Log()), end.log_bytes);
    ASSERT_EQ(std::filesystem::file_size(SidecarPath(Log())), end.index_bytes);
    if (whole == 0) {
      ASSERT_EQ(end.log_bytes, 0u);
      continue;
    }
    const LogIndex index = Read();
    ASSERT_EQ(index.entries.size(), whole);
    ASSERT_FALSE(index.report.damaged());
    ASSERT_EQ(index.report.unchecked, 0u);
  }
  std::printf("every room from 12 to %d bytes\n", static_cast<int>(needed));
}

TEST_F(FullDisk, AWriterThatFailedGoesOnWhenThereIsRoom) {
  std::filesystem::create_directories(folder_ / "flight");
  SmallDisk small(1000);
  auto writer = LogWriter::Create(Log(), small.disk());
  const WireMessage message{"IMU", {5}, std::vector<std::uint8_t>(200)};
  std::uint64_t written = 0;
  while (writer->Write(message) && writer->Flush()) {
    ++written;
  }
  EXPECT_EQ(writer->events(), written);
  EXPECT_EQ(writer->problem(), "the disk is full");
  small.AddRoom(1000);
  ASSERT_TRUE(writer->Write({"GPS", {6}, {1, 2}}));
  ASSERT_TRUE(writer->Close());
  const LogIndex index = Read();
  EXPECT_EQ(index.entries.size(), written + 1);
  EXPECT_FALSE(index.report.damaged());
  EXPECT_EQ(index.report.number_jumps, 0u);
  EXPECT_EQ(index.channels.back(), "GPS");
}

/// A flight of 10 passes a second with pictures of 2 x 30,000 bytes: 0.6 MB/s.
class FullDiskFlight : public FullDisk {
 protected:
  void Open(std::uint64_t room) {
    small_ = std::make_unique<SmallDisk>(room);
    auto opened = FlightRecorder::Open(folder_, "flight", {}, small_->disk());
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    recorder_ = std::move(*opened);
  }
  /// One pass; every tenth brings a command. Returns whether it was written.
  bool Pass() {
    RecordItem item;
    auto bundle = std::make_shared<FrameBundle>();
    bundle->sequence = ++passes_;
    bundle->time = {1'000'000'000 + static_cast<std::int64_t>(passes_) * 100'000};
    bundle->imu.resize(10);
    bundle->stereo = std::make_shared<StereoFrame>(
        StereoFrame{bundle->time, ImageU8(200, 150, 7), ImageU8(200, 150, 8)});
    item.bundle = std::move(bundle);
    if (passes_ % 10 == 0) {
      item.commands = {{CommandOrigin::kOperator, AddBookmark{std::to_string(passes_)}}};
      item.sent = {HoldRequest{passes_, "test"}};
      ++commands_;
    }
    return recorder_->Record(item).ok();
  }

  std::unique_ptr<SmallDisk> small_;
  std::unique_ptr<FlightRecorder> recorder_;
  std::uint64_t passes_ = 0;
  int commands_ = 0;
};

TEST_F(FullDiskFlight, PicturesAreThinnedFirstAndDecisionsAreKeptToTheLast) {
  // Three minutes of the full rate, of which the reserve takes a quarter.
  Open(180 * 620'000);
  std::map<int, int> passes_at;
  double last_minutes = INFINITY;
  while (Pass()) {
    const RecordState state = recorder_->State();
    ++passes_at[state.pictures_every];
    EXPECT_EQ(state.problem, "");
    ASSERT_LT(passes_, 200'000u);
    if (state.pictures_every == 0 && passes_at[0] > 300) {
      EXPECT_LE(state.minutes_left, last_minutes + 0.05);
      last_minutes = state.minutes_left;
    }
    // Nobody waits for hours of telemetry: the rest of the disk goes to somebody else.
    if (passes_at[0] == 600) {
      small_->TakeRoom(small_->room() - 100'000);
    }
  }
  EXPECT_GT(passes_at[1], 50);
  EXPECT_GT(passes_at[2], 100);
  EXPECT_GT(passes_at[4], 100);
  EXPECT_GT(passes_at[0], 600) << "the reserve was not given back";
  EXPECT_EQ(recorder_->State().problem, "the disk is full");
  EXPECT_LT(last_minutes, 0.1) << "the countdown ends where the disk does";
  const int written = commands_;
  (void)recorder_->Close();
  EXPECT_FALSE(Read().report.damaged());
  EXPECT_EQ(Read().report.unchecked, 0u);
  EXPECT_GE(Count("SITE_DECISION"), written - 1);
  EXPECT_GE(Count("COMMAND"), written - 1);
  EXPECT_GE(Count("CAMERA_RIG"), static_cast<int>(passes_) - 1);
  const auto told = Told();
  for (const char* words : {"every 2nd pair", "every 4th pair", "no pictures", "space set aside"}) {
    EXPECT_TRUE(Mentions(told, words)) << words;
  }
}

TEST_F(FullDiskFlight, GoesOnWhenThereIsRoomAndWritesWhatWasDecidedMeanwhile) {
  Open(3'000'000);
  while (Pass()) {
  }
  const std::uint64_t stopped = passes_;
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(Pass());
  }
  EXPECT_EQ(recorder_->State().problem, "the disk is full");
  small_->AddRoom(500'000'000);
  while (!Pass()) {
    ASSERT_LT(passes_, stopped + 120) << "tried again every second";
  }
  EXPECT_EQ(recorder_->State().problem, "");
  for (int i = 0; i < 30; ++i) {
    EXPECT_TRUE(Pass());
  }
  ASSERT_TRUE(recorder_->Close());
  EXPECT_FALSE(Read().report.damaged());
  EXPECT_EQ(Count("SITE_DECISION"), commands_) << "a command is missing";
  EXPECT_EQ(Count("COMMAND"), commands_) << "a message is missing";
  EXPECT_TRUE(Mentions(Told(), "goes on after"));
  // A replay begins afresh behind the gap.
  ReplayOptions options;
  options.speed = 0;
  const auto source = ReplaySource::Open(Log(), options);
  ASSERT_TRUE(source.ok());
  int jumps = 0;
  while (const auto bundle = (*source)->Next({})) {
    jumps += (*bundle)->discontinuity ? 1 : 0;
  }
  EXPECT_EQ(jumps, 1);
}

TEST_F(FullDiskFlight, EveryRoomLeavesAWholeLog) {
  for (std::uint64_t room = 100'000; room < 400'000; room += 7'919) {
    SCOPED_TRACE(room);
    std::filesystem::remove_all(folder_ / "flight");
    passes_ = 0;
    Open(room);
    for (int i = 0; i < 40; ++i) {
      (void)Pass();
    }
    (void)recorder_->Close();
    recorder_.reset();
    const LogIndex index = Read();
    EXPECT_FALSE(index.report.damaged());
    EXPECT_EQ(index.report.unchecked, 0u);
  }
}

/// Bookmarks of hours without room: notes of events go, what was commanded stays.
TEST_F(FullDiskFlight, WhatMemoryCannotHoldIsEventsBeforeCommandsAndIsTold) {
  Open(3'000'000);
  while (Pass()) {
  }
  const int commands = commands_;
  RecordItem notes;
  for (int i = 0; i < 6000; ++i) {
    notes.notes.push_back({{}, EventKind::kAlarm, "note " + std::to_string(i)});
  }
  EXPECT_FALSE(recorder_->Record(notes).ok());
  RecordItem wave_off;
  wave_off.commands = {{CommandOrigin::kOperator, WaveOff{}}};
  wave_off.sent = {AbortRequest{7, "test"}};
  EXPECT_FALSE(recorder_->Record(wave_off).ok());
  EXPECT_FALSE(recorder_->Record(notes).ok());
  small_->AddRoom(500'000'000);
  while (!Pass()) {
  }
  ASSERT_TRUE(recorder_->Close());
  EXPECT_EQ(Count("ABORT"), 1);
  EXPECT_EQ(Count("SITE_DECISION"), 1 + commands_) << "of " << commands;
  EXPECT_TRUE(Mentions(Told(), "note 5999"));
  EXPECT_TRUE(Mentions(Told(), "messages that memory did not hold"));
  EXPECT_FALSE(Read().report.damaged());
}

/// What the station sends and tells is on the disk too, and the sidecar.
TEST_F(FullDiskFlight, TheCountdownCountsEverythingThatIsWritten) {
  Open(std::uint64_t{10} << 30);
  const auto bytes = [&] {
    return static_cast<double>(std::filesystem::file_size(Log()) +
                               std::filesystem::file_size(SidecarPath(Log())));
  };
  const auto fly = [&](int passes) {
    for (int i = 0; i < passes; ++i) {
      RecordItem told;
      told.notes.assign(20, {{}, EventKind::kAlarm, std::string(5000, 'x')});
      ASSERT_TRUE(recorder_->Record(told));
      ASSERT_TRUE(Pass());
    }
  };
  fly(10);
  const double before = bytes();
  fly(50);
  const double rate_per_s = (bytes() - before) / 5;
  const double room = static_cast<double>(small_->room() + (48u << 20));
  EXPECT_NEAR(60 * recorder_->State().minutes_left * rate_per_s / room, 1, 0.05);
}

TEST_F(FullDiskFlight, APlentifulDiskLeavesNothingOutAndNothingBehind) {
  Open(std::uint64_t{100} << 30);
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(Pass());
  }
  EXPECT_EQ(recorder_->State().pictures_every, 1);
  EXPECT_GT(recorder_->State().minutes_left, 1000);
  ASSERT_TRUE(recorder_->Close());
  EXPECT_EQ(Count("CAMERA_LEFT"), 100);
  EXPECT_EQ(Count("EVENT"), 0);
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "flight")) {
    files += entry.is_regular_file() ? 1 : 0;
  }
  EXPECT_EQ(files, 2) << "the reserve has no name";
}

TEST_F(FullDiskFlight, WhatIsSaidBetweenBundlesIsWrittenAtOnce) {
  Open(std::uint64_t{10} << 30);
  ASSERT_TRUE(Pass());
  RecordItem wave_off;
  wave_off.commands = {{CommandOrigin::kOperator, WaveOff{}}};
  wave_off.sent = {AbortRequest{7, "test"}};
  ASSERT_TRUE(recorder_->Record(wave_off));
  // Nothing came after it, and nothing was closed.
  EXPECT_EQ(Count("ABORT"), 1);
  EXPECT_EQ(Count("SITE_DECISION"), 1);
}

TEST_F(FullDiskFlight, AWaveOffBeforeAnythingWasHeardIsInTheLog) {
  Open(std::uint64_t{10} << 30);
  RecordItem wave_off;
  wave_off.sent = {AbortRequest{7, "test"}};
  ASSERT_TRUE(recorder_->Record(wave_off));
  EXPECT_EQ(Count("ABORT"), 1);
  ASSERT_TRUE(Pass());
  ASSERT_TRUE(Pass());
  ASSERT_TRUE(recorder_->Close());
  EXPECT_EQ(Count("ABORT"), 1);
  EXPECT_NEAR(DescribeLog(Log(), false)->duration_s, 0.1, 1e-9);
}

}  // namespace
}  // namespace palace
