#include "engine/experiments/handover_flight.h"

#include <algorithm>
#include <cmath>

namespace palace {
namespace {

constexpr double kAfter_s = 10;
constexpr double kFade_s = 1.05;         // the cross-fade's second, and what stamps are rounded by
constexpr double kSameMoment_s = 0.011;  // half a step of control, in which the truth is told

}  // namespace

void HandoverOnlooker::Look(const VelocitySeen& seen) {
  const PositionEstimate& sent = seen.sent;
  const bool on_vision = sent.source == EstimateSource::kVision;
  if (!on_vision && (sent.source != EstimateSource::kGps || switched_)) {
    return;
  }
  const Eigen::Vector3d error = sent.v_WB - seen.true_v_WB;
  const double change_mps = error_ ? (error - *error_).norm() : NAN;
  if (!on_vision) {
    if (error_) {
      usual_.Add(error - *error_);
    }
    if (seen.vision_v_WB) {
      hover_.Add(*seen.vision_v_WB - seen.true_v_WB);
    }
  } else if (!switched_) {
    switched_ = sent.time;
    seen_.step_mps = seen_.first_step_mps = change_mps;
    seen_.gap_mps = seen.vision_v_WB ? (*seen.vision_v_WB - seen.gps_v_WB).norm() : NAN;
  } else if (SecondsBetween(*switched_, sent.time) <= kFade_s) {
    seen_.step_mps = std::max(seen_.step_mps, change_mps);
  } else {
    faded_ = true;
  }
  if (on_vision) {
    descent_.Add(error);
  }
  error_ = error;
}

bool HandoverOnlooker::IsOver(Timestamp now) const {
  return switched_ && SecondsBetween(*switched_, now) > kAfter_s;
}

HandoverFlight HandoverOnlooker::Seen() const {
  HandoverFlight seen = seen_;
  if (!faded_) {
    seen.step_mps = NAN;
  }
  seen.usual_mps = usual_.Rms().norm();
  seen.hover_rms_mps = hover_.Rms();
  seen.descent_rms_mps = descent_.Rms();
  return seen;
}

Result<HandoverFlight> FlyHandover(const MissionFlight& flight, const SceneCameraFactory& camera) {
  HandoverOnlooker onlooker;
  const auto watch = [&](const EngineSnapshot& snapshot, const PositionEstimate* sent) {
    const auto& truth = snapshot.sensors->truth;
    if (sent != nullptr && sent->time == snapshot.time && truth &&
        std::abs(SecondsBetween(truth->time, sent->time)) <= kSameMoment_s) {
      const NavigationStatus& navigation = snapshot.flight->navigation;
      VelocitySeen seen{*sent, truth->v_WB, navigation.gps.estimate.v_WB};
      if (navigation.vision.running) {
        seen.vision_v_WB = navigation.vision.estimate.v_WB;
      }
      onlooker.Look(seen);
    }
    return !onlooker.IsOver(snapshot.time);
  };
  const Result<FlownMission> flown = FlyMission(flight, camera, watch);
  if (!flown) {
    return flown.error();
  }
  return onlooker.Seen();
}

}  // namespace palace
