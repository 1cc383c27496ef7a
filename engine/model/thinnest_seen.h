// How thin a thing two pixels still show: a post, a peg, a wire.
//
//   width = 2 z / f   z: depth of the place along the optical axis, m; f: focal length, pixels
//
// No test of the maps is sure of what is thinner, whatever it says of the ground beneath: under the
// two of 264 confirmed sites that were unsafe (882 fields, 8 to 15 m) stood a peg of 1.5 to 4 cm
// and blades of grass, both thinner than two pixels.
#pragma once

#include <limits>

#include "engine/model/range_map.h"

namespace palace {

inline constexpr double kLeastSeen_px = 2;

/// In metres, for a thing at p_W seen by the left camera that stands at X_WC. NaN where that camera
/// is not known or the place is behind it.
inline double ThinnestSeen_m(const PinholeCamera& camera, const RigidTransform& X_WC,
                             const Eigen::Vector3d& p_W) {
  const double depth_m = (X_WC.Inverse() * p_W).z();
  return camera.width > 0 && depth_m > 0 ? kLeastSeen_px * depth_m / camera.fx_px
                                         : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace palace
