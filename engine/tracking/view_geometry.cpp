#include "engine/tracking/view_geometry.h"

namespace palace {
namespace {

constexpr double kMinDepth_m = 0.05;
constexpr double kMinGrazing = 0.052;  // sin 3 deg

Eigen::Matrix3d CameraMatrix(const PinholeCamera& camera) {
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K(0, 0) = camera.fx_px;
  K(1, 1) = camera.fy_px;
  K(0, 2) = camera.cx_px;
  K(1, 2) = camera.cy_px;
  return K;
}

}  // namespace

std::optional<Eigen::Vector2d> PixelFromCameraPoint(const PinholeCamera& camera,
                                                    const Eigen::Vector3d& p_C) {
  if (!(p_C.z() >= kMinDepth_m)) {
    return std::nullopt;
  }
  return Eigen::Vector2d(camera.fx_px * p_C.x() / p_C.z() + camera.cx_px,
                         camera.fy_px * p_C.y() / p_C.z() + camera.cy_px);
}

std::optional<Eigen::Vector2d> PixelFromWorldPoint(const PinholeCamera& camera,
                                                   const RigidTransform& X_WC,
                                                   const Eigen::Vector3d& p_W) {
  return PixelFromCameraPoint(camera, X_WC.R.transpose() * (p_W - X_WC.p));
}

std::optional<double> PlaneDepth(const PinholeCamera& camera, const RigidTransform& X_WC,
                                 const GroundPlane& plane, const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d ray_W = X_WC.R * RayFromPixel(camera, pixel);
  const double falling = -plane.normal_W.dot(ray_W);
  const double height_m = plane.HeightOf(X_WC.p);
  if (!(height_m > 0 && falling > kMinGrazing * ray_W.norm())) {
    return std::nullopt;
  }
  return height_m / falling;
}

std::optional<Eigen::Matrix3d> PlaneHomography(const PinholeCamera& camera,
                                               const RigidTransform& X_WA,
                                               const RigidTransform& X_WB,
                                               const GroundPlane& plane) {
  const double height_m = plane.HeightOf(X_WA.p);
  if (!(height_m > kMinDepth_m)) {
    return std::nullopt;
  }
  // In A the plane is n'p = d with n pointing away from the camera, so that d > 0.
  const Eigen::Vector3d n_A = -(X_WA.R.transpose() * plane.normal_W);
  const RigidTransform X_BA = X_WB.Inverse() * X_WA;
  const Eigen::Matrix3d K = CameraMatrix(camera);
  const Eigen::Matrix3d H = K * (X_BA.R + X_BA.p * n_A.transpose() / height_m) * K.inverse();
  return H / H.norm();
}

Eigen::Vector2d MapPixel(const Eigen::Matrix3d& b_from_a, const Eigen::Vector2d& pixel) {
  return (b_from_a * pixel.homogeneous()).hnormalized();
}

bool InPicture(const PinholeCamera& camera, const Eigen::Vector2d& pixel, double margin_px) {
  return pixel.x() >= margin_px && pixel.y() >= margin_px &&
         pixel.x() <= camera.width - 1 - margin_px && pixel.y() <= camera.height - 1 - margin_px;
}

}  // namespace palace
