#include "engine/navigation/navigator.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kImuMemory_s = 2.0;
constexpr double kImuGap_s = 0.1;
constexpr double kGpsNoise_mps2 = 0.1;
constexpr double kBiasWalk_mps3 = 0.005;  // AHRS attitude errors wander through gravity like a bias
constexpr double kGpsVelocitySigma_mps = 0.1;
constexpr double kGpsDefaultSigma_m = 2.5;
constexpr double kPoseOfFix_s = 0.2;  // no position is made with an attitude older than this
constexpr int kGpsRestartAfter = 15;
constexpr int kVisionRestartAfter = 5;
constexpr double kLaserAge_s = 0.3;
constexpr double kCorrectionGain = 0.1;
constexpr double kMaxCorrection_rad = Rad(0.5);

ProcessNoise Noise(double accel_mps2) {
  return {Eigen::Vector3d::Constant(accel_mps2), kBiasWalk_mps3};
}

PositionMeasurement GpsMeasurement(const GpsFix& fix) {
  const double horizontal_m =
      fix.sigma_horizontal_m > 0 ? fix.sigma_horizontal_m : kGpsDefaultSigma_m;
  const double vertical_m = fix.sigma_vertical_m > 0 ? fix.sigma_vertical_m : kGpsDefaultSigma_m;
  PositionMeasurement measurement;
  measurement.time = fix.time;
  measurement.p_WB = fix.p_WB;
  measurement.p_covariance_m2 =
      Eigen::Vector3d(horizontal_m, horizontal_m, vertical_m).cwiseAbs2().asDiagonal();
  if (fix.v_WB.allFinite()) {
    measurement.v_WB = fix.v_WB;
  }
  measurement.sigma_v_mps = kGpsVelocitySigma_mps;
  return measurement;
}

/// A fix whose position is not believed: the filter goes on with its velocity.
PositionMeasurement VelocityOnly(PositionMeasurement measurement, const FilterEstimate& predicted) {
  constexpr double kNothingKnown_m2 = 1e6;
  measurement.p_WB = predicted.p_WB;
  measurement.p_covariance_m2 = kNothingKnown_m2 * Eigen::Matrix3d::Identity();
  return measurement;
}

}  // namespace

Navigator::Navigator() = default;

void Navigator::Reset() { *this = Navigator(); }

void Navigator::AddSensors(const FrameBundle& bundle) {
  now_ = std::max(now_, bundle.time);
  have_pose_stream_ = have_pose_stream_ || !bundle.poses.empty();
  if (bundle.pose_at_exposure) {
    poses_.Add(*bundle.pose_at_exposure);
  }
  for (const VehiclePose& pose : bundle.poses) {
    poses_.Add(pose);
  }
  for (const ImuSample& sample : bundle.imu) {
    AddImu(sample);
  }
  carried_v_WB_ = EstimateInForce(now_).v_WB;
  for (const GpsFix& fix : bundle.gps) {
    AddGps(fix);
  }
  for (const LaserRange& laser : bundle.laser) {
    if (std::isfinite(laser.range_m) && laser.range_m > 0) {
      laser_ = laser;
    }
  }
  status_.vision_measured = false;
  UpdateHandover(now_);
  UpdateStatus();
}

void Navigator::AddImu(const ImuSample& sample) {
  if (!sample.specific_force_B.allFinite() || (!imu_.empty() && sample.time <= imu_.back().time)) {
    return;
  }
  ImuRecord record{sample.time, sample.specific_force_B, sample.specific_force_B,
                   Eigen::Matrix3d::Identity()};
  Timestamp middle = sample.time;
  if (!imu_.empty() && SecondsBetween(imu_.back().time, sample.time) <= kImuGap_s) {
    // Mean force and mid-way attitude: second order over the step.
    record.mean_force_B = 0.5 * (sample.specific_force_B + imu_.back().specific_force_B);
    middle.us = imu_.back().time.us + (sample.time.us - imu_.back().time.us) / 2;
  }
  const std::optional<VehiclePose> pose = poses_.At(middle);
  if (!pose) {
    return;
  }
  record.R_WB = pose->X_WB.R;
  imu_.push_back(record);
  if (AttitudeKnown(record.time)) {
    gravity_watch_.AddImu(record.time, record.mean_force_B, record.R_WB);
  }
  while (SecondsBetween(imu_.front().time, imu_.back().time) > kImuMemory_s) {
    imu_.pop_front();
  }
  for (PositionFilter* filter : {&gps_, &vision_}) {
    if (filter->running()) {
      filter->AddImu(record.time, record.mean_force_B, record.R_WB);
    }
  }
}

