#include "engine/flight/glide_slope.h"

#include <cmath>

namespace palace {

Eigen::Matrix3d GlideSlope::LevelRotation() const { return RotationFromEuler({0, 0, heading_rad}); }

Eigen::Vector3d GlideSlope::BodyPerMetre() const {
  const double back = std::cos(slope_rad) / std::sin(slope_rad);
  return {-back * std::cos(heading_rad), -back * std::sin(heading_rad), -1.0};
}

Eigen::Vector3d GlideSlope::BodyAt(double skid_height_m) const {
  const double camera_height_m = skid_height_m + SkidCentreBody().z() - p_BC.z();
  return p_WS + camera_height_m * BodyPerMetre() - LevelRotation() * p_BC;
}

Eigen::Vector3d GlideSlope::BodyAboveSite(double skid_height_m) const {
  return p_WS - skid_height_m * Eigen::Vector3d::UnitZ() - LevelRotation() * SkidCentreBody();
}

double GlideSlope::SkidHeight(const Eigen::Vector3d& p_WB) const {
  return p_WS.z() - (p_WB.z() + SkidCentreBody().z());
}

double GlideSlope::Deviation(const Eigen::Vector3d& p_WB) const {
  const Eigen::Vector3d along = BodyPerMetre().normalized();
  const Eigen::Vector3d offset = p_WB - BodyAt(kSettleHeight_m);
  return (offset - along * along.dot(offset)).norm();
}

}  // namespace palace
