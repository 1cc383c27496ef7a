#include "engine/runtime/stop_sender.h"

#include <exception>
#include <random>
#include <utility>

#include "engine/core/log.h"

namespace palace {
namespace {

/// Numbers of this path lie apart from the engine's own command counter, and nobody knows them
/// before they are sent: what comes back on the bus is told from a stranger's by its number.
std::uint64_t RandomPathId() {
  constexpr std::uint64_t kApart = std::uint64_t{1} << 62;
  std::random_device words;
  return kApart | ((std::uint64_t{words()} << 32 | words()) & (kApart - 1) & ~std::uint64_t{1});
}

constexpr int kTries = 3;  // of a send that throws: memory may be short for a moment

}  // namespace

StopSender::StopSender(std::shared_ptr<VehicleLink> link, Tried tried)
    : link_(std::move(link)),
      tried_(std::move(tried)),
      abort_(AbortRequest{RandomPathId(), "Wave-off by the operator"}),
      hold_(HoldRequest{std::get<AbortRequest>(abort_).command_id + 1, "Held by the operator"}),
      thread_([this](std::stop_token stop) {
        std::unique_lock lock(mutex_);
        while (wake_.wait(lock, stop, [&] { return abort_wanted_ || hold_wanted_; })) {
          // Of both at once the wave-off counts: a vehicle that climbs away refuses a hold.
          const bool abort = std::exchange(abort_wanted_, false);
          hold_wanted_ = false;
          lock.unlock();
          abort ? Send(abort_) : SealAndSend();
          lock.lock();
        }
      }) {}

StopSender::~StopSender() = default;

void StopSender::SealAndSend() {
  try {
    VehicleMessage hold = hold_;
    link_->Seal(hold);
    Send(hold);
    return;
  } catch (const std::exception& error) {
    LogError(std::string("a hold could not be sealed: ") + error.what());
  } catch (...) {
    LogError("a hold could not be sealed: unknown exception");
  }
  Tell(hold_, false);
}

void StopSender::Send(const VehicleMessage& message) {
  bool left = false;
  for (int i = 0; i < kTries && !left; ++i) {
    left = TrySend(message);
  }
  Tell(message, left);
}

bool StopSender::TrySend(const VehicleMessage& message) {
  try {
    const bool left = link_->Send(message);
    if (!left) {
      LogError("a wave-off or hold could not be sent");
    }
    return left;
  } catch (const std::exception& error) {
    LogError(std::string("a wave-off or hold could not be sent: ") + error.what());
  } catch (...) {
    LogError("a wave-off or hold could not be sent: unknown exception");
  }
  return false;
}

void StopSender::Tell(const VehicleMessage& message, bool left) {
  try {
    if (tried_) {
      tried_(message, left);
    }
  } catch (const std::exception& error) {
    LogError(std::string("a wave-off or hold is not in the record: ") + error.what());
  } catch (...) {
    LogError("a wave-off or hold is not in the record: unknown exception");
  }
}

void StopSender::WaveOff() { Trigger(abort_wanted_); }
void StopSender::Hold() { Trigger(hold_wanted_); }

void StopSender::Trigger(bool& wanted) {
  const std::lock_guard lock(mutex_);
  wanted = true;
  wake_.notify_one();
}

}  // namespace palace
