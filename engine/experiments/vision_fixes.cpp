#include "engine/experiments/vision_fixes.h"

#include <cmath>

#include "engine/navigation/monocular_position.h"
#include "engine/tracking/view_geometry.h"

namespace palace {
namespace {

constexpr double kWhite_px = 1;
constexpr double kWander_px = 1;
constexpr double kWanderTime_s = 10;
constexpr double kQuickest_s = 1.0 / 30, kSlowest_s = 0.1;
constexpr double kGrid_s = 0.1;

}  // namespace

VisionFixes::VisionFixes(const Options& options)
    : options_(options),
      noise_(options.seed, "vision fixes"),
      pace_(options.seed, "vision pace"),
      wander_px_(kWander_px * Eigen::Vector2d(noise_.Normal(), noise_.Normal())) {}

std::optional<VisionFixes::Told> VisionFixes::Advance(Timestamp now,
                                                      const RigidTransform& X_WB_true,
                                                      const Eigen::Matrix3d& R_WB) {
  std::optional<Told> told;
  if (under_way_ && now >= under_way_->told) {
    const bool late = options_.attitude == FixAttitude::kOnArrival;
    told = Measure(*under_way_, late ? R_WB : under_way_->R_WB);
    under_way_.reset();
  }
  const bool on_grid = !due_ || now >= *due_;
  if (!under_way_ && (options_.pace == FixPace::kAsFastAsItCan || on_grid)) {
    due_ = AddSeconds(due_.value_or(now), kGrid_s);
    under_way_ =
        Exposure{now, AddSeconds(now, pace_.Uniform(kQuickest_s, kSlowest_s)), X_WB_true, R_WB};
  }
  return told;
}

std::optional<VisionFixes::Told> VisionFixes::Measure(const Exposure& exposure,
                                                      const Eigen::Matrix3d& R_WB) {
  const double decay = std::exp(-SecondsBetween(exposure.time, exposure.told) / kWanderTime_s);
  for (double& px : wander_px_) {
    px = decay * px + kWander_px * std::sqrt(1 - decay * decay) * noise_.Normal();
  }
  const Eigen::Vector2d white_px(noise_.Normal(), noise_.Normal());
  const double of_laser = noise_.Normal();
  const PinholeCamera& camera = options_.rig.left.pinhole;
  const RigidTransform X_WC = exposure.X_WB * options_.rig.X_BC();
  const auto pixel = PixelFromWorldPoint(camera, X_WC, options_.p_WS);
  const double down = X_WC.R.col(2).z();
  if (!pixel || pixel->x() < 0 || pixel->y() < 0 || pixel->x() > camera.width - 1 ||
      pixel->y() > camera.height - 1 || down <= 0) {
    return std::nullopt;
  }
  const double range_m = (options_.p_WS.z() - X_WC.p.z()) / down;
  const double laser_m =
      range_m + (options_.laser.sigma_m + options_.laser.sigma_per_m * range_m) * of_laser;
  MonocularInput input;
  input.attitude = EulerFromRotation(R_WB);
  input.tilt_rad = options_.rig.tilt_rad;
  input.focal_x_px = camera.fx_px;
  input.focal_y_px = camera.fy_px;
  input.pixel =
      *pixel + kWhite_px * white_px + wander_px_ - Eigen::Vector2d(camera.cx_px, camera.cy_px);
  input.laser_m = laser_m;
  input.p_WS = options_.p_WS;
  const Result<MonocularPosition> position = PositionFromPixel(input);
  if (!position) {
    return std::nullopt;
  }
  const double distance_m = position->P_IF.norm();
  const Eigen::Vector3d along = position->P_IF / distance_m;
  const double along_m = options_.laser.sigma_m + options_.laser.sigma_per_m * range_m;
  const double across_m = distance_m * std::hypot(std::hypot(kWhite_px, kWander_px) / camera.fx_px,
                                                  options_.attitude_noise_rad);
  const Eigen::Matrix3d along2 = along * along.transpose();
  Told told;
  told.fix.time = exposure.time;
  told.fix.p_WB = BodyFromCamera(position->p_WC, input.attitude, options_.rig.position_body_m);
  told.fix.p_covariance_m2 =
      along_m * along_m * along2 + across_m * across_m * (Eigen::Matrix3d::Identity() - along2);
  told.error_m = told.fix.p_WB - exposure.X_WB.p;
  return told;
}

}  // namespace palace
