// AttitudeHistory: the autopilot's recent poses, read at any time between and a little beyond them.
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Dense>

#include "engine/core/time.h"
#include "engine/model/vehicle_state.h"

namespace palace {

class AttitudeHistory {
 public:
  void Clear() { poses_.clear(); }
  /// Poses may repeat or arrive late; one older than the window (2 s) is dropped.
  void Add(const VehiclePose& pose);
  bool empty() const { return poses_.empty(); }
  const VehiclePose& newest() const { return poses_.back(); }
  /// Spherical interpolation between the neighbours. Beyond the newest: turned on with its angular
  /// rate and moved on with its velocity, at most 0.5 s. Before the oldest: the oldest. Nothing
  /// when empty.
  std::optional<VehiclePose> At(Timestamp time) const;

 private:
  std::deque<VehiclePose> poses_;
};

}  // namespace palace
