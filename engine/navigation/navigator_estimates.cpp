// What Navigator tells: its estimates, the pose of a picture, and its status.
#include <cmath>

#include "engine/core/rotation_vector.h"
#include "engine/navigation/navigator.h"

namespace palace {
namespace {

constexpr double kGpsSilence_s = 1.5;
constexpr double kPoseSilence_s = 0.5;

PositionEstimate Told(const FilterEstimate& state) {
  PositionEstimate estimate;
  estimate.time = state.time;
  estimate.p_WB = state.p_WB;
  estimate.v_WB = state.v_WB;
  estimate.sigma_p_m = state.sigma_p_m;
  estimate.sigma_v_mps = state.sigma_v_mps;
  return estimate;
}

}  // namespace

void Navigator::UpdateStatus() {
  status_.gravity = gravity_watch_.status();
  status_.gps.running = gps_.running();
  status_.gps.estimate = GpsEstimate(now_);
  status_.gps.residual_sigma = gps_.residual_sigma();
  status_.gps.max_residual_sigma = gps_.max_residual_sigma();
  status_.gps.rejected_in_row = gps_.rejected_in_row();
  const auto coasting_s = [&](const PositionFilter& filter) {
    return filter.running() ? SecondsBetween(filter.last_accepted(), now_) : NAN;
  };
  status_.gps.coasting_s = coasting_s(gps_);
  status_.vision.coasting_s = coasting_s(vision_);
  status_.vision.running = vision_.running();
  status_.vision.estimate = vision_.running() ? VisionEstimate(now_) : PositionEstimate{};
  status_.vision.residual_sigma = vision_.residual_sigma();
  status_.vision.max_residual_sigma = vision_.max_residual_sigma();
  status_.vision.rejected_in_row = vision_.rejected_in_row();
  status_.handover = handover_.state();
  status_.handover_reason = handover_.reason();
}

PositionEstimate Navigator::PoseEstimate(Timestamp now) const {
  PositionEstimate estimate;
  estimate.time = now;
  const std::optional<VehiclePose> pose = poses_.At(now);
  if (!pose) {
    return estimate;
  }
  estimate.p_WB = pose->X_WB.p;
  estimate.v_WB = pose->v_WB;
  estimate.source = have_pose_stream_ ? EstimateSource::kGps : EstimateSource::kNone;
  estimate.healthy =
      have_pose_stream_ && SecondsBetween(poses_.newest().time, now) <= kPoseSilence_s;
  return estimate;
}

PositionEstimate Navigator::GpsEstimate(Timestamp now) const {
  if (!gps_.running()) {
    return PoseEstimate(now);
  }
  PositionEstimate estimate = Told(gps_.EstimateAt(now));
  estimate.source = EstimateSource::kGps;
  estimate.healthy = SecondsBetween(gps_.last_accepted(), now) <= kGpsSilence_s;
  return estimate;
}

PositionEstimate Navigator::VisionEstimate(Timestamp now) const {
  PositionEstimate estimate = Told(*VisionFilterAt(now));
  estimate.source = EstimateSource::kVision;
  estimate.healthy = handover_.Healthy(now);
  return estimate;
}

PositionEstimate Navigator::EstimateInForce(Timestamp now) const {
  PositionEstimate estimate =
      handover_.state() == Handover::State::kVision ? VisionEstimate(now) : GpsEstimate(now);
  estimate.v_WB = fade_.Faded(estimate.v_WB, now);
  return estimate;
}

RigidTransform Navigator::PredictBodyPose(Timestamp exposure) const {
  RigidTransform X_WB;
  if (const std::optional<VehiclePose> pose = poses_.At(exposure)) {
    X_WB = pose->X_WB;
    if (handover_.state() == Handover::State::kVision) {
      X_WB.R = RotationFromVector(attitude_correction_W_) * X_WB.R;
    }
  }
  if (gps_.running() || handover_.state() == Handover::State::kVision) {
    X_WB.p = EstimateInForce(exposure).p_WB;
  }
  return X_WB;
}

}  // namespace palace