void Navigator::AddGps(const GpsFix& fix) {
  if (!fix.p_WB.allFinite()) {
    return;
  }
  const std::optional<FilterEstimate> predicted =
      gps_.running() ? std::optional(gps_.EstimateAt(fix.time)) : std::nullopt;
  // A prediction through an attitude that is gone speaks against nobody.
  gps_watch_.Add(fix, AttitudeKnown(fix.time) ? predicted : std::nullopt);
  status_.gps_agreement = gps_watch_.status();
  if (status_.gps_agreement.off) {
    gravity_watch_.Interrupt();
  } else {
    gravity_watch_.AddGps(fix);
  }
  const bool settled_elsewhere = gps_watch_.SettledElsewhere() && !site_;
  const PositionMeasurement measurement = status_.gps_agreement.off && predicted
                                              ? VelocityOnly(GpsMeasurement(fix), *predicted)
                                              : GpsMeasurement(fix);
  if (gps_.running()) {
    if (!settled_elsewhere) {
      gps_.AddFix(measurement);
      // Under a site that is watched, or while GPS is doubted, the position never moves.
      if (gps_.rejected_in_row() < kGpsRestartAfter || site_ || status_.gps_agreement.off) {
        return;
      }
    }
    ++frame_moves_;
    gps_watch_ = {};
  }
  RestartGps(fix);
}

void Navigator::RestartGps(const GpsFix& fix) {
  const PositionMeasurement measurement = GpsMeasurement(fix);
  FilterSeed seed;
  seed.time = fix.time;
  seed.p_WB = fix.p_WB;
  seed.p_covariance_m2 = measurement.p_covariance_m2;
  const std::optional<VehiclePose> pose = poses_.At(fix.time);
  seed.v_WB = measurement.v_WB ? *measurement.v_WB
              : pose           ? pose->v_WB
                               : Eigen::Vector3d(Eigen::Vector3d::Zero());
  StartFilter(gps_, seed, Noise(kGpsNoise_mps2));
}

void Navigator::StartFilter(PositionFilter& filter, const FilterSeed& seed,
                            const ProcessNoise& noise) const {
  filter.Start(seed, noise);
  for (const ImuRecord& record : imu_) {
    if (record.time > seed.time) {
      filter.AddImu(record.time, record.mean_force_B, record.R_WB);
    }
  }
}

void Navigator::StartVision(const LandingSite& site, Timestamp time) {
  StopVision();
  site_ = site;
  handover_.Start(time);
  UpdateStatus();
}

void Navigator::StopVision() {
  const bool was_in_force = handover_.state() == Handover::State::kVision;
  const Eigen::Vector3d old_v_WB = EstimateInForce(now_).v_WB;
  handover_.Stop();
  vision_.Reset();
  site_.reset();
  vision_fix_.reset();
  landmark_frame_ = {};
  attitude_correction_W_.setZero();
  if (was_in_force) {
    fade_.Stop();
    fade_.Start(now_, old_v_WB, EstimateInForce(now_).v_WB);
  }
  UpdateStatus();
}

void Navigator::AllowVision(bool allowed) { handover_.Allow(allowed); }

bool Navigator::AttitudeKnown(Timestamp time) const {
  return !poses_.empty() && SecondsBetween(poses_.newest().time, time) <= kPoseOfFix_s;
}

Result<VisionFix> Navigator::MakeFix(const TrackResult& track, const PinholeCamera& camera,
                                     const StereoRig& rig, const FrameBundle& bundle) {
  std::optional<VehiclePose> pose = bundle.pose_at_exposure;
  if (!pose && AttitudeKnown(track.time)) {
    pose = poses_.At(track.time);
  }
  if (!pose) {
    return UnavailableError("no attitude for the picture");
  }
  const AttitudeErrors errors =
      attitude_errors_.value_or(AttitudeErrors{.noise_rad = pose->sigmas.attitude_rad});
  if (track.landmarks.size() > 1) {
    return FixFromLandmarks(track, camera, rig, pose->X_WB.R, *site_, errors,
                            Felt(track.time, pose->X_WB.R), landmark_frame_);
  }
  if (!laser_ || std::abs(SecondsBetween(laser_->time, track.time)) > kLaserAge_s) {
    return UnavailableError("no laser range with the picture");
  }
  return FixFromSitePixel(track, camera, rig, pose->X_WB.R, laser_->range_m, *site_, errors);
}

std::optional<FeltBias> Navigator::Felt(Timestamp time, const Eigen::Matrix3d& R_WB) const {
  const PositionFilter& filter = vision_.running() ? vision_ : gps_;
  if (!filter.running() || imu_.empty() || SecondsBetween(imu_.back().time, time) > kImuGap_s) {
    return std::nullopt;
  }
  const FilterEstimate estimate = filter.EstimateAt(time);
  return FeltBias{R_WB * estimate.bias_B, estimate.sigma_bias_mps2.maxCoeff()};
}

