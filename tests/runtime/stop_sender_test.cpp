// The way out of what must not wait: its messages carry numbers that nobody can guess.
#include "engine/runtime/stop_sender.h"

#include <mutex>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace palace {
namespace {

class KeptLink final : public VehicleLink {
 public:
  bool Send(const VehicleMessage& message) override {
    const std::lock_guard lock(mutex_);
    sent_.push_back(message);
    arrived_.notify_all();
    return true;
  }
  VehicleMessage Next() {
    std::unique_lock lock(mutex_);
    arrived_.wait(lock, [this] { return !sent_.empty(); });
    const VehicleMessage message = sent_.back();
    sent_.clear();
    return message;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<VehicleMessage> sent_;
};

TEST(StopSender, NumbersItsMessagesByChance) {
  std::set<std::uint64_t> seen;
  for (int i = 0; i < 5; ++i) {
    const auto link = std::make_shared<KeptLink>();
    StopSender sender(link);
    sender.WaveOff();
    const auto abort = std::get<AbortRequest>(link->Next()).command_id;
    sender.Hold();
    const auto hold = std::get<HoldRequest>(link->Next()).command_id;
    EXPECT_NE(abort, hold);
    for (const std::uint64_t id : {abort, hold}) {
      EXPECT_GE(id, std::uint64_t{1} << 62) << "apart from the engine's own numbers";
      EXPECT_LT(id, std::uint64_t{1} << 63) << "an int64_t on the bus";
      seen.insert(id);
    }
    sender.WaveOff();
    EXPECT_EQ(std::get<AbortRequest>(link->Next()).command_id, abort) << "one wave-off, repeated";
  }
  EXPECT_EQ(seen.size(), 10u);
}

}  // namespace
}  // namespace palace
