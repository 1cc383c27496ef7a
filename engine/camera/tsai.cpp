#include "engine/camera/tsai.h"

#include <array>
#include <cmath>

#include "engine/camera/polynomial.h"

namespace palace {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;

std::optional<Eigen::Vector2d> Project(const TsaiModel& model, const Eigen::Vector3d& p_FQ,
                                       Matrix23* dpixel_dp) {
  const Eigen::Matrix3d R_CF = RotationOfTsai(model);
  const Eigen::Vector3d p = R_CF * p_FQ + model.T;
  if (!p.allFinite() || !(p.z() > 0)) {
    return std::nullopt;
  }
  const Eigen::Vector2d undistorted = model.f / p.z() * p.head<2>();
  const double radius = undistorted.norm();
  const auto distorted = InvertRadial(std::array<double, 2>{1, model.kappa1}, radius);
  if (!distorted) {
    return std::nullopt;
  }
  const double shrink = radius > 0 ? *distorted / radius : 1;
  const Eigen::Vector2d sensor = shrink * undistorted;
  const Eigen::Vector2d scale(model.sx / model.dpx, 1 / model.dpy);
  const Eigen::Vector2d pixel(scale.x() * sensor.x() + model.Cx_px,
                              scale.y() * sensor.y() + model.Cy_px);
  if (!pixel.allFinite()) {
    return std::nullopt;
  }
  if (dpixel_dp != nullptr) {
    // The undistorting direction is explicit; its 2x2 derivative is inverted.
    const Eigen::Matrix2d undistort =
        (1 + model.kappa1 * sensor.squaredNorm()) * Eigen::Matrix2d::Identity() +
        2 * model.kappa1 * sensor * sensor.transpose();
    Matrix23 dundistorted_dp;
    dundistorted_dp << model.f / p.z(), 0, -undistorted.x() / p.z(),  //
        0, model.f / p.z(), -undistorted.y() / p.z();
    *dpixel_dp = scale.asDiagonal() * undistort.inverse() * dundistorted_dp * R_CF;
  }
  return pixel;
}

}  // namespace

Eigen::Matrix3d RotationOfTsai(const TsaiModel& model) {
  return (Eigen::AngleAxisd(model.Rz_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(model.Ry_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(model.Rx_rad, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

void SetRotationOfTsai(TsaiModel& model, const Eigen::Matrix3d& R_CF) {
  model.Rx_rad = std::atan2(R_CF(2, 1), R_CF(2, 2));
  model.Ry_rad = std::atan2(-R_CF(2, 0), std::hypot(R_CF(2, 1), R_CF(2, 2)));
  model.Rz_rad = std::atan2(R_CF(1, 0), R_CF(0, 0));
}

std::optional<Eigen::Vector2d> ProjectTsai(const TsaiModel& model, const Eigen::Vector3d& p_FQ) {
  return Project(model, p_FQ, nullptr);
}

std::optional<ProjectionJacobian> JacobianOfTsai(const TsaiModel& model,
                                                 const Eigen::Vector3d& p_FQ) {
  ProjectionJacobian result;
  const auto pixel = Project(model, p_FQ, &result.dpixel_dp);
  if (!pixel) {
    return std::nullopt;
  }
  result.pixel = *pixel;
  return result;
}

std::optional<CameraRay> RayFromPixelTsai(const TsaiModel& model, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d sensor((pixel.x() - model.Cx_px) * model.dpx / model.sx,
                               (pixel.y() - model.Cy_px) * model.dpy);
  const double square = sensor.squaredNorm();
  if (!std::isfinite(square) || !(1 + 3 * model.kappa1 * square > 0)) {
    return std::nullopt;
  }
  const Eigen::Vector2d undistorted = (1 + model.kappa1 * square) * sensor;
  const Eigen::Matrix3d R_FC = RotationOfTsai(model).transpose();
  const Eigen::Vector3d direction =
      R_FC * Eigen::Vector3d(undistorted.x() / model.f, undistorted.y() / model.f, 1);
  return CameraRay{-(R_FC * model.T), direction.normalized()};
}

}  // namespace palace
