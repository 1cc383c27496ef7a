#include "engine/navigation/shared_errors.h"

#include <algorithm>

namespace palace {
namespace {

constexpr double kLeastFall = 0.1;

/// Of a small turn about any axis, one radian each, acting on v.
Eigen::Matrix3d TurnedBy(const Eigen::Vector3d& v) {
  return v.squaredNorm() * Eigen::Matrix3d::Identity() - v * v.transpose();
}

}  // namespace

Eigen::Matrix3d SharedErrors::CovarianceAt(const Eigen::Vector3d& p_WB) const {
  const Eigen::Vector3d r = p_WB - p_WS;
  Eigen::Matrix3d covariance_m2 = bias_rad * bias_rad * TurnedBy(r) +
                                  placed_rad * placed_rad * TurnedBy(p_WB - placed_from_W) +
                                  Eigen::Matrix3d(place_m.cwiseAbs2().asDiagonal());
  if (height_m > 0 && r.norm() > 0) {
    const Eigen::Vector3d u = -r.normalized();
    const Eigen::Vector3d along = height_m / std::max(u.z(), kLeastFall) * u;
    covariance_m2 += along * along.transpose();
  }
  return covariance_m2;
}

}  // namespace palace
