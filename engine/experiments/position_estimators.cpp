#include "engine/experiments/position_estimators.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "engine/core/median.h"
#include "engine/core/units.h"
#include "engine/tracking/view_geometry.h"

namespace palace {
namespace {

constexpr double kPoor_rad = Rad(0.3);
constexpr double kPoseRate_hz = 50;
constexpr double kFromFeature_m = 0.5, kAroundFeature_m = 2.5;  // ground that tells its height
constexpr int kMinRanges = 100;
constexpr int kRangeStep_px = 4;
constexpr double kFollowedSigma_px = 0.2;

AhrsNoise NoiseOf(AttitudeQuality quality) {
  return quality == AttitudeQuality::kPoor ? AhrsNoise{kPoor_rad, kPoor_rad, 300, 0} : AhrsNoise{};
}

}  // namespace

const char* NameOf(PositionEstimator estimator) {
  switch (estimator) {
    case PositionEstimator::kResection:
      return "resection";
    case PositionEstimator::kSevenSteps:
      return "seven-steps";
    case PositionEstimator::kThesisTemplate:
      return "thesis-template";
  }
  return "";
}

const char* NameOf(AttitudeQuality attitude) {
  switch (attitude) {
    case AttitudeQuality::kPerfect:
      return "perfect";
    case AttitudeQuality::kVehicle:
      return "vehicle";
    case AttitudeQuality::kPoor:
      return "0.3 deg";
  }
  return "";
}

AttitudeErrors StatedErrors(AttitudeQuality attitude, const AhrsNoise& vehicle) {
  const AhrsNoise noise = attitude == AttitudeQuality::kVehicle ? vehicle : NoiseOf(attitude);
  return {noise.white_rad, noise.bias_rad};
}

double PositionError::NeesPerDof() const { return e_m.dot(covariance_m2.ldlt().solve(e_m)) / 3; }

Eigen::Vector3d PositionError::NeesOfAxes() const {
  return e_m.cwiseAbs2().cwiseQuotient(covariance_m2.diagonal());
}

AttitudeOf::AttitudeOf(AttitudeQuality quality, std::uint64_t seed)
    : quality_(quality), sensor_(NoiseOf(quality), kPoseRate_hz, seed) {}

std::shared_ptr<const FrameBundle> AttitudeOf::Told(
    const std::shared_ptr<const FrameBundle>& bundle, const ConeApproach& approach) {
  if (quality_ == AttitudeQuality::kVehicle) {
    return bundle;
  }
  const auto told = [&](const VehiclePose& pose) {
    const Eigen::Matrix3d R_WB = approach.TruePoseAt(pose.time).R;
    return quality_ == AttitudeQuality::kPerfect ? R_WB : sensor_.Measure(R_WB);
  };
  auto changed = std::make_shared<FrameBundle>(*bundle);
  for (VehiclePose& pose : changed->poses) {
    pose.X_WB.R = told(pose);
  }
  if (std::optional<VehiclePose>& exposed = changed->pose_at_exposure) {
    const auto same = std::find_if(changed->poses.begin(), changed->poses.end(),
                                   [&](const VehiclePose& p) { return p.time == exposed->time; });
    exposed->X_WB.R = same != changed->poses.end() ? same->X_WB.R : told(*exposed);
  }
  return changed;
}

EstimatorRun::EstimatorRun(PositionEstimator estimator, const TrackingSettings& settings,
                           const AttitudeErrors& attitude, const Eigen::Vector3d& p_W_feature)
    : estimator_(estimator), settings_(settings), p_W_feature_(p_W_feature) {
  settings_.mode = estimator == PositionEstimator::kThesisTemplate ? TrackerMode::kTemplate
                                                                   : TrackerMode::kPlane;
  navigator_.SetAttitudeErrors(attitude);
  navigator_.AllowVision(true);
}

void EstimatorRun::MapSite(const MeasuredPicture& picture, const RigidTransform& X_WC,
                           const Eigen::Vector2d& pixel) {
  const ImageF& depth_m = picture.range.depth_m;
  std::vector<double> down_m;
  for (int y = 0; y < depth_m.height(); y += kRangeStep_px) {
    for (int x = 0; x < depth_m.width(); x += kRangeStep_px) {
      const double z = double{depth_m.at(x, y)};
      if (!std::isfinite(z)) {
        continue;
      }
      const Eigen::Vector3d p_W = X_WC * (z * RayFromPixel(picture.camera, {x, y}));
      const double from_m = (p_W - p_W_feature_).head<2>().norm();
      if (from_m > kFromFeature_m && from_m < kAroundFeature_m) {
        down_m.push_back(p_W.z());
      }
    }
  }
  if (down_m.size() < static_cast<std::size_t>(kMinRanges)) {
    return;
  }
  const Eigen::Vector3d ray_W = X_WC.R * RayFromPixel(picture.camera, pixel);
  site_sum_ += X_WC.p + (UpperMedian(down_m) - X_WC.p.z()) / ray_W.z() * ray_W;
  ++site_count_;
}

TrackResult EstimatorRun::Track(const MeasuredPicture& picture, const RigidTransform& X_WC,
                                const FollowedFeature* followed, Timestamp time) {
  if (estimator_ != PositionEstimator::kSevenSteps) {
    return tracker_.Track(picture.left, picture.camera, X_WC, &picture.range, settings_, time);
  }
  TrackResult track;
  track.time = time;
  track.status.locked = followed != nullptr && followed->state != FollowState::kLost;
  if (track.status.locked) {
    track.status.coherence = followed->coherence;
    track.landmarks.push_back({site_->p_WS, followed->pixel, kFollowedSigma_px, 0});
  }
  return track;
}

PositionError EstimatorRun::ErrorOf(const Eigen::Vector3d& p_WB,
                                    const Eigen::Matrix3d& covariance_m2,
                                    const Eigen::Vector3d& p_WB_true) const {
  return {(p_WB - site_->p_WS) - (p_WB_true - p_W_feature_), covariance_m2};
}

void EstimatorRun::AddPicture(const FrameBundle& bundle, const StereoRig& rig,
                              const MeasuredPicture& picture, const RigidTransform& X_WB_true,
                              const FollowedFeature* followed, bool tell) {
  const Timestamp time = bundle.stereo->time;
  const RigidTransform X_WC = navigator_.PredictBodyPose(time) * rig.X_BC();
  if (!site_) {
    const auto pixel = PixelFromWorldPoint(picture.camera, X_WB_true * rig.X_BC(), p_W_feature_);
    if (pixel && InPicture(picture.camera, *pixel, 0)) {
      MapSite(picture, X_WC, *pixel);
    }
    if (!tell || site_count_ == 0) {
      return;
    }
    site_.emplace();
    site_->id = 1;
    site_->p_WS = site_sum_ / site_count_;
    site_->frames_fused = site_count_;
    if (estimator_ != PositionEstimator::kSevenSteps) {
      tracker_.Lock(picture.left, picture.camera, X_WC, &picture.range, *site_, settings_, time);
    }
    navigator_.StartVision(*site_, time);
  }
  const TrackResult track = Track(picture, X_WC, followed, time);
  const bool judged = navigator_.VisionFilterAt(time).has_value();
  const int refused = navigator_.status().vision.rejected_in_row;
  navigator_.AddVision(track, picture.camera, rig, bundle, settings_);
  PositionSample sample;
  sample.time = time;
  sample.true_m = X_WB_true.p - p_W_feature_;
  const NavigationStatus& status = navigator_.status();
  if (status.vision_measured) {
    const PositionMeasurement fix = *navigator_.VisionPosition();
    sample.raw = ErrorOf(fix.p_WB, fix.p_covariance_m2, X_WB_true.p);
    sample.refused = status.vision.rejected_in_row > refused;
    sample.nis_per_dof = judged ? status.vision.residual_sigma * status.vision.residual_sigma : NAN;
  }
  if (const std::optional<FilterEstimate> filter = navigator_.VisionFilterAt(time)) {
    sample.filtered = ErrorOf(filter->p_WB, filter->p_covariance_m2, X_WB_true.p);
  }
  samples_.push_back(std::move(sample));
}

}  // namespace palace
