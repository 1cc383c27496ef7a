// StopSender: the way out of what must not wait: wave-off and hold here. Messages made beforehand,
// sent from a thread that waits for nothing else: not for GL, the engine, the disk or memory. The
// engine then decides the same command in its own time and sends it again under its own number.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "engine/runtime/vehicle_link.h"

namespace palace {

class StopSender {
 public:
  /// `tried` is told of each message, and whether it left, on the thread of the sender: for the
  /// record, which has it even when the engine is dead.
  using Tried = std::function<void(const VehicleMessage&, bool left)>;
  explicit StopSender(std::shared_ptr<VehicleLink> link, Tried tried = {});
  ~StopSender();
  StopSender(const StopSender&) = delete;
  StopSender& operator=(const StopSender&) = delete;

  /// Each wakes the thread and returns at once. Repeats are harmless: both are idempotent.
  void WaveOff();
  void Hold();

 private:
  void Trigger(bool& wanted);
  void Send(const VehicleMessage& message);
  bool TrySend(const VehicleMessage& message);
  void Tell(const VehicleMessage& message, bool left);
  /// The hold; a wave-off needs no seal, and no memory for it.
  void SealAndSend();

  std::shared_ptr<VehicleLink> link_;
  const Tried tried_;
  const VehicleMessage abort_;
  const VehicleMessage hold_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  bool abort_wanted_ = false;
  bool hold_wanted_ = false;
  std::jthread thread_;
};

}  // namespace palace
