#include "engine/simulation/autopilot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/text.h"

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr double kHoldAfter_s = 0.5;
constexpr double kAbortAfter_s = 2.0;
constexpr double kOutageClimb_m = 10.0;
constexpr int kEstimatesBeforeUse = 5;
constexpr double kHandOverSpeed_mps = 0.5;
constexpr double kLeverAverage_s = 2.0;
constexpr double kPathLag_m = 1.0;
constexpr double kSettleError_m = 0.15;
constexpr double kSettleSpeed_mps = 0.15;
// Long enough for the station to see the mode, also when there is nothing left to climb, or to fly.
constexpr double kShortestAbort_s = 1.0;
constexpr double kShortestGo_s = 1.5;
constexpr TravelLimits kGoSpeeds{2.0, 0.4};
constexpr double kThere_m = 0.5, kThere_mps = 0.4, kThere_rad = Rad(3);
constexpr double kBraking_mps2 = 0.8;
constexpr const char* kNotInHover = "the vehicle is not in hover";

}  // namespace

Autopilot::Autopilot(const AutopilotOptions& options)
    : options_(options),
      stop_{options.gains.max_speed_mps, kBraking_mps2},
      gate_(options.trust, options.limits),
      controller_(options.gains),
      hold_p_W_(options.hover_p_WB),
      hover_down_m_(options.hover_p_WB.z()),
      skid_lever_W_(options.vehicle.skid_centre_B) {
  reference_.p_W = options.hover_p_WB;
  yaw_reference_rad_ = options.hover_yaw_rad;
  gps_.p_WB = flown_.p_WB = options.hover_p_WB;
}

Vector3d Autopilot::StoppingPoint(const Vector3d& p, const Vector3d& v) const {
  return p + v * (v.norm() / (2 * stop_.acceleration_mps2));
}

std::vector<CommandAck> Autopilot::TakeAcks() {
  std::vector<CommandAck> taken;
  taken.swap(acks_);
  return taken;
}

void Autopilot::Acknowledge(std::uint64_t id, const std::string& refusal, Timestamp now) {
  acks_.push_back({now, id, refusal.empty() ? AckResult::kAccepted : AckResult::kRefused, refusal});
}

void Autopilot::Receive(const VehicleMessage& message, const VehicleSituation& vehicle) {
  const Timestamp now = vehicle.now;
  if (const auto* approval = std::get_if<Approval>(&message)) {
    ReceiveApproval(*approval, vehicle);
  } else if (const auto* estimate = std::get_if<PositionEstimate>(&message)) {
    ReceiveEstimate(*estimate, now);
  } else if (const auto* hold = std::get_if<HoldRequest>(&message)) {
    ReceiveHold(*hold, now);
  } else if (const auto* abort = std::get_if<AbortRequest>(&message)) {
    ReceiveAbort(*abort, now);
  } else if (const auto* go = std::get_if<GoRequest>(&message)) {
    ReceiveGo(*go, vehicle);
  } else if (const auto* request = std::get_if<SessionRequest>(&message)) {
    ReceiveRequest(*request, now);
  }
}

void Autopilot::ReceiveRequest(const SessionRequest& request, Timestamp now) {
  using Answer = VehicleAuthority::Answer;
  const Answer answer = gate_.authority().Take(request, now);
  if (answer == Answer::kGranted || answer == Answer::kReleased) {
    GiveUp(answer == Answer::kGranted ? "Command was handed over" : "Command was given back", now);
  }
}

void Autopilot::GiveUp(const std::string& why, Timestamp now) {
  if (approval_ && mode_ != VehicleMode::kLanded) {
    Acknowledge(approval_->id, why, now);
    EnterHold();
  } else if (mode_ == VehicleMode::kGo) {
    EnterHold();
  }
}

bool Autopilot::IsFree() const {
  return mode_ == VehicleMode::kHover || mode_ == VehicleMode::kHold || mode_ == VehicleMode::kGo;
}

