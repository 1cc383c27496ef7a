#include "engine/runtime/inbox.h"

#include <chrono>
#include <utility>

namespace palace {
namespace {

constexpr std::chrono::milliseconds kFrameExpected{250};

}  // namespace

void Inbox::Post(EngineCommand command) {
  const std::lock_guard lock(mutex_);
  commands_.push_back(std::move(command));
  changed_.notify_all();
}

std::size_t Inbox::PutNewest(std::shared_ptr<const FrameBundle> bundle) {
  const std::lock_guard lock(mutex_);
  const std::size_t dropped = bundle_ ? 1 : 0;
  bundle_ = std::move(bundle);
  changed_.notify_all();
  return dropped;
}

bool Inbox::PutAndWait(std::shared_ptr<const FrameBundle> bundle, std::stop_token stop) {
  std::unique_lock lock(mutex_);
  bundle_ = std::move(bundle);
  changed_.notify_all();
  return changed_.wait(lock, stop, [&] { return !bundle_ && !busy_; });
}

bool Inbox::Take(Batch& batch, std::stop_token stop) {
  std::unique_lock lock(mutex_);
  if (!changed_.wait(lock, stop, [&] { return bundle_ || !commands_.empty(); })) {
    return false;
  }
  if (!bundle_ && !idle_) {
    // A frame is likely on its way; commands are applied with it.
    changed_.wait_for(lock, stop, kFrameExpected, [&] { return bundle_ || idle_; });
  }
  batch.bundle = std::move(bundle_);
  bundle_.reset();
  batch.commands = std::move(commands_);
  commands_.clear();
  busy_ = true;
  return true;
}

void Inbox::Finished() {
  const std::lock_guard lock(mutex_);
  busy_ = false;
  changed_.notify_all();
}

void Inbox::SetIdle(bool idle) {
  const std::lock_guard lock(mutex_);
  idle_ = idle;
  changed_.notify_all();
}

std::vector<EngineCommand> Inbox::TakeCommands() {
  const std::lock_guard lock(mutex_);
  return std::exchange(commands_, {});
}

}  // namespace palace
