#include "engine/navigation/shared_errors.h"

#include <algorithm>

namespace palace {
namespace {

constexpr double kLeastFall = 0.1;

/// Of a small turn, by which `level` moves north and east, and `upright` down.
Eigen::Matrix3d ByTurn(const Eigen::Vector3d& level, const Eigen::Vector3d& upright) {
  Eigen::Matrix3d by_turn;
  by_turn << 0, level.z(), -level.y(),  //
      -level.z(), 0, level.x(),         //
      upright.y(), -upright.x(), 0;
  return by_turn;
}

}  // namespace

Eigen::Matrix3d SharedErrors::CovarianceAt(const Eigen::Vector3d& p_WB) const {
  const Eigen::Vector3d r = p_WB - p_WS;
  Eigen::Matrix<double, 3, 6> by_turns;
  by_turns << ByTurn(p_WB - placed_from_W, r), ByTurn(r, r);
  Eigen::Matrix3d covariance_m2 = by_turns * turns_rad2 * by_turns.transpose() +
                                  Eigen::Matrix3d(place_m.cwiseAbs2().asDiagonal());
  if (height_m > 0 && r.norm() > 0) {
    const Eigen::Vector3d u = -r.normalized();
    const Eigen::Vector3d along = height_m / std::max(u.z(), kLeastFall) * u;
    covariance_m2 += along * along.transpose();
  }
  return covariance_m2;
}

}  // namespace palace