void Autopilot::ReceiveGo(const GoRequest& go, const VehicleSituation& vehicle) {
  const std::string refusal = gate_.Admit(go, vehicle, IsFree() ? "" : kNotInHover);
  Acknowledge(go.command_id, refusal, vehicle.now);
  if (!refusal.empty()) {
    return;
  }
  go_from_W_ = StoppingPoint(reference_.p_W, reference_.v_W);
  hold_p_W_ = go.p_WB;
  hover_down_m_ = std::min(hover_down_m_, go.p_WB.z());
  go_heading_rad_ = go.heading_rad;
  go_time_s_ = 0;
  go_leaves_ = false;
  mode_ = VehicleMode::kGo;
}

void Autopilot::ReceiveApproval(const Approval& approval, const VehicleSituation& vehicle) {
  const Timestamp now = vehicle.now;
  if (gate_.IsRepeat(approval)) {
    Acknowledge(approval.id, {}, now);
    return;
  }
  const std::string refusal = gate_.Admit(approval, vehicle, IsFree() ? "" : kNotInHover);
  Acknowledge(approval.id, refusal, now);
  if (!refusal.empty()) {
    return;
  }
  approval_ = approval;
  path_ = PathOf(approval, options_.vehicle);
  slope_.height_m = std::max(path_.SkidHeight(reference_.p_W), kSettleHeight_m);
  last_estimate_.reset();
  last_arrival_.reset();
  estimates_seen_ = 0;
  mode_ = VehicleMode::kAlign;
}

void Autopilot::ReceiveEstimate(const PositionEstimate& estimate, Timestamp now) {
  if (!gate_.Admit(estimate, now).empty()) {
    return;
  }
  const bool usable = approval_ && estimate.source == EstimateSource::kVision && estimate.healthy &&
                      estimate.approval_id == approval_->id && estimate.p_WB.allFinite() &&
                      estimate.v_WB.allFinite() && estimate.time <= now &&
                      (!last_estimate_ || estimate.time > last_estimate_->time);
  if (!usable) {
    return;
  }
  if (const std::string apart = vision_ ? watch_.Judge(estimate) : ""; !apart.empty()) {
    GiveUp(apart, now);
    return;
  }
  if (vision_ && !vision_->Update(estimate)) {
    return;
  }
  last_estimate_ = estimate;
  last_arrival_ = now;
  ++estimates_seen_;
}

void Autopilot::ReceiveHold(const HoldRequest& request, Timestamp now) {
  std::string refusal = gate_.Admit(request, now);
  if (refusal.empty() && mode_ == VehicleMode::kLanded) {
    refusal = "on the ground";
  } else if (refusal.empty() && mode_ == VehicleMode::kAbort) {
    refusal = "climbing away";
  }
  if (refusal.empty()) {
    EnterHold();
  }
  Acknowledge(request.command_id, refusal, now);
}

void Autopilot::ReceiveAbort(const AbortRequest& request, Timestamp now) {
  if (mode_ == VehicleMode::kLanded) {
    Acknowledge(request.command_id, "on the ground, rotor thrust is off", now);
    return;
  }
  EnterAbort(hover_down_m_);
  Acknowledge(request.command_id, {}, now);
}

double Autopilot::VisionAge(Timestamp now) const {
  return last_arrival_ ? SecondsBetween(*last_arrival_, now)
                       : std::numeric_limits<double>::infinity();
}

void Autopilot::Propagate(Timestamp now, const Vector3d& a_W) {
  if (vision_) {
    vision_->Propagate(now, a_W);
  }
}

StickCommand Autopilot::Control(Timestamp now, const FlightState& gps, bool on_ground) {
  gps_ = gps;
  flown_ = gps;
  watch_.Propagate(now, gps.v_WB);
  if (flies_on_vision_) {
    flown_.p_WB = vision_->now().p_WB;
    flown_.v_WB = vision_->now().v_WB;
  }
  skid_lever_W_ += options_.control_period_s / kLeverAverage_s *
                   (gps.R_WB * options_.vehicle.skid_centre_B - skid_lever_W_);
  if (on_ground) {
    mode_ = VehicleMode::kLanded;
    flies_on_vision_ = false;
    vision_.reset();
    return {};
  }
  StepMode(now);
  const FlightSetpoint setpoint{reference_.p_W, reference_.v_W, yaw_reference_rad_, reference_.a_W};
  return controller_.Update(setpoint, flown_, options_.control_period_s);
}

