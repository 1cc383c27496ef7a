// FaultInjector: the faults of one simulated flight, between what the vehicle measures and what is
// sent.
//
//   bundle -> CameraFaults, VehicleFaults -> encoded messages -> LinkFaults
//
// Time is the bundles' own, so a seed, a list of faults and a flight give one stream to the bit.
// Faults may be added and ended while it flies, from any thread: they take effect with the next
// bundle. What acts is told in words (Acting), for the events of the flight.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/faults/camera_faults.h"
#include "engine/faults/fault.h"
#include "engine/faults/fault_plan.h"
#include "engine/faults/link_faults.h"
#include "engine/faults/vehicle_faults.h"
#include "engine/wire/channels.h"
#include "engine/wire/wire_message.h"

namespace palace {

/// A fault of the flight, with the number it was given.
struct InjectedFault {
  int number = 0;
  Fault fault;
  bool acts = false;  ///< with the newest bundle
  bool over = false;  ///< its time has passed, or it was ended
};

class FaultInjector {
 public:
  explicit FaultInjector(std::uint64_t seed, ChannelNames channels = {});

  /// Any thread. Times count from the first bundle. The number of the fault, from 1; refused as
  /// CheckFault says, and beyond kMostFaults.
  Result<int> Add(const Fault& fault);
  /// The same with times that count from the newest bundle: "now, for 10 s".
  Result<int> AddFromNow(Fault fault);
  /// All of a plan, or up to the first that is refused.
  Status Add(const FaultPlan& plan);
  /// Any thread. Ends it with the next bundle; one that has not begun never does.
  void End(int number);
  /// Any thread, in the order they were added.
  std::vector<InjectedFault> Faults() const;
  /// A fault was added, ever.
  bool touched() const;
  /// Seconds of true flight since the first bundle; that of the newest bundle taken. Any thread.
  double now_s() const;

  /// Once a bundle, in order: what arrives of it. One thread, as what follows.
  std::vector<WireMessage> Strike(const FrameBundle& bundle);
  /// The faults that acted since the last call, in words, each once, oldest first.
  std::vector<std::string> TakeActing();
  /// What the vehicle's clock shows more than it did without faults.
  std::int64_t clock_offset_us() const { return vehicle_.clock_offset_us(); }

 private:
  Result<int> AddLocked(const Fault& fault);

  const ChannelNames channels_;
  CameraFaults pictures_;
  VehicleFaults vehicle_;
  LinkFaults messages_;
  std::optional<Timestamp> start_;
  std::vector<std::string> acted_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::vector<Fault> faults_;
  double now_s_ = 0;
};

}  // namespace palace
