#include "engine/runtime/abort_sender.h"

#include <utility>

namespace palace {
namespace {

// Abort numbers of this path lie apart from the engine's own command counter.
constexpr std::uint64_t kAbortPathId = std::uint64_t{1} << 62;

}  // namespace

AbortSender::AbortSender(std::shared_ptr<VehicleLink> link)
    : link_(std::move(link)),
      message_(AbortRequest{kAbortPathId, "Wave-off by the operator"}),
      thread_([this](std::stop_token stop) {
        std::unique_lock lock(mutex_);
        while (wake_.wait(lock, stop, [&] { return triggered_; })) {
          triggered_ = false;
          lock.unlock();
          link_->Send(message_);
          lock.lock();
        }
      }) {}

AbortSender::~AbortSender() = default;

void AbortSender::Trigger() {
  const std::lock_guard lock(mutex_);
  triggered_ = true;
  wake_.notify_one();
}

}  // namespace palace