void Autopilot::StepMode(Timestamp now) {
  const bool fresh = VisionAge(now) <= kHoldAfter_s;
  if (flies_on_vision_ && VisionAge(now) > kAbortAfter_s) {
    if (approval_) {
      Acknowledge(approval_->id,
                  WithNumbers("no position from vision for %.1f s, limit %.1f s", VisionAge(now),
                              kAbortAfter_s),
                  now);
    }
    // Never above the hover height the flight came from, never downwards.
    const double down = gps_.p_WB.z();
    EnterAbort(std::min(down, std::max(down - kOutageClimb_m, hover_down_m_)));
  }
  switch (mode_) {
    case VehicleMode::kAlign:
      StepAlign(now);
      break;
    case VehicleMode::kDescend:
      StepDescend(fresh);
      break;
    case VehicleMode::kSettle:
      StepSettle(now, fresh);
      break;
    case VehicleMode::kSink:
      StepSink(fresh);
      break;
    case VehicleMode::kAbort:
      StepAbort();
      break;
    case VehicleMode::kGo:
      StepGo();
      break;
    default:
      reference_.MoveTowards(hold_p_W_, stop_, options_.control_period_s);
      break;
  }
}

void Autopilot::StepAlign(Timestamp now) {
  const double dt = options_.control_period_s;
  if (now >= approval_->expires_at) {
    GiveUp("the approval expired before the descent began", now);
    return;
  }
  const Vector3d start = path_.BodyAt(slope_.height_m);
  reference_.MoveTowards(start, path_.speeds.align, dt);
  yaw_reference_rad_ =
      SlewAngle(yaw_reference_rad_, path_.heading_rad, path_.speeds.turn_rate_rad_s * dt);
  const double yaw = EulerFromRotation(gps_.R_WB).yaw_rad;
  const bool aligned = (gps_.p_WB - start).norm() < 0.5 && gps_.v_WB.norm() < 0.4 &&
                       std::abs(WrapAngle(yaw - path_.heading_rad)) < Rad(3);
  const bool vision_ready = estimates_seen_ >= kEstimatesBeforeUse &&
                            VisionAge(now) < kHoldAfter_s &&
                            (last_estimate_->v_WB - gps_.v_WB).norm() < kHandOverSpeed_mps;
  if (!aligned || !vision_ready) {
    return;
  }
  if (const std::string apart = watch_.Begin(last_estimate_->p_WB, gps_.p_WB); !apart.empty()) {
    GiveUp(apart, now);
  } else {
    vision_.emplace(now, *last_estimate_, InertialTrack::Point{now, gps_.p_WB, gps_.v_WB});
    HandOverToVision();
  }
}

void Autopilot::HandOverToVision() {
  const Vector3d shift = vision_->now().p_WB - gps_.p_WB;
  flown_.p_WB = vision_->now().p_WB;
  flown_.v_WB = vision_->now().v_WB;
  flies_on_vision_ = true;
  reference_.p_W += shift;
  slope_ = SlopeReference::From(path_, reference_.p_W);
  reference_.v_W.setZero();
  mode_ = VehicleMode::kDescend;
}

void Autopilot::StepDescend(bool fresh) {
  const bool keeps_up = (reference_.p_W - flown_.p_WB).norm() < kPathLag_m;
  slope_.Step(path_, fresh && keeps_up, options_.control_period_s, reference_);
  if (slope_.height_m > path_.speeds.slope_end_m) {
    return;
  }
  if (path_.IsLook()) {
    EnterHover(VehicleMode::kHover);
  } else {
    settle_time_s_ = settled_s_ = 0;
    mode_ = VehicleMode::kSettle;
  }
}

