// SlopeReference: what a vehicle's control follows down the slope of a path.
//
//   rate    slews to the path's wanted sink rate; to 0, four times as hard, where it must not move
//   p_W     = BodyAt(height) + offset,  offset fades with a time constant of 3 s
// The offset is what the hand-over to another estimate moved the reference by, so that the control
// error stayed as it was.
#pragma once

#include "engine/flight/flight_path.h"

namespace palace {

struct SlopeReference {
  double height_m = 0;  ///< skid height
  double rate_mps = 0;  ///< of its sinking
  Eigen::Vector3d offset_W = Eigen::Vector3d::Zero();

  /// Begins at rest where the reference is.
  static SlopeReference From(const FlightPath& path, const Eigen::Vector3d& p_W);
  /// One step of dt_s; writes the reference.
  void Step(const FlightPath& path, bool moves, double dt_s, MovingReference& reference);
};

}  // namespace palace
