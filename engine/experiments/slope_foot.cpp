#include "engine/experiments/slope_foot.h"

#include <algorithm>

#include "engine/core/text.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kFlattest_rad = Rad(1);  // whatever the vehicle would fly

}  // namespace

Result<Eigen::Vector3d> SlopeFoot(const VehicleDescription& vehicle, const Eigen::Vector3d& p_WB) {
  const double slope_rad = -vehicle.rig.tilt_rad;
  const double least_rad = std::max(kFlattest_rad, vehicle.limits.min_glide_slope_rad);
  if (!(slope_rad >= least_rad)) {
    return UsageError(WithNumbers(
        "the cameras look %.3g deg below the horizon, and slopes down to where they look are flown "
        "from %.3g deg on: give the vehicle another camera tilt",
        Deg(slope_rad), Deg(least_rad)));
  }
  const RigidTransform X_WC =
      RigidTransform{Eigen::Matrix3d::Identity(), p_WB} * vehicle.rig.X_BC();
  const Eigen::Vector3d axis_W = X_WC.R.col(2);
  return Eigen::Vector3d(X_WC.p - X_WC.p.z() / axis_W.z() * axis_W);
}

}  // namespace palace
