// The way to the vehicle. Replay has none, so replay cannot transmit.
#pragma once

#include "engine/model/snapshot.h"
#include "engine/model/vehicle_message.h"

namespace palace {

class VehicleLink {
 public:
  virtual ~VehicleLink() = default;
  /// Never waits; may be called from the engine thread and, for AbortRequest, from any thread.
  virtual void Send(const VehicleMessage& message) = 0;
  /// The station's own news after each pass, for links that carry it. Engine thread only.
  virtual void Announce(const EngineSnapshot& /*snapshot*/) {}
};

}  // namespace palace
