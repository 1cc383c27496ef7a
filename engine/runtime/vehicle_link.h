// The way to the vehicle. Replay has none, so replay cannot transmit.
#pragma once

#include "engine/model/vehicle_message.h"

namespace palace {

class VehicleLink {
 public:
  virtual ~VehicleLink() = default;
  /// Never waits; may be called from the engine thread and, for AbortRequest, from any thread.
  virtual void Send(const VehicleMessage& message) = 0;
};

}  // namespace palace
