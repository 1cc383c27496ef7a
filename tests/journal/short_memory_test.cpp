// Memory that is short at any one allocation of a pass: the log is whole, the pass is in it wholly
// or not at all, and what was decided in it is not lost. This program's allocations can be made to
// fail on purpose, one thread's at a time.
#include "tests/support/short_memory.h"

#include <unistd.h>

#include <new>

#include "engine/journal/log_index.h"
#include "tests/journal/journal_world.h"

namespace palace {
namespace {

using short_memory::allocations_left;

class ShortMemory : public JournalTest {
 protected:
  static Disk DiskWithoutReserve() {
    return {.write = [](int file, const void* data,
                        std::size_t size) { return ::write(file, data, size); },
            .cut = [](int file, off_t size) { return ::ftruncate(file, size); },
            .sync = [](int) { return 0; },
            .set_aside = [](int, off_t) { return false; },
            .free_bytes = [](const auto&) { return std::optional(std::uint64_t{1} << 40); }};
  }
  static RecordItem Pass(std::uint64_t number, bool decides) {
    RecordItem item;
    auto bundle = std::make_shared<FrameBundle>();
    bundle->sequence = number;
    bundle->time = {1'000'000'000 + static_cast<std::int64_t>(number) * 2'000'000};
    bundle->imu.resize(10);
    bundle->stereo = std::make_shared<StereoFrame>(
        StereoFrame{bundle->time, ImageU8(200, 150, 7), ImageU8(200, 150, 8)});
    item.bundle = std::move(bundle);
    if (decides) {
      item.commands = {{CommandOrigin::kOperator, WaveOff{}}};
      item.sent = {AbortRequest{number, "test"}};
    }
    return item;
  }
  int Count(const LogIndex& index, const std::string& channel) const {
    int count = 0;
    for (const LogEntry& entry : index.entries) {
      count += index.channels[entry.channel] == channel ? 1 : 0;
    }
    return count;
  }
};

TEST_F(ShortMemory, WhicheverAllocationFailsTheLogIsWholeAndNoCommandIsLost) {
  const Disk disk = DiskWithoutReserve();
  bool failed = true;
  long n = 0;
  for (; failed; ++n) {
    SCOPED_TRACE(n);
    std::filesystem::remove_all(folder_ / "flight");
    auto recorder = FlightRecorder::Open(folder_, "flight", {}, disk);
    ASSERT_TRUE(recorder.ok());
    ASSERT_TRUE((*recorder)->Record(Pass(1, false)));
    const RecordItem second = Pass(2, true);
    failed = false;
    allocations_left = n;
    try {
      (void)(*recorder)->Record(second);
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    allocations_left = -1;
    ASSERT_TRUE((*recorder)->Record(Pass(3, false)));
    ASSERT_TRUE((*recorder)->Close());
    const auto index = VerifyLog(*LogFile::Open(folder_ / "flight" / "flight.lcm"));
    ASSERT_TRUE(index.ok());
    ASSERT_FALSE(index->report.damaged());
    ASSERT_EQ(index->report.unchecked, 0u);
    const int bundles = failed ? 2 : 3;
    ASSERT_EQ(Count(*index, "CAMERA_RIG"), bundles);
    ASSERT_EQ(Count(*index, "CAMERA_LEFT"), bundles);
    ASSERT_EQ(Count(*index, "IMU"), 10 * bundles);
    ASSERT_EQ(Count(*index, "SITE_DECISION"), 1);
  }
  std::printf("each of %ld allocations\n", n - 1);
  EXPECT_GT(n, 50);
}

}  // namespace
}  // namespace palace
