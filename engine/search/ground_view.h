// GroundView: which points of level ground a hover's stereo pair shows well enough to judge.
//
// A point counts where both pictures hold it and at least half as many pixels fall on a metre of
// the ground there as in the middle of the picture: along the ray a metre of ground spans
//   f h / slant^2 pixels   (h: of the camera above the ground),
// so its slant range is at most sqrt(2) times that of the middle. A camera that looks to the
// horizon is taken as one that looks 10 degrees below it.
//
// Frames: the level body frame, forward, right, down; a hover is level.
#pragma once

#include <Eigen/Dense>

#include "engine/model/rig.h"

namespace palace {

class GroundView {
 public:
  explicit GroundView(const StereoRig& rig);

  bool Shows(const Eigen::Vector3d& p_BQ) const;
  /// No farther, horizontally, from the left camera on ground that lies `below_m` under it.
  double Reach_m(double below_m) const;
  const Eigen::Vector3d& p_BC() const { return X_BC_.p; }

 private:
  PinholeCamera left_, right_;
  RigidTransform X_BC_;
  double baseline_m_;
  double sine_;  ///< of the middle ray below the horizon
};

}  // namespace palace
