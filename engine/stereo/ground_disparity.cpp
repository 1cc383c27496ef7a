#include "engine/stereo/ground_disparity.h"

#include <algorithm>

namespace palace {
namespace {

constexpr double kLeastHeight_m = 0.3;  // a camera standing on its skids

}  // namespace

GroundDisparity::GroundDisparity(const PinholeCamera& camera, double baseline_m,
                                 const RigidTransform& X_WC, double ground_height_m)
    : height_m_(std::max(kLeastHeight_m, HeightFromDown(X_WC.p.z()) - ground_height_m)) {
  const Eigen::Vector3d down_C =
      X_WC.R.row(2).transpose() * (camera.fx_px * baseline_m / height_m_);
  const double per_x = down_C.x() / camera.fx_px;
  const double per_y = down_C.y() / camera.fy_px;
  of_pixel_ = {per_x, per_y, down_C.z() - per_x * camera.cx_px - per_y * camera.cy_px};
}

}  // namespace palace
