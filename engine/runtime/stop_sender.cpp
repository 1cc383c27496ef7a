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

StopSender::StopSender(std::shared_ptr<VehicleLink> link,
                       std::function<void(const VehicleMessage&)> sent)
    : link_(std::move(link)),
      sent_(std::move(sent)),
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
  } catch (const std::exception& error) {
    LogError(std::string("a hold could not be sealed: ") + error.what());
  }
}

void StopSender::Send(const VehicleMessage& message) {
  for (int i = 0; i < kTries; ++i) {
    try {
      link_->Send(message);
      break;
    } catch (const std::exception& error) {
      LogError(std::string("a wave-off or hold could not be sent: ") + error.what());
    }
  }
  try {
    if (sent_) {
      sent_(message);
    }
  } catch (const std::exception& error) {
    LogError(std::string("a wave-off or hold is not in the record: ") + error.what());
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
