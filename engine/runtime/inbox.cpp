#include "engine/runtime/inbox.h"

#include <utility>

namespace palace {

void Inbox::Post(EngineCommand command) {
  const std::lock_guard lock(mutex_);
  commands_.push_back(std::move(command));
  changed_.notify_all();
}

void Inbox::Wake() {
  const std::lock_guard lock(mutex_);
  woken_ = true;
  changed_.notify_all();
}

void Inbox::PutNewest(std::shared_ptr<const FrameBundle> bundle) {
  JoinedBundle joined;
  {
    const std::lock_guard lock(mutex_);
    joined.bundle = std::exchange(bundle_, nullptr);
  }
  // Samples are copied outside the lock: only this thread puts frames in.
  joined = joined.bundle ? Join(*joined.bundle, *bundle) : JoinedBundle{std::move(bundle)};
  const std::lock_guard lock(mutex_);
  bundle_ = std::move(joined.bundle);
  losses_.pairs_replaced += joined.pair_replaced ? 1 : 0;
  losses_.samples_overflowed += joined.samples_dropped;
  changed_.notify_all();
}

bool Inbox::PutAndWait(std::shared_ptr<const FrameBundle> bundle, std::stop_token stop) {
  std::unique_lock lock(mutex_);
  bundle_ = std::move(bundle);
  changed_.notify_all();
  return changed_.wait(lock, stop, [&] { return !bundle_ && !busy_; });
}

bool Inbox::Take(Batch& batch, std::stop_token stop) {
  std::unique_lock lock(mutex_);
  if (!changed_.wait(lock, stop, [&] { return bundle_ || !commands_.empty() || woken_; })) {
    return false;
  }
  batch.bundle = std::exchange(bundle_, nullptr);
  batch.commands = std::exchange(commands_, {});
  woken_ = false;
  busy_ = true;
  return true;
}

void Inbox::Finished() {
  const std::lock_guard lock(mutex_);
  busy_ = false;
  changed_.notify_all();
}

std::vector<EngineCommand> Inbox::TakeCommands() {
  const std::lock_guard lock(mutex_);
  return std::exchange(commands_, {});
}

Losses Inbox::losses() const {
  const std::lock_guard lock(mutex_);
  return losses_;
}

}  // namespace palace
