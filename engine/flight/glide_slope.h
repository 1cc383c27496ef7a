// Glide slope: the straight path on which the left camera looks at the site all the way down.
//
//   The camera's focal point stays on the ray from the site upward and back along the heading:
//     p_WC(h) = p_WS + h_c (up - cot(slope) forward),  h_c = height of the focal point above S
//   B follows level at the approach heading: p_WB = p_WC - R_W(heading) p_BC.
//   A camera tilted by -slope therefore keeps the site at its image centre.
//
// `skid height` is the height of the skid centre above the site, metres, up-positive; the path ends
// at kSettleHeight_m, from where the vehicle moves level until its skids are above the site.
#pragma once

#include "engine/core/frames.h"
#include "engine/model/vehicle_state.h"

namespace palace {

inline constexpr double kSettleHeight_m = 2.0;

struct GlideSlope {
  Eigen::Vector3d p_WS = Eigen::Vector3d::Zero();
  double heading_rad = 0;
  double slope_rad = 0;                            ///< below the horizon, (0, pi/2]
  Eigen::Vector3d p_BC = Eigen::Vector3d::Zero();  ///< left focal point in B

  /// Body to world at the approach heading, level.
  Eigen::Matrix3d LevelRotation() const;
  /// Where B is on the path when the skid centre is skid_height_m above the site.
  Eigen::Vector3d BodyAt(double skid_height_m) const;
  /// Change of BodyAt per metre of skid height.
  Eigen::Vector3d BodyPerMetre() const;
  /// B with the skid centre straight above the site, level at the approach heading.
  Eigen::Vector3d BodyAboveSite(double skid_height_m) const;
  /// Height of the skid centre above the site when B is at p_WB, level.
  double SkidHeight(const Eigen::Vector3d& p_WB) const;
  /// Distance of p_WB from the path's straight line, metres.
  double Deviation(const Eigen::Vector3d& p_WB) const;
};

}  // namespace palace