void Navigator::AddVision(const TrackResult& track, const PinholeCamera& camera,
                          const StereoRig& rig, const FrameBundle& bundle,
                          const TrackingSettings& settings) {
  status_.vision_measured = false;
  if (site_ && TrackIsTrusted(track, settings)) {
    if (const Result<VisionFix> fix = MakeFix(track, camera, rig, bundle)) {
      // Who is not believed where the vehicle is, is not believed how the ground is turned.
      if (AddVisionFix(fix->AsBefore(), settings.accel_noise_mps2)) {
        vision_.Shift(fix->frame_shift_W);
        vision_fix_ = *fix;
        landmark_frame_ = fix->frame;
        Correct(fix->attitude_correction_W);
      } else {
        vision_fix_->measurement = fix->AsBefore();
      }
      status_.vision_measured = true;
      status_.vision_p_WB = vision_fix_->measurement.p_WB;
    }
  }
  UpdateHandover(now_);
  UpdateStatus();
}

void Navigator::Correct(const Eigen::Vector3d& attitude_W) {
  attitude_correction_W_ += kCorrectionGain * (attitude_W - attitude_correction_W_);
  const double size = attitude_correction_W_.norm();
  if (size > kMaxCorrection_rad) {
    attitude_correction_W_ *= kMaxCorrection_rad / size;
  }
}

std::optional<PositionMeasurement> Navigator::VisionPosition() const {
  if (!vision_fix_) {
    return std::nullopt;
  }
  PositionMeasurement position = vision_fix_->measurement;
  position.p_covariance_m2 += vision_fix_->shared.CovarianceAt(position.p_WB);
  return position;
}

std::optional<FilterEstimate> Navigator::VisionFilterAt(Timestamp time) const {
  if (!vision_.running()) {
    return std::nullopt;
  }
  FilterEstimate estimate = vision_.EstimateAt(time);
  estimate.p_covariance_m2 += vision_fix_->shared.CovarianceAt(estimate.p_WB);
  estimate.sigma_p_m = estimate.p_covariance_m2.diagonal().cwiseSqrt();
  return estimate;
}

FilterSeed Navigator::VisionSeed(const PositionMeasurement& fix) const {
  FilterSeed seed;
  seed.time = fix.time;
  seed.p_WB = fix.p_WB;
  seed.p_covariance_m2 = vision_.variance_factor() * fix.p_covariance_m2;
  if (gps_.running()) {
    const FilterEstimate gps = gps_.EstimateAt(fix.time);
    seed.v_WB = gps.v_WB;
    seed.bias_B = gps.bias_B;
    seed.sigma_bias_mps2 = gps.sigma_bias_mps2.maxCoeff();
  } else if (const std::optional<VehiclePose> pose = poses_.At(fix.time)) {
    seed.v_WB = pose->v_WB;
  }
  return seed;
}

bool Navigator::AddVisionFix(const PositionMeasurement& fix, double accel_noise_mps2) {
  if (!vision_.running()) {
    StartFilter(vision_, VisionSeed(fix), Noise(accel_noise_mps2));
    handover_.AddFix({fix.time, true, 0, VelocityGap(fix.time)});
    return true;
  }
  vision_.SetProcessNoise(Noise(accel_noise_mps2));
  const FixOutcome outcome = vision_.AddFix(fix);
  if (outcome == FixOutcome::kTooOld) {
    return false;
  }
  const bool accepted = outcome == FixOutcome::kAccepted;
  handover_.AddFix(
      {fix.time, accepted, vision_.nis(), VelocityGap(fix.time), vision_.variance_factor()});
  // Nobody flies on it yet: better a fresh start than a filter that is lost.
  if (handover_.state() != Handover::State::kVision &&
      vision_.rejected_in_row() >= kVisionRestartAfter) {
    vision_.Stop();
    handover_.Start(fix.time);
  }
  return accepted;
}

double Navigator::VelocityGap(Timestamp time) const {
  const Eigen::Vector3d v_WB = vision_.EstimateAt(time).v_WB;
  if (gps_.running()) {
    return (v_WB - gps_.EstimateAt(time).v_WB).norm();
  }
  const std::optional<VehiclePose> pose = poses_.At(time);
  return pose && have_pose_stream_ ? (v_WB - pose->v_WB).norm() : 0.0;
}

void Navigator::UpdateHandover(Timestamp time) {
  const PositionEstimate before = EstimateInForce(time);
  if (!handover_.Advance(time)) {
    return;
  }
  fade_.Stop();
  const PositionEstimate after = EstimateInForce(time);
  // From what was sent last: a GPS fix that comes with the hand-over would step the velocity as it
  // leaves.
  fade_.Start(time, carried_v_WB_, after.v_WB);
  status_.offset_m = (after.p_WB - before.p_WB).norm();
}

}  // namespace palace
