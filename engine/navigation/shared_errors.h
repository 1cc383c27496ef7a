// SharedErrors: what all vision positions of one site have in common, and no filter averages.
//
// Positions by vision are told in the frame in which the ground at the site was placed. With r from
// the site to B, q from where the landmarks were placed to the camera, u the unit ray to the site:
//
//   e = b x r + w x q - z (w x (q - r))_z + d + h u / u_z
//
//   b  the bias of the attitude: it turned the ground about the site when that was placed, and
//      turns every ray since. It goes to 0 with r, which is why a landing can bear it. As far as
//      gravity has not told it (landmark_frame.h)
//   w  the error of the one attitude that the landmarks were placed by, as far as the attitudes
//      since then have not told it (landmark_frame.h). The ground is kept at the site's height,
//      which it would lift by (w x (q - r))_z: so heights err by w x r like those by b
//   d  the place of what is tracked beside the place that the site is told at
//   h  the ground at the laser's spot beside that at the site (assumption 1 of the thesis)
//
// In that frame the fixes agree with each other and with the inertial data but for gravity, which b
// leans: the accelerometer bias of the filter takes it. So the filter knows nothing of these; its
// stated covariance is its own plus this one. After Schmidt 1966 (errors considered, not
// estimated).
#pragma once

#include <Eigen/Dense>

namespace palace {

/// Of two small turns in axes of W, radians squared: w, then b.
using TurnCovariance = Eigen::Matrix<double, 6, 6>;

/// Standard deviations, per axis, where nothing else is said. The default: nothing in common.
struct SharedErrors {
  Eigen::Vector3d p_WS = Eigen::Vector3d::Zero();
  Eigen::Vector3d placed_from_W = Eigen::Vector3d::Zero();
  TurnCovariance turns_rad2 = TurnCovariance::Zero();
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();  ///< north, east, down
  double height_m = 0;

  /// Of the position of B at p_WB, metres squared. At the site's own height the ray has none:
  /// height_m counts as if the ray fell by 1 in 10.
  Eigen::Matrix3d CovarianceAt(const Eigen::Vector3d& p_WB) const;
};

}  // namespace palace
