#include "engine/navigation/vision_fix.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"
#include "engine/navigation/monocular_position.h"
#include "engine/tracking/camera_resection.h"

namespace palace {
namespace {

constexpr double kCommonSigma_m = 0.01;       // shared by all landmarks, at any distance
constexpr double kCommonPerDistance = 0.002;  // shared, as a share of the distance
constexpr double kLaserSigma_m = 0.03;
constexpr double kGroundSigma_m = 0.10;  // site against laser spot, assumption 1 of the thesis
constexpr double kAttitudeSigma_rad = Rad(0.3);
constexpr double kTemplateSigma_px = 1.0;
constexpr int kManyLandmarks = 12;

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
                                   const StereoRig& rig, const Eigen::Matrix3d& R_WB) {
  const RigidTransform X_BC = rig.X_BC();
  const Result<Resection> resection = ResectCamera(track.landmarks, camera, R_WB * X_BC.R);
  if (!resection) {
    return resection.error();
  }
  const RigidTransform X_WB = resection->X_WC * X_BC.Inverse();
  double distance_m = 0;
  for (const GroundLandmark& landmark : track.landmarks) {
    distance_m +=
        (landmark.p_WF - resection->X_WC.p).norm() / static_cast<double>(track.landmarks.size());
  }
  const double common_m = kCommonSigma_m + kCommonPerDistance * distance_m;
  VisionFix fix;
  fix.measurement.time = track.time;
  fix.measurement.p_WB = X_WB.p;
  fix.measurement.p_covariance_m2 =
      resection->covariance_m2 + common_m * common_m * Eigen::Matrix3d::Identity();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(X_WB.R * R_WB.transpose()));
  fix.attitude_correction_W = turn.angle() * turn.axis();
  return fix;
}

Result<VisionFix> FixFromSitePixel(const TrackResult& track, const PinholeCamera& camera,
                                   const StereoRig& rig, const Eigen::Matrix3d& R_WB,
                                   double laser_m, const LandingSite& site) {
  MonocularInput input;
  input.attitude = EulerFromRotation(R_WB);
  input.tilt_rad = rig.tilt_rad;
  input.focal_x_px = camera.fx_px;
  input.focal_y_px = camera.fy_px;
  input.pixel = track.landmarks.front().pixel - Eigen::Vector2d(camera.cx_px, camera.cy_px);
  input.laser_m = laser_m;
  input.p_WS = site.p_WS;
  const Result<MonocularPosition> position = PositionFromPixel(input);
  if (!position) {
    return position.error();
  }
  // Along the ray: laser, and the ground's unevenness seen along the ray. Across: pixel, attitude.
  const double range_m = position->P_IF.norm();
  const Eigen::Vector3d along = position->P_IF / range_m;
  const double sigma_along_m = std::hypot(
      kLaserSigma_m, kGroundSigma_m * range_m / position->Z_IC_m, kAttitudeSigma_rad * range_m);
  const double sigma_across_m =
      range_m * std::hypot(kTemplateSigma_px / camera.fx_px, kAttitudeSigma_rad);
  const Eigen::Matrix3d along2 = along * along.transpose();
  VisionFix fix;
  fix.measurement.time = track.time;
  fix.measurement.p_WB = BodyFromCamera(position->p_WC, input.attitude, rig.position_body_m);
  fix.measurement.p_covariance_m2 =
      sigma_along_m * sigma_along_m * along2 +
      sigma_across_m * sigma_across_m * (Eigen::Matrix3d::Identity() - along2);
  return fix;
}

}  // namespace palace
