#include "engine/camera/pinhole.h"

#include <cmath>
#include <numbers>

#include "engine/core/check.h"

namespace palace {
namespace {
constexpr double kNearestDepth_m = 1e-6;
}  // namespace

PinholeCamera PinholeFromFov(int width, int height, double hfov_rad) {
  PALACE_CHECK(width > 0 && height > 0, width, height);
  PALACE_CHECK(hfov_rad > 0 && hfov_rad < std::numbers::pi, hfov_rad);
  PinholeCamera camera;
  camera.width = width;
  camera.height = height;
  camera.fx_px = width / 2.0 / std::tan(hfov_rad / 2);
  camera.fy_px = camera.fx_px;
  camera.cx_px = (width - 1) / 2.0;
  camera.cy_px = (height - 1) / 2.0;
  return camera;
}

std::optional<Eigen::Vector2d> ProjectPinhole(const PinholeCamera& camera,
                                              const Eigen::Vector3d& p_CQ) {
  if (!p_CQ.allFinite() || !(p_CQ.z() > kNearestDepth_m)) {
    return std::nullopt;
  }
  return Eigen::Vector2d(camera.fx_px * p_CQ.x() / p_CQ.z() + camera.cx_px,
                         camera.fy_px * p_CQ.y() / p_CQ.z() + camera.cy_px);
}

Eigen::Vector3d RayFromPixel(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  return {(pixel.x() - camera.cx_px) / camera.fx_px, (pixel.y() - camera.cy_px) / camera.fy_px,
          1.0};
}

bool InPicture(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= camera.width - 0.5 &&
         pixel.y() <= camera.height - 0.5;
}

}  // namespace palace
