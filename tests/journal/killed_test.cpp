// A station that is killed while it records: what Record said is written is in the log.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

#include "engine/journal/log_index.h"
#include "tests/journal/journal_world.h"

namespace palace {
namespace {

constexpr int kKills = 20;

/// One pass with pictures of 640 x 480 and a command.
RecordItem Pass(std::uint64_t number) {
  auto bundle = std::make_shared<FrameBundle>();
  bundle->sequence = number;
  bundle->time = {1'000'000'000 + static_cast<std::int64_t>(number) * 100'000};
  bundle->imu.resize(10);
  bundle->stereo = std::make_shared<StereoFrame>(
      StereoFrame{bundle->time, ImageU8(640, 480, 7), ImageU8(640, 480, 8)});
  RecordItem item;
  item.bundle = std::move(bundle);
  item.commands = {{CommandOrigin::kOperator, AddBookmark{std::to_string(number)}}};
  item.sent = {HoldRequest{number, ""}};
  return item;
}

class Killed : public JournalTest {};

TEST_F(Killed, TwentyTimesNothingThatWasWrittenIsLostAndNoOtherEventIsTorn) {
  RandomStream random(91);
  std::printf("seed 91\n");
  int torn = 0;
  for (int kill_number = 0; kill_number < kKills; ++kill_number) {
    SCOPED_TRACE(kill_number);
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const std::string stamp = "flight" + std::to_string(kill_number);
    const pid_t child = fork();
    if (child == 0) {
      auto recorder = FlightRecorder::Open(folder_, stamp);
      for (std::uint64_t number = 1;; ++number) {
        const bool written = recorder.ok() && (*recorder)->Record(Pass(number)).ok();
        if (!written || write(ends[1], &number, sizeof number) != sizeof number) {
          _exit(1);
        }
      }
    }
    close(ends[1]);
    // The last number that is read was written before the kill; the child is somewhere behind it.
    std::uint64_t told = 0;
    const auto passes = static_cast<std::uint64_t>(1 + random.Index(15));
    while (told < passes && read(ends[0], &told, sizeof told) == sizeof told) {
    }
    usleep(static_cast<useconds_t>(random.Index(3000)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    while (read(ends[0], &told, sizeof told) == sizeof told) {
    }
    close(ends[0]);

    const auto index = VerifyLog(*LogFile::Open(folder_ / stamp / "flight.lcm"));
    ASSERT_TRUE(index.ok());
    std::map<std::string, std::uint64_t> counts;
    for (const LogEntry& entry : index->entries) {
      ++counts[index->channels[entry.channel]];
    }
    for (const char* channel : {"SITE_DECISION", "COMMAND", "CAMERA_RIG", "CAMERA_LEFT"}) {
      EXPECT_GE(counts[channel], told) << channel;
    }
    EXPECT_EQ(index->report.checksum_errors, 0u);
    EXPECT_LE(index->report.gap_count, 1u);
    torn += index->report.damaged() ? 1 : 0;
    std::filesystem::remove_all(folder_ / stamp);
  }
  std::printf("%d of %d logs end in the middle of the event in hand\n", torn, kKills);
}

}  // namespace
}  // namespace palace
