// The way to the vehicle. Replay has none, so replay cannot transmit.
#pragma once

#include "engine/model/snapshot.h"
#include "engine/model/vehicle_message.h"

namespace palace {

class VehicleLink {
 public:
  virtual ~VehicleLink() = default;
  /// Never waits; may be called from the engine thread and, for AbortRequest and
  /// HoldRequest, from any thread. False when it did not leave.
  virtual bool Send(const VehicleMessage& message) = 0;
  /// Seals what a vehicle takes sealed only, before it is recorded and sent. Any thread.
  virtual void Seal(VehicleMessage& /*message*/) {}
  /// What the vehicle said, for links that keep a session with it. Engine thread only.
  virtual void Hear(const FrameBundle& /*bundle*/) {}
  /// Whether this station commands. Engine thread only.
  virtual AuthorityStatus Authority() const { return {}; }
  /// The station's own news after each pass, for links that carry it. Engine thread only.
  virtual void Announce(const EngineSnapshot& /*snapshot*/) {}
  /// Messages that could not be sent, so far. Any thread.
  virtual std::uint64_t Unsent() const { return 0; }
};

}  // namespace palace
