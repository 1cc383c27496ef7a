#include "engine/navigation/vision_fix.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/rotation_vector.h"
#include "engine/navigation/monocular_position.h"
#include "engine/tracking/camera_resection.h"
#include "engine/tracking/landmark_placement.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLandmarkScatter_px = 0.08;
constexpr double kLeastScatter_m = 0.001;
// The position of the one picture that placed the landmarks, less that of the map's: 15.1 mm rms
// over 60 axes of simulated hovers, under GPS of 2 cm at 5 Hz.
constexpr double kPlaceSigma_m = 0.015;
// Of the height above the site that placed the landmarks, by the median of hundreds of ranges: with
// all else 1 mm rms in six approaches. What the map says of the site's own height is added.
constexpr double kPlaceHeightSigma_m = 0.001;
constexpr double kLaserSigma_m = 0.03;
constexpr double kLaserPerMetre = 0.001;
constexpr double kGroundSigma_m = 0.02;  // level ground, site against laser spot
constexpr int kManyLandmarks = 12;

/// Of the landmarks beside the place that the site is told at. The mean noise of a map's attitudes
/// placed the site, too; heights are those of ranges, however they are turned.
Vector3d PlaceSigma(const LandingSite& site, const Vector3d& placed_from_W, double noise_rad) {
  const Vector3d from_m = placed_from_W - site.p_WS;
  const double turn_rad = site.frames_fused > 0 ? noise_rad / std::sqrt(site.frames_fused) : 0;
  const double told_m = site.height_m.three_sigma / 3;
  const double height_m = std::isfinite(told_m) ? told_m : kGroundSigma_m;  // records may not say
  return {std::hypot(kPlaceSigma_m, turn_rad * std::hypot(from_m.y(), from_m.z())),
          std::hypot(kPlaceSigma_m, turn_rad * std::hypot(from_m.x(), from_m.z())),
          std::hypot(height_m, kPlaceHeightSigma_m)};
}

Result<MonocularPosition> SevenSteps(const MonocularInput& input, const Matrix3d& R_WB,
                                     const Vector3d& lever_B, Vector3d& p_WB) {
  MonocularInput turned = input;
  turned.attitude = EulerFromRotation(R_WB);
  Result<MonocularPosition> position = PositionFromPixel(turned);
  if (position) {
    p_WB = BodyFromCamera(position->p_WC, turned.attitude, lever_B);
  }
  return position;
}

}  // namespace

bool TrackIsTrusted(const TrackResult& track, const TrackingSettings& settings) {
  if (!track.status.locked || track.landmarks.empty()) {
    return false;
  }
  if (track.status.coherence >= settings.min_coherence) {
    return true;
  }
  const int count = static_cast<int>(track.landmarks.size());
  return count >= kManyLandmarks && 2 * track.landmarks.size() >= track.status.features.size();
}

Result<VisionFix> FixFromLandmarks(const TrackResult& track, const PinholeCamera& camera,
                                   const StereoRig& rig, const Matrix3d& R_WB,
                                   const LandingSite& site, const AttitudeErrors& attitude,
                                   const std::optional<FeltBias>& felt,
                                   const LandmarkFrame& frame) {
  // Their places are the same in every picture: they are no scatter.
  std::vector<GroundLandmark> landmarks = track.landmarks;
  for (GroundLandmark& landmark : landmarks) {
    landmark.sigma_px = kLandmarkScatter_px;
    landmark.sigma_w_m = 0;
  }
  const RigidTransform X_BC = rig.X_BC();
  ResectionOptions options;
  options.attitude_sigma_rad = std::max(std::numbers::sqrt2 * attitude.noise_rad, Rad(0.02));
  const Result<Resection> resection = ResectCamera(landmarks, camera, R_WB * X_BC.R, options);
  if (!resection) {
    return resection.error();
  }
  const RigidTransform X_WB_resected = resection->X_WC * X_BC.Inverse();
  VisionFix fix;
  fix.frame = frame;
  fix.frame.Add({track.time, resection->X_WC, R_WB * X_BC.R, R_WB, felt}, attitude);
  const RigidTransform X_WB = fix.frame.Levelled(X_WB_resected, site.p_WS);
  fix.measurement.time = track.time;
  fix.measurement.p_WB = X_WB.p;
  fix.measurement.p_covariance_m2 =
      resection->covariance_m2 + kLeastScatter_m * kLeastScatter_m * Matrix3d::Identity();
  fix.shared = {.p_WS = site.p_WS,
                .placed_from_W = fix.frame.placed_from_W(),
                .turns_rad2 = fix.frame.left_rad2(),
                .place_m = PlaceSigma(site, fix.frame.placed_from_W(), attitude.noise_rad)};
  fix.frame_shift_W = X_WB.p - frame.Levelled(X_WB_resected, site.p_WS).p;
  fix.attitude_correction_W = VectorFromRotation(X_WB.R * R_WB.transpose());
  return fix;
}

Result<VisionFix> FixFromSitePixel(const TrackResult& track, const PinholeCamera& camera,
                                   const StereoRig& rig, const Matrix3d& R_WB, double laser_m,
                                   const LandingSite& site, const AttitudeErrors& attitude) {
  const GroundLandmark& mark = track.landmarks.front();
  MonocularInput input;
  input.tilt_rad = rig.tilt_rad;
  input.focal_x_px = camera.fx_px;
  input.focal_y_px = camera.fy_px;
  input.pixel = mark.pixel - Eigen::Vector2d(camera.cx_px, camera.cy_px);
  input.laser_m = laser_m;
  input.p_WS = site.p_WS;
  const Vector3d& lever_B = rig.position_body_m;
  Vector3d p_WB;
  const Result<MonocularPosition> position = SevenSteps(input, R_WB, lever_B, p_WB);
  if (!position) {
    return position.error();
  }
  // First order: each input is moved by its own standard deviation.
  Matrix3d scatter_m2 = Matrix3d::Zero();
  const auto add = [&](const MonocularInput& moved, const Matrix3d& R_WB_moved) {
    Vector3d p_WB_moved;
    if (SevenSteps(moved, R_WB_moved, lever_B, p_WB_moved)) {
      scatter_m2 += (p_WB_moved - p_WB) * (p_WB_moved - p_WB).transpose();
    }
  };
  for (int i = 0; i < 3; ++i) {
    add(input, RotationFromVector(attitude.noise_rad * Vector3d::Unit(i)) * R_WB);
  }
  for (int i = 0; i < 2; ++i) {
    MonocularInput moved = input;
    moved.pixel[i] += mark.sigma_px;
    add(moved, R_WB);
  }
  MonocularInput moved = input;
  moved.laser_m += kLaserSigma_m + kLaserPerMetre * laser_m;
  add(moved, R_WB);
  VisionFix fix;
  fix.measurement.time = track.time;
  fix.measurement.p_WB = p_WB;
  fix.measurement.p_covariance_m2 =
      scatter_m2 + kLeastScatter_m * kLeastScatter_m * Matrix3d::Identity();
  // The pose that laid the mark on the ground erred like any other.
  const double laid_m = mark.sigma_w_m * std::max(1.0, attitude.noise_rad / kPlaceSigmaPerDepth);
  fix.shared = {
      .p_WS = site.p_WS, .place_m = Vector3d(laid_m, laid_m, 0), .height_m = kGroundSigma_m};
  fix.shared.turns_rad2.bottomRightCorner<3, 3>() =
      attitude.bias_rad * attitude.bias_rad * Matrix3d::Identity();
  return fix;
}

}  // namespace palace
