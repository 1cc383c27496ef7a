#include "engine/mission/states.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/mission/alarms/alarms.h"
#include "engine/mission/descent_limits.h"
#include "engine/mission/geometry.h"
#include "engine/mission/guards.h"
#include "engine/mission/limits.h"
#include "engine/mission/wave_off.h"
#include "engine/mission/wording.h"
#include "engine/model/find_site.h"
#include "engine/model/mission/landed_place.h"

namespace palace {
namespace {

constexpr double kHoldShown_s = 3;  // a person must be able to read why
constexpr double kLandedHeight_m = 0.5;
constexpr double kLandedSpeed_mps = 0.3;
constexpr double kLookedWithin_m = 1.5;  // the reference is there, the vehicle nearly

std::string WhyNoProposal(const MissionMemory& m, Timestamp now) {
  if (SecondsBetween(m.map_seen_at, now) > GuardLimits::map_s) {
    return words::kNoNewMap;
  }
  if (m.facts.sites.empty()) {
    return words::kNoSiteStands;
  }
  const LandingSite* best = m.status.BestStanding(m.facts.sites);
  return best == nullptr ? words::kEverySiteRefused : words::SiteLeads(best->letter);
}

/// Why what is armed or approved may not stay so; empty when it may.
std::string WhyDrop(const MissionMemory& m, const MissionInputs& in) {
  const Timestamp now = in.session.now;
  if (m.watch.rebooted() || m.watch.boot_id() != m.armed.boot_id) {
    return words::kRestarted;
  }
  if (m.facts.settings_hash != m.armed.settings_hash ||
      m.facts.terrain_settings_hash != m.armed.terrain_settings_hash) {
    return words::kLimitsChanged;
  }
  if (m.facts.calibration_hash != m.armed.calibration_hash) {
    return words::kCalibrationChanged;
  }
  if (SiteLost(m, now)) {
    return m.site.reason();
  }
  const std::string why = WhyStopped(AlarmFactsAt(m, in));
  return why.empty() ? words::Older("Map", SecondsBetween(m.map_seen_at, now), StaleLimits::map_s)
                     : why;
}

/// A look was approved, and the vehicle goes on below it.
bool WentPastLook(const MissionMemory& m) {
  const VehicleMode mode = m.watch.vehicle()->mode;
  return m.status.IsLook() && (mode == VehicleMode::kSettle || mode == VehicleMode::kSink ||
                               HeightAboveSite(m) < m.status.stop_height_m - kLookedWithin_m);
}

/// Why a descent may not go on; empty when it may.
std::string WhyHold(const MissionMemory& m, const MissionInputs& in) {
  const Timestamp now = in.session.now;
  const VehicleStatus& vehicle = *m.watch.vehicle();
  if (m.watch.rebooted()) {
    return words::kRestarted;
  }
  if (vehicle.mode == VehicleMode::kHold) {
    return words::VehicleHolds(m.vehicle_reason);
  }
  if (vehicle.mode == VehicleMode::kHover || !IsOwnApproval(m, vehicle.approval_id)) {
    return words::kLeftDescent;
  }
  if (WentPastLook(m)) {
    return words::kWentPastLook;
  }
  if (IsCommitted(m)) {
    return words::Older("Vehicle status", m.watch.LinkAge(now), StaleLimits::link_s);
  }
  const double height_m = HeightAboveSite(m);
  if (!std::isfinite(height_m)) {
    return words::kHeightUnknown;
  }
  if (std::string why = words::ImageTimeOff(m.facts.navigation); !why.empty()) {
    return why;
  }
  if (SiteLost(m, now)) {
    return m.site.reason();
  }
  if (m.status.approval->provisional && !m.armed.confirmed &&
      height_m <= GuardLimits::confirm_height_m) {
    return words::NotConfirmed(m.status.armed->letter);
  }
  return WhyStopped(AlarmFactsAt(m, in));
}

/// What ended the flight on vision, with what the station holds against the cameras: a vehicle
/// knows that it has no position, not why.
std::string WithCameras(std::string why, const MissionMemory& m, Timestamp now) {
  const auto guards = EvaluateGuards(GuardInputsAt(m, now));
  const GuardResult* cameras = FindGuard(guards, GuardId::kCameras);
  return cameras->pass ? why : words::Because(why, cameras->reason);
}

void StepSearching(MissionTurn& turn, const MissionInputs& in) {
  MissionMemory& m = turn.memory;
  const Timestamp now = in.session.now;
  const double age_s = m.watch.LeftCameraAge(now);
  const bool live = HasSource(m.facts.role) && age_s <= StaleLimits::cameras_live_s;
  const MissionState state = m.status.state;
  if (!live) {
    if (state != MissionState::kNoLive) {
      m.winner = {};
      Enter(turn, MissionState::kNoLive, words::Older("Left camera", age_s, 0), now);
    }
    return;
  }
  // Pictures without a vehicle stop nobody: what they show is proposed as it is.
  const bool flies = !HasPicturesOnly(in.session.role) && state != MissionState::kNoLive;
  const std::string stopped = flies ? WhyStopped(AlarmFactsAt(m, in)) : "";
  if (!stopped.empty()) {
    m.winner = {};  // a proposal is won while nothing stops
  }
  m.status.search_stopped = stopped;
  if (state == MissionState::kNoLive) {
    Enter(turn, MissionState::kSearch, words::kCamerasLive, now);
  } else if (state == MissionState::kSearch && stopped.empty() && WinnerStands(m, now)) {
    const LandingSite* site = FindSite(m.facts.sites, m.winner.site_id);
    Enter(turn, MissionState::kProposed,
          words::SiteWon(site != nullptr ? site->letter : "?", m.winner.maps), now);
  } else if (state == MissionState::kProposed && !(stopped.empty() && WinnerStands(m, now))) {
    Enter(turn, MissionState::kSearch, stopped.empty() ? WhyNoProposal(m, now) : stopped, now);
    m.winner = {};
  }
}

void StepArmed(MissionTurn& turn, const MissionInputs& in) {
  MissionMemory& m = turn.memory;
  const Timestamp now = in.session.now;
  if (!m.armed.first_sequence) {
    m.armed.first_sequence = in.session.snapshot_sequence + 1;
    m.armed.shown_since = now;
  }
  std::string why = WhyDrop(m, in);
  if (why.empty() && m.status.arm_expires && now >= *m.status.arm_expires) {
    why = words::kArmWindowOver;
  }
  if (!why.empty()) {
    Drop(turn, std::move(why), now);
  }
}

/// The vehicle, the same one, hovers where a look was to end, and says that it flies no approval.
/// kLeastWayToLook_m lies between that and where the look began.
bool HasLooked(const MissionMemory& m) {
  const auto& vehicle = m.watch.vehicle();
  return vehicle && m.status.IsLook() && m.status.approval &&
         vehicle->mode == VehicleMode::kHover && vehicle->approval_id == 0 && !m.watch.rebooted() &&
         m.watch.boot_id() == m.armed.boot_id &&
         std::abs(HeightAboveSite(m) - m.status.stop_height_m) <= kLookedWithin_m;
}

/// The approval is over as it should be, and what is seen from here is proposed anew.
void EndLook(MissionTurn& turn, Timestamp now) {
  MissionMemory& m = turn.memory;
  std::string why = words::LookedAt(m, HeightAboveSite(m));
  Kill(turn, why);
  ForgetSite(m);
  m.status.rechecks.clear();
  m.winner = {};
  Enter(turn, MissionState::kSearch, why, now);
  m.status.selection_ended = std::move(why) + ".";
}

void StepApproved(MissionTurn& turn, const MissionInputs& in) {
  using Phase = MissionStatus::ApprovalPhase;
  MissionMemory& m = turn.memory;
  const Timestamp now = in.session.now;
  const auto& vehicle = m.watch.vehicle();
  const bool executing = Executing(m) && IsOwnApproval(m, vehicle->approval_id);
  if (executing && m.status.approval_phase == Phase::kSent) {
    // Its answer was lost, its deed says the same.
    m.status.approval_phase = Phase::kAccepted;
    m.status.approval_answer_s = SecondsBetween(m.approved_at, now);
    m.vision_allowed = true;
    m.repeating.reset();
  }
  if (HasLooked(m)) {  // no word of it came while it was on the way
    EndLook(turn, now);
    return;
  }
  std::string why = WhyDrop(m, in);
  if (!why.empty()) {
    executing ? Hold(turn, std::move(why), now) : Drop(turn, std::move(why), now);
    return;
  }
  if (vehicle && vehicle->mode == VehicleMode::kAbort) {
    Abort(turn, words::VehicleAborts(m.vehicle_reason), now);
  } else if (executing && vehicle->mode != VehicleMode::kAlign) {
    Enter(turn, MissionState::kDescending, words::Descends(words::SiteName(m.status)), now);
    m.vision_good_at = now;
    m.ground_seen_at = std::max(m.ground_seen_at, now);
  } else if (!executing && m.watch.VehicleTime(now) >= m.status.approval->expires_at) {
    Drop(turn, words::kExpired, now);
  }
}

bool HasLanded(const MissionMemory& m) {
  const auto& vehicle = m.watch.vehicle();
  if (!vehicle || !vehicle->on_ground || !m.status.armed) {
    return false;
  }
  const bool estimate_agrees =
      std::abs(HeightAboveSite(m)) <= kLandedHeight_m && m.facts.v_WB.norm() <= kLandedSpeed_mps;
  return vehicle->mode == VehicleMode::kLanded || estimate_agrees;
}

void Land(MissionTurn& turn, const MissionInputs& in) {
  MissionMemory& m = turn.memory;
  m.status.touchdown_miss_m = TouchdownMiss(m);
  m.status.touchdown_miss_true_m = TrueTouchdownMiss(m, in);
  m.status.touchdown_sink_mps =
      std::isfinite(m.sink_mps) ? std::optional(m.sink_mps) : std::nullopt;
  m.repeating.reset();
  const std::string site = words::SiteName(m.status);
  Enter(turn, MissionState::kLanded,
        MissedSite(m.status)
            ? words::NotAtSite(site, *m.status.touchdown_miss_m, HeightAboveSite(m))
            : words::OnTheGround(site),
        in.session.now);
}

/// True when the vehicle has landed, or aborts: the state was left.
bool LandedOrAborting(MissionTurn& turn, const MissionInputs& in) {
  const MissionMemory& m = turn.memory;
  if (HasLanded(m)) {
    Land(turn, in);
    return true;
  }
  const auto& vehicle = m.watch.vehicle();
  if (vehicle && vehicle->mode == VehicleMode::kAbort) {
    Abort(turn, WithCameras(words::VehicleAborts(m.vehicle_reason), m, in.session.now),
          in.session.now);
    return true;
  }
  return false;
}

/// Why a vehicle that is nearly down goes around; empty when it does not. A gust may carry it off
/// for a moment.
std::string WhyGoAround(MissionMemory& m, Timestamp now) {
  const AlarmFacts facts = HoldFactsAt(m, now);
  if (!(facts.beside_m > facts.most_beside_m)) {
    m.beside_since.reset();
    return {};
  }
  m.beside_since = m.beside_since.value_or(now);
  return SecondsBetween(*m.beside_since, now) >= DescentLimits::beside_s
             ? words::Beside(words::SiteName(m.status), facts.beside_m, facts.most_beside_m)
             : "";
}

void StepDescending(MissionTurn& turn, const MissionInputs& in) {
  MissionMemory& m = turn.memory;
  const Timestamp now = in.session.now;
  if (LandedOrAborting(turn, in) || m.watch.vehicle()->mode == VehicleMode::kLanded) {
    return;  // on the ground by its own word: the second sign is still missing
  }
  if (HasLooked(m)) {
    EndLook(turn, now);
    return;
  }
  const bool on_vision = in.navigation.navigation.OnVision();
  const double outage_s = SecondsBetween(m.vision_good_at, now);
  const double limit_s = m.facts.settings.mission.max_vision_outage_s;
  if (on_vision && outage_s > limit_s) {
    const std::string why = WithCameras(words::VisionLost(outage_s, limit_s), m, now);
    // Without vision the last metres are not a place to hover.
    IsCommitted(m) ? Abort(turn, why, now) : Hold(turn, why, now);
    return;
  }
  if (std::string why = WhyGoAround(turn.memory, now); !why.empty()) {
    Abort(turn, std::move(why), now);
    return;
  }
  std::string why = WhyHold(m, in);
  if (!why.empty()) {
    Hold(turn, std::move(why), now);
  }
}

/// A vehicle that restarted has another frame: what was selected in the one before lies nowhere.
void ForgetSiteOfBefore(MissionMemory& m) {
  if (m.status.armed && m.watch.boot_id() != m.armed.boot_id) {
    ForgetSite(m);
    m.status.rechecks.clear();
  }
}

void StepHold(MissionTurn& turn, const MissionInputs& in) {
  MissionMemory& m = turn.memory;
  const Timestamp now = in.session.now;
  if (LandedOrAborting(turn, in)) {
    return;
  }
  ForgetSiteOfBefore(m);
  const auto& vehicle = m.watch.vehicle();
  const double held_s = SecondsBetween(m.status.since, now);
  const bool stopped =
      vehicle && (vehicle->mode == VehicleMode::kHold || vehicle->mode == VehicleMode::kHover) &&
      m.watch.LinkAge(now) <= GuardLimits::link_s;
  if (stopped && m.repeating && held_s >= GuardLimits::link_s) {
    m.repeating.reset();
  }
  if (stopped && held_s >= kHoldShown_s && WinnerStands(m, now) &&
      WhyStopped(AlarmFactsAt(m, in)).empty()) {
    std::string ended = words::DescentStopped(m.status, m.status.why);
    ForgetSite(m);
    Enter(turn, MissionState::kProposed, words::kReevaluated, now);
    m.status.selection_ended = std::move(ended);
  }
}

void StepAborting(MissionTurn& turn, Timestamp now) {
  MissionMemory& m = turn.memory;
  ForgetSiteOfBefore(m);
  const auto& vehicle = m.watch.vehicle();
  m.abort_seen = m.abort_seen || (vehicle && HeardSinceWaveOff(m, now) &&
                                  (vehicle->mode == VehicleMode::kAbort || vehicle->on_ground));
  if (m.abort_seen) {
    m.repeating.reset();
  }
  if (m.wave_off_acknowledged && WaveOffIsOver(m, now)) {
    m.repeating.reset();
    ForgetSite(m);
    Enter(turn, MissionState::kSearch, words::kWaveOffOver, now);
  }
}

}  // namespace

void StepState(MissionTurn& turn, const MissionInputs& in) {
  turn.memory.status.search_stopped.clear();
  switch (turn.memory.status.state) {
    case MissionState::kNoLive:
    case MissionState::kSearch:
    case MissionState::kProposed:
      StepSearching(turn, in);
      break;
    case MissionState::kArmed:
      StepArmed(turn, in);
      break;
    case MissionState::kApproved:
      StepApproved(turn, in);
      break;
    case MissionState::kDescending:
      StepDescending(turn, in);
      break;
    case MissionState::kHold:
      StepHold(turn, in);
      break;
    case MissionState::kAborting:
      StepAborting(turn, in.session.now);
      break;
    case MissionState::kLanded:
      break;
  }
}

}  // namespace palace
