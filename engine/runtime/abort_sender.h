// AbortSender: the wave-off's own way out. A message made beforehand, sent from a thread that waits
// for nothing else: not for GL, the engine, the disk or memory.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "engine/runtime/vehicle_link.h"

namespace palace {

class AbortSender {
 public:
  explicit AbortSender(std::shared_ptr<VehicleLink> link);
  ~AbortSender();
  AbortSender(const AbortSender&) = delete;
  AbortSender& operator=(const AbortSender&) = delete;

  /// Wakes the thread; returns at once. Repeats are harmless: an abort is idempotent.
  void Trigger();

 private:
  std::shared_ptr<VehicleLink> link_;
  const VehicleMessage message_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  bool triggered_ = false;
  std::jthread thread_;
};

}  // namespace palace
