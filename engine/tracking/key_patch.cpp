#include "engine/tracking/key_patch.h"

#include <cmath>

namespace palace {

std::optional<PatchView> KeyPatch::ViewFrom(const PinholeCamera& camera, const RigidTransform& X_WC,
                                            const GroundPlane& plane) const {
  const auto now_from_key = PlaneHomography(camera, X_WK, X_WC, plane);
  if (!now_from_key || !(plane.HeightOf(X_WC.p) > 0) ||
      !(now_from_key->row(2).dot(pixel.homogeneous()) > 0)) {
    return std::nullopt;
  }
  PatchView view;
  view.now_from_key = *now_from_key;
  view.pixel = MapPixel(*now_from_key, pixel);
  Eigen::Matrix2d lean;
  lean << MapPixel(*now_from_key, pixel + Eigen::Vector2d::UnitX()) - view.pixel,
      MapPixel(*now_from_key, pixel + Eigen::Vector2d::UnitY()) - view.pixel;
  view.zoom = std::sqrt(std::abs(lean.determinant()));
  return view;
}

Eigen::Matrix3d KeyFromNow(const PatchView& view, const Eigen::Matrix2d& A,
                           const Eigen::Vector2d& place) {
  const Eigen::Matrix2d back = A.inverse();
  Eigen::Matrix3d predicted_from_now = Eigen::Matrix3d::Identity();
  predicted_from_now.topLeftCorner<2, 2>() = back;
  predicted_from_now.topRightCorner<2, 1>() = view.pixel - back * place;
  return view.now_from_key.inverse() * predicted_from_now;
}

}  // namespace palace