void Autopilot::StepSettle(Timestamp, bool fresh) {
  const double dt = options_.control_period_s;
  const Vector3d target = path_.p_WS - kSettleHeight_m * Vector3d::UnitZ() - skid_lever_W_;
  reference_.MoveTowards(fresh ? target : StoppingPoint(reference_.p_W, reference_.v_W),
                         path_.speeds.level, dt);
  settle_time_s_ += dt;
  // In gusts the tight tolerance may never hold; it widens, to less than the navigation error that
  // every clear radius includes.
  const double patience = std::clamp((settle_time_s_ - 15) / 15, 0.0, 1.0);
  const double tolerance = kSettleError_m + 0.3 * patience;
  const Vector3d error = flown_.p_WB - target;
  const bool settled = fresh && error.head<2>().norm() < tolerance && std::abs(error.z()) < 0.3 &&
                       flown_.v_WB.norm() < kSettleSpeed_mps + 0.3 * patience;
  settled_s_ = settled ? settled_s_ + dt : 0;
  if (settled_s_ >= 1.0) {
    slope_.height_m = kSettleHeight_m;
    slope_.rate_mps = 0;
    mode_ = VehicleMode::kSink;
  }
}

void Autopilot::StepSink(bool fresh) {
  const double dt = options_.control_period_s;
  slope_.rate_mps = Slew(slope_.rate_mps, fresh ? path_.speeds.touch_mps : 0,
                         (fresh ? 1 : 4) * path_.speeds.acceleration_mps2 * dt);
  slope_.height_m -= slope_.rate_mps * dt;
  reference_.p_W = path_.p_WS - slope_.height_m * Vector3d::UnitZ() - skid_lever_W_;
  reference_.v_W = {0, 0, slope_.rate_mps};
  reference_.a_W.setZero();
}

void Autopilot::StepAbort() {
  const double dt = options_.control_period_s;
  const Vector3d target(hold_p_W_.x(), hold_p_W_.y(), climb_to_down_m_);
  const TravelLimits travel{options_.limits.climb_rate_mps, 1.0};
  reference_.MoveTowards(target, travel, dt);
  abort_time_s_ += dt;
  if (abort_time_s_ >= kShortestAbort_s && (gps_.p_WB - target).norm() < 0.5 &&
      gps_.v_WB.norm() < 0.5) {
    hold_p_W_ = target;
    mode_ = VehicleMode::kHover;
  }
}

void Autopilot::StepGo() {
  const double dt = options_.control_period_s;
  go_time_s_ += dt;
  yaw_reference_rad_ =
      SlewAngle(yaw_reference_rad_, go_heading_rad_, path_.speeds.turn_rate_rad_s * dt);
  // Up and round first: the cameras then see the ground that it flies over.
  const Vector3d above(go_from_W_.x(), go_from_W_.y(), hold_p_W_.z());
  const bool turned = std::abs(WrapAngle(yaw_reference_rad_ - go_heading_rad_)) < kThere_rad;
  const bool ready = turned && std::abs(reference_.p_W.z() - above.z()) < kThere_m;
  go_leaves_ = go_leaves_ || ready;
  reference_.MoveTowards(go_leaves_ ? hold_p_W_ : above, kGoSpeeds, dt);
  const double yaw = EulerFromRotation(gps_.R_WB).yaw_rad;
  if (go_leaves_ && go_time_s_ >= kShortestGo_s && (gps_.p_WB - hold_p_W_).norm() < kThere_m &&
      gps_.v_WB.norm() < kThere_mps && std::abs(WrapAngle(yaw - go_heading_rad_)) < kThere_rad) {
    mode_ = VehicleMode::kHover;
  }
}

void Autopilot::ReturnToGps() {
  approval_.reset();
  flies_on_vision_ = false;
  vision_.reset();
  reference_.p_W = gps_.p_WB;
  reference_.v_W = gps_.v_WB;
  reference_.a_W.setZero();
  flown_ = gps_;
  yaw_reference_rad_ = EulerFromRotation(gps_.R_WB).yaw_rad;
  hold_p_W_ = StoppingPoint(reference_.p_W, reference_.v_W);
}

void Autopilot::EnterHover(VehicleMode mode) {
  ReturnToGps();
  mode_ = mode;
}

void Autopilot::EnterAbort(double target_down_m) {
  ReturnToGps();
  climb_to_down_m_ = std::min(target_down_m, gps_.p_WB.z());
  abort_time_s_ = 0;
  mode_ = VehicleMode::kAbort;
}

}  // namespace palace
