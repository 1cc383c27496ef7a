// PoseHistory: where the vehicle was in the last three seconds, and where it took itself to be, for
// pictures that were exposed before they come.
#pragma once

#include <deque>

#include "engine/core/frames.h"
#include "engine/model/vehicle_state.h"

namespace palace {

class PoseHistory {
 public:
  static constexpr double kLength_s = 3;

  /// In order of time; `told.time` is the time of both.
  void Add(const RigidTransform& X_WB, const VehiclePose& told);
  /// True X_WB: between two entries on the straight line and the shortest turn, before the first
  /// and after the last these.
  RigidTransform TrueAt(Timestamp time) const;
  /// The vehicle's own solution at a time, of the poses that lie `delay_s` in the past or more:
  /// what is newer is carried forward from the last of these with its speed and rate.
  VehiclePose ToldAt(Timestamp time, double delay_s) const;

 private:
  struct Entry {
    RigidTransform X_WB;
    VehiclePose told;
  };
  /// The first entry at or after the time, else the last.
  std::size_t Find(Timestamp time) const;

  std::deque<Entry> entries_;
};

}  // namespace palace
