#include "gui/widgets/map/projection.h"

#include <cmath>

namespace palace {

std::optional<PinholeCamera> LeftCamera(const EngineSnapshot& snap) {
  if (snap.terrain->range && snap.terrain->range->camera.width > 0) {
    return snap.terrain->range->camera;
  }
  if (snap.sensors->rig && snap.sensors->rig->left.pinhole.width > 0) {
    return snap.sensors->rig->left.pinhole;
  }
  return std::nullopt;
}

ImVec2 PictureView::ScreenFromPixel(const Eigen::Vector2d& pixel) const {
  const double x = (pixel.x() + 0.5) / camera.width;
  const double y = (pixel.y() + 0.5) / camera.height;
  return {rect.x + static_cast<float>(x) * rect.w, rect.y + static_cast<float>(y) * rect.h};
}

std::optional<ImVec2> PictureView::ScreenFromPoint(const Eigen::Vector3d& p_W) const {
  const Eigen::Vector3d p_C = X_WC.Inverse() * p_W;
  if (!(p_C.z() > 1e-3)) {
    return std::nullopt;
  }
  return ScreenFromPixel({camera.fx_px * p_C.x() / p_C.z() + camera.cx_px,
                          camera.fy_px * p_C.y() / p_C.z() + camera.cy_px});
}

float PictureView::PixelsPerMetre(const Eigen::Vector3d& p_W) const {
  const double depth_m = (X_WC.Inverse() * p_W).z();
  return depth_m > 1e-3 ? static_cast<float>(camera.fx_px / depth_m) * ScalePx() : 0.0f;
}

float PictureView::ScaleOfPicture(const Eigen::Vector3d& p_W) const {
  const std::optional<ImVec2> at = ScreenFromPoint(p_W);
  return at && rect.Contains(*at) ? PixelsPerMetre(p_W) : 0.0f;
}

std::vector<ImVec2> ProjectCircle(const PictureView& view, const LandingSite& site,
                                  double radius_m) {
  Eigen::Vector3d along = site.normal_W.cross(Eigen::Vector3d::UnitX());
  along = along.norm() > 1e-6 ? along.normalized() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d across = along.cross(site.normal_W).normalized();
  constexpr int kPoints = 72;
  std::vector<ImVec2> points;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * 3.14159265358979 * i / kPoints;
    const auto screen = view.ScreenFromPoint(
        site.p_WS + radius_m * (std::cos(angle) * along + std::sin(angle) * across));
    if (!screen) {
      return {};
    }
    points.push_back(*screen);
  }
  return points;
}

std::vector<Eigen::Vector2d> GroundFootprint(const PinholeCamera& camera,
                                             const RigidTransform& X_WC, double height_m) {
  std::vector<Eigen::Vector2d> corners;
  const double xs[] = {-0.5, camera.width - 0.5, camera.width - 0.5, -0.5};
  const double ys[] = {-0.5, -0.5, camera.height - 0.5, camera.height - 0.5};
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d ray_W =
        X_WC.R * Eigen::Vector3d((xs[i] - camera.cx_px) / camera.fx_px,
                                 (ys[i] - camera.cy_px) / camera.fy_px, 1);
    const double t = (-height_m - X_WC.p.z()) / ray_W.z();
    if (!(t > 0) || !std::isfinite(t)) {
      return {};
    }
    const Eigen::Vector3d p_W = X_WC.p + t * ray_W;
    corners.emplace_back(p_W.x(), p_W.y());
  }
  return corners;
}

}  // namespace palace
