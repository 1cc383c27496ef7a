#include "engine/runtime/stop_sender.h"

#include <utility>

namespace palace {
namespace {

// Numbers of this path lie apart from the engine's own command counter.
constexpr std::uint64_t kAbortPathId = std::uint64_t{1} << 62;
constexpr std::uint64_t kHoldPathId = kAbortPathId + 1;

}  // namespace

StopSender::StopSender(std::shared_ptr<VehicleLink> link)
    : link_(std::move(link)),
      abort_(AbortRequest{kAbortPathId, "Wave-off by the operator"}),
      hold_(HoldRequest{kHoldPathId, "Held by the operator"}),
      thread_([this](std::stop_token stop) {
        std::unique_lock lock(mutex_);
        while (wake_.wait(lock, stop, [&] { return abort_wanted_ || hold_wanted_; })) {
          // Of both at once the wave-off counts: a vehicle that climbs away refuses a hold.
          const bool abort = std::exchange(abort_wanted_, false);
          hold_wanted_ = false;
          lock.unlock();
          link_->Send(abort ? abort_ : hold_);
          lock.lock();
        }
      }) {}

StopSender::~StopSender() = default;

void StopSender::WaveOff() { Trigger(abort_wanted_); }
void StopSender::Hold() { Trigger(hold_wanted_); }

void StopSender::Trigger(bool& wanted) {
  const std::lock_guard lock(mutex_);
  wanted = true;
  wake_.notify_one();
}

}  // namespace palace
