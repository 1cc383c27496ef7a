// Transitions of the state machine, one function a state.
#include <cmath>
#include <cstdio>

#include "engine/mission/mission.h"

namespace palace {
namespace {

constexpr double kNoLiveAfter_s = 5;
constexpr double kLinkDrop_s = 5;    // F19
constexpr double kSensorDrop_s = 1;  // pose and cameras: F01, F10
constexpr double kMapDrop_s = 3;
constexpr double kHoldShown_s = 3;     // a person must be able to read why
constexpr double kAbortSettles_s = 2;  // a hover reported sooner may be the one before the abort
constexpr double kLandedHeight_m = 0.5;
constexpr double kLandedSpeed_mps = 0.3;

/// "Left camera stale, 1.8 s", empty when the age is known and within the limit.
std::string WhyOlder(const char* what, double age_s, double limit_s) {
  if (age_s <= limit_s) {
    return {};
  }
  char text[96];
  std::snprintf(text, sizeof text, std::isfinite(age_s) ? "%s stale, %.1f s" : "%s never received",
                what, age_s);
  return text;
}

}  // namespace

void Mission::Step(const MissionInputs& in) {
  switch (status_.state) {
    case MissionState::kNoLive:
    case MissionState::kSearch:
    case MissionState::kProposed:
      StepSearching(in);
      break;
    case MissionState::kArmed:
      StepArmed(in);
      break;
    case MissionState::kApproved:
      StepApproved(in);
      break;
    case MissionState::kDescending:
      StepDescending(in);
      break;
    case MissionState::kHold:
      StepHold(in);
      break;
    case MissionState::kAborting:
      StepAborting(in);
      break;
    case MissionState::kLanded:
      break;
  }
}

void Mission::StepSearching(const MissionInputs& in) {
  const bool live =
      in.source_kind != SourceKind::kNone && watch_.LeftCameraAge(in.now) <= kNoLiveAfter_s;
  const MissionState state = status_.state;
  if (!live) {
    if (state != MissionState::kNoLive) {
      winner_ = {};
      Enter(MissionState::kNoLive, WhyOlder("Cameras", watch_.LeftCameraAge(in.now), 0), in.now);
    }
    return;
  }
  if (state == MissionState::kNoLive) {
    Enter(MissionState::kSearch, "Cameras are live", in.now);
  } else if (state == MissionState::kSearch && WinnerStands(in.now)) {
    const LandingSite* site = FindSite(winner_.id);
    Enter(MissionState::kProposed,
          "Site " + std::string(1, site != nullptr ? site->letter : '?') + " won " +
              std::to_string(winner_.maps) + " maps",
          in.now);
  } else if (state == MissionState::kProposed && !WinnerStands(in.now)) {
    Enter(MissionState::kSearch, WhyNoProposal(in.now), in.now);
  }
}

std::string Mission::WhyNoProposal(Timestamp now) const {
  if (SecondsBetween(map_seen_at_, now) > GuardLimits::map_s) {
    return "No new map";
  }
  if (facts_.sites.empty()) {
    return "No site stands on the newest map";
  }
  const LandingSite* best = status_.BestStanding(facts_.sites);
  return best == nullptr
             ? "Every site on the newest map is refused"
             : "Site " + std::string(1, best->letter) + " leads, not for long enough yet";
}

std::string Mission::WhyStale(Timestamp now) const {
  for (const std::string& why :
       {WhyOlder("Vehicle status", watch_.LinkAge(now), kLinkDrop_s),
        WhyOlder("Vehicle pose", watch_.PoseAge(now), kSensorDrop_s),
        WhyOlder("Left camera", watch_.LeftCameraAge(now), kSensorDrop_s),
        WhyOlder("Right camera", watch_.RightCameraAge(now), kSensorDrop_s),
        WhyOlder("Map", SecondsBetween(map_seen_at_, now), kMapDrop_s)}) {
    if (!why.empty()) {
      return why;
    }
  }
  return {};
}

std::string Mission::WhyDrop(const MissionInputs& in) const {
  if (watch_.rebooted() || watch_.boot_id() != armed_.boot_id) {
    return "Vehicle restarted";
  }
  if (watch_.clock_stepped()) {
    return "Vehicle clock stepped";
  }
  if (in.settings_hash != armed_.settings_hash ||
      facts_.terrain_settings_hash != armed_.terrain_settings_hash) {
    return "Limits changed";
  }
  if (in.calibration_hash != armed_.calibration_hash) {
    return "Calibration changed";
  }
  if (SiteLost(in.now)) {
    return site_.reason();
  }
  return WhyStale(in.now);
}

void Mission::StepArmed(const MissionInputs& in) {
  if (!armed_.first_sequence) {
    armed_.first_sequence = in.snapshot_sequence + 1;
    armed_.shown_since = in.now;
  }
  std::string why = WhyDrop(in);
  if (why.empty() && status_.arm_expires && in.now >= *status_.arm_expires) {
    why = "Arm window is over, select the site again";
  }
  if (!why.empty()) {
    Drop(std::move(why), in.now);
  }
}

void Mission::StepApproved(const MissionInputs& in) {
  using Phase = MissionStatus::ApprovalPhase;
  const auto& vehicle = watch_.vehicle();
  const bool executing = Executing() && OwnApproval(vehicle->approval_id);
  if (executing && status_.approval_phase == Phase::kSent) {
    // Its answer was lost, its deed says the same.
    status_.approval_phase = Phase::kAccepted;
    status_.approval_answer_s = SecondsBetween(approved_now_, in.now);
    vision_allowed_ = true;
    repeating_.reset();
  }
  std::string why = WhyDrop(in);
  if (!why.empty()) {
    executing ? Hold(std::move(why), in.now) : Drop(std::move(why), in.now);
    return;
  }
  if (vehicle && vehicle->mode == VehicleMode::kAbort) {
    Abort("Vehicle aborts by itself", in.now);
  } else if (executing && vehicle->mode != VehicleMode::kAlign) {
    Enter(MissionState::kDescending, "Vehicle descends to " + SiteName(), in.now);
    vision_good_at_ = in.now;
  } else if (!executing && watch_.VehicleTime(in.now) >= status_.approval->expires_at) {
    Drop("Approval expired before the descent began", in.now);
  }
}

std::string Mission::WhyHold(const MissionInputs& in) const {
  const auto& vehicle = watch_.vehicle();
  if (watch_.rebooted()) {
    return "Vehicle restarted";
  }
  if (vehicle->mode == VehicleMode::kHold) {
    return "Vehicle holds by itself";
  }
  if (vehicle->mode == VehicleMode::kHover || !OwnApproval(vehicle->approval_id)) {
    return "Vehicle left the descent";
  }
  const double height_m = HeightAboveSite();
  if (height_m < facts_.commit_height_m) {
    // The last verdict stands; pictures and maps may end here.
    return WhyOlder("Vehicle status", watch_.LinkAge(in.now), kLinkDrop_s);
  }
  if (!std::isfinite(height_m)) {
    return "Height above the site is unknown";
  }
  if (SiteLost(in.now)) {
    return site_.reason();
  }
  if (status_.approval->provisional && !armed_.confirmed &&
      height_m <= GuardLimits::confirm_height_m) {
    return "Site " + std::string(1, status_.armed->letter) + " is not confirmed by 10 m above it";
  }
  return WhyStale(in.now);
}

void Mission::StepDescending(const MissionInputs& in) {
  if (HasLanded(in)) {
    Land(in);
    return;
  }
  const auto& vehicle = watch_.vehicle();
  if (vehicle->mode == VehicleMode::kAbort) {
    Abort("Vehicle aborts by itself", in.now);
    return;
  }
  if (vehicle->mode == VehicleMode::kLanded) {
    return;  // the second sign is still missing
  }
  const bool on_vision = in.navigation.handover == NavigationStatus::Handover::kVision;
  const double outage_s = SecondsBetween(vision_good_at_, in.now);
  if (on_vision && outage_s > facts_.limits.max_vision_outage_s) {
    char why[64];
    std::snprintf(why, sizeof why, "Vision lost for %.1f s, limit %.1f s", outage_s,
                  facts_.limits.max_vision_outage_s);
    // Without vision the last metres are not a place to hover.
    HeightAboveSite() < facts_.commit_height_m ? Abort(why, in.now) : Hold(why, in.now);
    return;
  }
  std::string why = WhyHold(in);
  if (!why.empty()) {
    Hold(std::move(why), in.now);
  }
}

void Mission::StepHold(const MissionInputs& in) {
  if (HasLanded(in)) {
    Land(in);
    return;
  }
  const auto& vehicle = watch_.vehicle();
  if (vehicle && vehicle->mode == VehicleMode::kAbort) {
    Abort("Vehicle aborts by itself", in.now);
    return;
  }
  const bool stopped =
      vehicle && (vehicle->mode == VehicleMode::kHold || vehicle->mode == VehicleMode::kHover) &&
      watch_.LinkAge(in.now) <= GuardLimits::link_s;
  if (stopped && repeating_ && SecondsBetween(status_.since, in.now) >= GuardLimits::link_s) {
    repeating_.reset();
  }
  if (stopped && SecondsBetween(status_.since, in.now) >= kHoldShown_s && WinnerStands(in.now)) {
    ForgetSite();
    Enter(MissionState::kProposed, "Vehicle hovers, sites re-evaluated", in.now);
  }
}

void Mission::StepAborting(const MissionInputs& in) {
  const auto& vehicle = watch_.vehicle();
  bool over = !vehicle_ever_heard_;  // nobody there: nothing to wait for
  if (vehicle) {
    const bool flies_it = vehicle->mode == VehicleMode::kAbort;
    abort_seen_ = abort_seen_ || flies_it;
    const bool hovers =
        vehicle->mode == VehicleMode::kHover || vehicle->mode == VehicleMode::kLanded;
    over = abort_seen_ && hovers && SecondsBetween(status_.since, in.now) >= kAbortSettles_s;
  }
  if (abort_seen_) {
    repeating_.reset();
  }
  if (over && wave_off_acknowledged_) {
    repeating_.reset();
    ForgetSite();
    Enter(MissionState::kSearch, "Wave-off complete and acknowledged", in.now);
  }
}

bool Mission::HasLanded(const MissionInputs&) const {
  const auto& vehicle = watch_.vehicle();
  if (!vehicle || !vehicle->on_ground || !status_.armed) {
    return false;
  }
  const bool estimate_agrees =
      std::abs(HeightAboveSite()) <= kLandedHeight_m && facts_.v_WB.norm() <= kLandedSpeed_mps;
  return vehicle->mode == VehicleMode::kLanded || estimate_agrees;
}

void Mission::Land(const MissionInputs& in) {
  const Eigen::Vector3d miss = facts_.skid_centre_W - status_.armed->p_WS;
  if (miss.allFinite()) {
    status_.touchdown_miss_m = miss.head<2>().norm();
  }
  if (!in.bundle.truth.empty()) {
    // The skid centre's place on the airframe is the same for estimate and truth.
    const Eigen::Vector3d skid_from_body = facts_.skid_centre_W - in.p_WB_estimate;
    const Eigen::Vector3d true_skid = in.bundle.truth.back().X_WB.p + skid_from_body;
    status_.touchdown_miss_true_m = (true_skid - status_.armed->p_WS).head<2>().norm();
  }
  repeating_.reset();
  Enter(MissionState::kLanded, "Vehicle is on the ground at " + SiteName(), in.now);
}

}  // namespace palace
