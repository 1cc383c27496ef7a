#include "engine/search/ground_view.h"

#include <algorithm>
#include <cmath>

#include "engine/camera/pinhole.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kLeastTilt_rad = Rad(10);

bool Holds(const PinholeCamera& camera, const Eigen::Vector3d& p_CQ) {
  const auto pixel = ProjectPinhole(camera, p_CQ);
  return pixel && InPicture(camera, *pixel);
}

}  // namespace

GroundView::GroundView(const StereoRig& rig)
    : left_(rig.left.pinhole),
      right_(rig.right.pinhole),
      X_BC_(rig.X_BC()),
      baseline_m_(rig.baseline_m),
      sine_(std::sin(std::clamp(-rig.tilt_rad, kLeastTilt_rad, Rad(90)))) {}

bool GroundView::Shows(const Eigen::Vector3d& p_BQ) const {
  const Eigen::Vector3d p_CQ = X_BC_.Inverse() * p_BQ;
  const double below_m = p_BQ.z() - X_BC_.p.z();
  const double middle_m = below_m / sine_;
  return below_m > 0 && p_CQ.squaredNorm() <= 2 * middle_m * middle_m && Holds(left_, p_CQ) &&
         Holds(right_, p_CQ - baseline_m_ * Eigen::Vector3d::UnitX());
}

double GroundView::Reach_m(double below_m) const {
  const double middle_m = below_m / sine_;
  return std::sqrt(std::max(0.0, 2 * middle_m * middle_m - below_m * below_m));
}

}  // namespace palace
