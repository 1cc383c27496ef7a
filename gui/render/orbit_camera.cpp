#include "gui/render/orbit_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/frames.h"

namespace palace {
namespace {

constexpr double kNear_m = 0.3;
constexpr double kFar_m = 2000;
constexpr double kRadPerPixel = 0.006;
constexpr double kHighest_rad = 1.5707;
constexpr double kMargin = 1.12;

}  // namespace

void OrbitCamera::SetPreset(View3dPreset preset) {
  preset_ = preset;
  zoom_ = 1;
  pan_W_.setZero();
  wanted_azimuth_rad_ = preset == View3dPreset::kAbove    ? 0.0
                        : preset == View3dPreset::kBehind ? heading_rad_
                                                          : 0.62;
  wanted_elevation_rad_ = preset == View3dPreset::kOrbit     ? 0.42
                          : preset == View3dPreset::kAbove   ? kHighest_rad
                          : preset == View3dPreset::kOblique ? 0.7
                                                             : 0.35;
}

void OrbitCamera::Drag(double dx_px, double dy_px) {
  preset_.reset();
  azimuth_rad_ = WrapAngle(azimuth_rad_ - kRadPerPixel * dx_px);
  elevation_rad_ = std::clamp(elevation_rad_ + kRadPerPixel * dy_px, 0.03, kHighest_rad);
  wanted_azimuth_rad_ = azimuth_rad_;
  wanted_elevation_rad_ = elevation_rad_;
}

void OrbitCamera::Pan(double dx_px, double dy_px, double view_height_px) {
  preset_.reset();
  const double metres_per_px =
      2 * DistanceFor(1) * std::tan(field_of_view_rad() / 2) / std::max(view_height_px, 1.0);
  const Eigen::Vector3d right(-std::sin(azimuth_rad_), std::cos(azimuth_rad_), 0);
  const Eigen::Vector3d ahead(std::cos(azimuth_rad_), std::sin(azimuth_rad_), 0);
  pan_W_ += metres_per_px * (ahead * dy_px - right * dx_px);
}

void OrbitCamera::Zoom(double steps) {
  zoom_ = std::clamp(zoom_ * std::pow(0.88, steps), 0.08, 6.0);
}

void OrbitCamera::Frame(const Eigen::Vector3d& p_WVehicle, const Eigen::Vector3d& p_WGround,
                        double radius_m, double heading_rad) {
  top_W_ = p_WVehicle;
  ground_W_ = p_WGround;
  radius_m_ = radius_m;
  heading_rad_ = heading_rad;
  if (preset_ == View3dPreset::kBehind) {
    wanted_azimuth_rad_ = heading_rad;
  }
}

void OrbitCamera::Advance(double dt_s) {
  // Ease-out: 96 % of the way in 0.25 s.
  const double share = std::isinf(dt_s) ? 1 : 1 - std::exp(-std::max(dt_s, 0.0) / 0.075);
  azimuth_rad_ = WrapAngle(azimuth_rad_ + share * WrapAngle(wanted_azimuth_rad_ - azimuth_rad_));
  elevation_rad_ += share * (wanted_elevation_rad_ - elevation_rad_);
}

namespace {

/// R_WE of the eye: right, down, forward.
Eigen::Matrix3d EyeRotation(double azimuth_rad, double elevation_rad) {
  const double ca = std::cos(azimuth_rad), sa = std::sin(azimuth_rad);
  const double ce = std::cos(elevation_rad), se = std::sin(elevation_rad);
  const Eigen::Vector3d forward(ce * ca, ce * sa, se);
  const Eigen::Vector3d right(-sa, ca, 0);
  Eigen::Matrix3d R_WE;
  R_WE << right, forward.cross(right), forward;
  return R_WE;
}

}  // namespace

/// So far that the vehicle and the circle on the ground are inside the picture. A point at (x, y,
/// z) in eye axes from the target needs distance >= |x| / tan(half view) - z.
double OrbitCamera::DistanceFor(double aspect) const {
  const Eigen::Matrix3d R_EW = EyeRotation(azimuth_rad_, elevation_rad_).transpose();
  const double ty = std::tan(field_of_view_rad() / 2) / kMargin;
  const double tx = ty * aspect;
  const Eigen::Vector3d target = (top_W_ + ground_W_) / 2;
  double distance = 3;
  const auto include = [&](const Eigen::Vector3d& p_W) {
    const Eigen::Vector3d q = R_EW * (p_W - target);
    distance = std::max({distance, std::abs(q.x()) / tx - q.z(), std::abs(q.y()) / ty - q.z()});
  };
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * std::numbers::pi * i / 12;
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0);
    include(ground_W_ + radius_m_ * out);
    include(top_W_ + 2.0 * out - Eigen::Vector3d::UnitZ());
  }
  include({top_W_.x(), top_W_.y(), ground_W_.z()});
  return distance * zoom_;
}

Eigen::Vector3d OrbitCamera::eye_W() const {
  return (top_W_ + ground_W_) / 2 + pan_W_ -
         EyeRotation(azimuth_rad_, elevation_rad_).col(2) * DistanceFor(1);
}

RigidTransform OrbitCamera::X_WE(double aspect) const {
  const Eigen::Matrix3d R_WE = EyeRotation(azimuth_rad_, elevation_rad_);
  return {R_WE, (top_W_ + ground_W_) / 2 + pan_W_ - R_WE.col(2) * DistanceFor(aspect)};
}

Eigen::Matrix4d OrbitCamera::ClipFromWorld(double width_px, double height_px) const {
  const double aspect = width_px / height_px;
  const RigidTransform eye = X_WE(aspect);
  Eigen::Matrix4d eye_from_world = Eigen::Matrix4d::Identity();
  eye_from_world.topLeftCorner<3, 3>() = eye.R.transpose();
  eye_from_world.topRightCorner<3, 1>() = -(eye.R.transpose() * eye.p);
  const double ty = std::tan(field_of_view_rad() / 2);
  // y stays down: row 0 of the texture is the top of the picture.
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 1 / (ty * aspect);
  clip(1, 1) = 1 / ty;
  clip(2, 2) = (kFar_m + kNear_m) / (kFar_m - kNear_m);
  clip(2, 3) = -2 * kFar_m * kNear_m / (kFar_m - kNear_m);
  clip(3, 2) = 1;
  return clip * eye_from_world;
}

}  // namespace palace
