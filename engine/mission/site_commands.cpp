#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/check.h"
#include "engine/mission/geometry.h"
#include "engine/mission/going.h"
#include "engine/mission/guards.h"
#include "engine/mission/obeying.h"
#include "engine/mission/wording.h"
#include "engine/model/find_site.h"
#include "engine/model/site_standing.h"

namespace palace {
namespace {

constexpr double kSnapshotOld_s = 2;
constexpr double kLongestExpiry_s = 120;  ///< that a vehicle takes (engine/wire/README.md)
constexpr std::uint64_t kRefreshes = 60;  ///< at most, between two passes

/// How long the descent may take to begin. The way round of a turned approach is not the operator's
/// delay.
double TimeToBegin(const MissionMemory& m) {
  const double way_s = m.status.approach->turned()
                           ? TimeToAlign(PathTo(m, *m.status.armed), m.facts.p_WB, m.facts.yaw_rad)
                           : 0;
  return std::min(m.facts.settings.mission.approval_expiry_s + way_s, kLongestExpiry_s);
}

Approval MakeApproval(MissionTurn& turn, double stop_height_m, Timestamp now) {
  MissionMemory& m = turn.memory;
  const LandingSite& site = *m.status.armed;
  PALACE_CHECK(m.status.approach.has_value());
  Approval a;
  a.id = ApprovalNumber(turn.station.session_id, ++m.approvals_given);
  a.site_id = site.id;
  a.map_hash = m.armed.map_hash;
  a.settings_hash = m.armed.settings_hash;
  a.calibration_hash = m.armed.calibration_hash;
  a.vehicle_boot_id = m.armed.boot_id;
  a.approved_at = m.watch.VehicleTime(now);
  a.expires_at = AddSeconds(a.approved_at, TimeToBegin(m));
  a.provisional = !m.armed.confirmed;
  a.p_WS = site.p_WS;
  a.approach_heading_rad = m.status.approach->heading_rad;
  a.glide_slope_rad = m.status.approach->glide_slope_rad;
  a.descent_rate_mps = m.status.approach->descent_rate_mps;
  a.clear_radius_m = site.clear_radius_m;
  a.stop_height_m = stop_height_m;
  return a;
}

/// G6: the picture the operator decided on showed this site armed, and was recent. Snapshots
/// refreshed between two passes carry numbers the mission has not seen yet.
bool WasOnScreen(const MissionMemory& m, std::uint64_t sequence, Timestamp now) {
  bool recent = false;
  for (const ShownSnapshot& shown : m.shown) {
    recent = recent || (shown.sequence <= sequence && sequence <= shown.sequence + kRefreshes &&
                        SecondsBetween(shown.time, now) <= kSnapshotOld_s);
  }
  return recent && sequence >= *m.armed.first_sequence;
}

/// Why the armed site is not looked at from there; empty when it is.
std::string WhyNoLook(const MissionMemory& m, double stop_height_m) {
  const std::string& letter = m.status.armed->letter;
  if (std::isnan(m.status.look_from_m)) {
    return words::NothingToLookAt(letter);
  }
  if (m.status.look_from_m != stop_height_m) {
    return words::kOtherPicture;
  }
  if (!(HeightAboveSite(m) - stop_height_m >= kLeastWayToLook_m)) {
    return words::kNearEnough;
  }
  return m.status.OffersLook() ? "" : words::NothingToLookAt(letter);
}

/// The course from that side; empty where none is open. What is recorded was open then.
std::optional<ApproachCourse> CourseFrom(const MissionMemory& m, int side, bool recorded) {
  if (recorded && side != kStraightApproach && IsApproachSide(side)) {
    return ApproachCourse{HeadingFromSector(side), side};
  }
  for (const ApproachCourse& course : CoursesOpen(m)) {
    if (course.side == side) {
      return course;
    }
  }
  return std::nullopt;
}

}  // namespace

Status Obeying::operator()(const SelectSite& action) const {
  MissionMemory& m = turn.memory;
  const MissionState state = m.status.state;
  const LandingSite* site = FindSite(m.facts.sites, action.site_id);
  if (!IsNamedSite(action.site_id)) {
    return Refuse(turn, now, "Select", words::kPreviewOnly);
  }
  // A refused site is never proposed again: a second look must not wait for that. It stays refused
  // until it is approved.
  if (!m.status.TakesSelection(action.site_id)) {
    return Refuse(turn, now, "Select", words::CannotSelectIn(state));
  }
  if (site == nullptr) {
    return Refuse(turn, now, "Select", words::kNotOnMap);
  }
  if (!site->p_WS.allFinite() || !std::isfinite(site->clear_radius_m)) {
    return Refuse(turn, now, "Select", words::kPlaceUnknown);
  }
  if (state == MissionState::kArmed && m.status.armed->id == action.site_id) {
    return Ok();  // set, not toggle: a second copy changes nothing (I8)
  }
  if (m.status.going) {  // it stays where it sees the site
    StopGoing(turn, words::SiteSelected(site->letter), now);
  }
  ForgetSite(m);
  m.refusal.clear();
  m.status.armed = *site;
  m.status.armed_limits = SiteLimits(*site, m.facts.site_limits);
  m.status.look_from_m = site->look_height_m;
  m.status.armed_at = now;
  m.status.arm_expires = AddSeconds(now, m.facts.settings.mission.arm_window_s);
  m.status.approval_phase = MissionStatus::ApprovalPhase::kNone;
  m.status.approval_answer.clear();
  m.status.rechecks.clear();
  m.armed.map_hash = m.facts.map_hash;
  m.armed.settings_hash = m.facts.settings_hash;
  m.armed.terrain_settings_hash = m.facts.terrain_settings_hash;
  m.armed.calibration_hash = m.facts.calibration_hash;
  m.armed.boot_id = m.watch.boot_id();
  m.armed.confirmed = site->confirmed;
  m.armed.air_shown = IsAirShown(*site);
  PlanApproach(m);
  Enter(turn, MissionState::kArmed,
        words::SiteSelected(site->letter) + words::ApproachTurned(m.status.approach), now);
  return Ok();
}

Status Obeying::operator()(const DisarmSite&) const {
  const MissionState state = turn.memory.status.state;
  if (state != MissionState::kArmed && state != MissionState::kApproved) {
    return Refuse(turn, now, "Disarm", words::kNoneSelected);
  }
  Drop(turn, state == MissionState::kArmed ? words::kDeselected : words::kWithdrawn, now);
  return Ok();
}

Status Obeying::operator()(const RefuseSite& action) const {
  MissionMemory& m = turn.memory;
  const MissionState state = m.status.state;
  const LandingSite* site = FindSite(m.facts.sites, action.site_id);
  const bool armed = state == MissionState::kArmed && m.status.armed->id == action.site_id;
  if (!IsNamedSite(action.site_id)) {
    return Refuse(turn, now, "Refuse", words::kPreviewOnly);
  }
  if (state != MissionState::kProposed && state != MissionState::kArmed) {
    return Refuse(turn, now, "Refuse",
                  IsFlying(state) ? words::kApprovedHold : words::kNoneProposed);
  }
  if (site == nullptr && !armed) {
    return Refuse(turn, now, "Refuse", words::kNotOnMap);
  }
  const std::string letter = armed ? m.status.armed->letter : site->letter;
  if (!m.status.IsRefused(action.site_id)) {
    m.status.refused_sites.push_back(action.site_id);
  }
  AddEvent(turn, now, EventKind::kDecision, words::SiteRefused(letter) + " by the operator");
  if (m.winner.site_id == action.site_id) {
    m.winner = {};
  }
  const std::string why = words::RefusedAndNext(letter, m.status.BestStanding(m.facts.sites));
  if (armed) {
    Kill(turn, why);
    ForgetSite(m);
  }
  // What was not proposed before must win its maps first.
  if (!WinnerStands(m, now)) {
    Enter(turn, MissionState::kSearch, why, now);
  } else if (armed) {
    Enter(turn, MissionState::kProposed, why, now);
  }
  return Ok();
}

std::string Obeying::WhyNotCommit(std::uint64_t site_id, std::uint64_t snapshot_sequence) const {
  const MissionMemory& m = turn.memory;
  if (m.status.state != MissionState::kArmed) {
    return IsFlying(m.status.state) ? words::kAlreadyApproved : words::kSelectFirst;
  }
  if (site_id != m.status.armed->id) {
    return words::NotTheArmedOne(m.status);
  }
  const bool recorded = origin == CommandOrigin::kReplay;
  const auto guards = EvaluateGuards(GuardInputsAt(m, now));
  if (const GuardResult* failed = FirstFailure(guards, recorded)) {
    return failed->reason;
  }
  return recorded || WasOnScreen(m, snapshot_sequence, now) ? "" : words::kOtherPicture;
}

Status Obeying::operator()(const ApproveSite& action) const {
  std::string why = WhyNotCommit(action.site_id, action.snapshot_sequence);
  return why.empty() ? Commit(0) : Refuse(turn, now, "Approve", std::move(why));
}

Status Obeying::operator()(const LookAtSite& action) const {
  const MissionMemory& m = turn.memory;
  std::string why = WhyNotCommit(action.site_id, action.snapshot_sequence);
  if (why.empty() && origin != CommandOrigin::kReplay) {
    why = WhyNoLook(m, action.stop_height_m);
  }
  return why.empty() ? Commit(action.stop_height_m) : Refuse(turn, now, "Look", std::move(why));
}

Status Obeying::operator()(const TurnApproach& action) const {
  MissionMemory& m = turn.memory;
  if (m.status.state != MissionState::kArmed) {
    return Refuse(turn, now, "Turn approach",
                  IsFlying(m.status.state) ? words::kAlreadyApproved : words::kSelectFirst);
  }
  if (action.site_id != m.status.armed->id) {
    return Refuse(turn, now, "Turn approach", words::NotTheArmedOne(m.status));
  }
  if (m.status.approach && m.status.approach->side == action.side) {
    return Ok();  // set, not toggle
  }
  const auto wanted = CourseFrom(m, action.side, origin == CommandOrigin::kReplay);
  if (!wanted) {
    return Refuse(turn, now, "Turn approach", words::kSideNotClear);
  }
  TurnTo(m, *wanted);
  // What is approved is the approach that was on the screen, for as long as evidence must be.
  m.armed.first_sequence.reset();
  AddEvent(turn, now, EventKind::kDecision, words::ApproachTurnedBy(m.status, WhoAsks(origin)));
  return Ok();
}

Status Obeying::Commit(double stop_height_m) const {
  MissionMemory& m = turn.memory;
  std::erase(m.status.refused_sites, m.status.armed->id);  // approved on a second look
  m.status.approval = MakeApproval(turn, stop_height_m, now);
  m.status.stop_height_m = stop_height_m;
  m.status.approval_phase = MissionStatus::ApprovalPhase::kSent;
  m.status.approval_answer.clear();
  m.vehicle_reason.clear();
  m.status.arm_expires.reset();
  m.approved_at = now;
  AddEvent(turn, now, EventKind::kDecision,
           words::ApprovalGiven(m.status, m.facts.site_limits, m.approvals_given));
  const char* who = WhoAsks(origin);
  // A record does not tell.
  m.status.approved_by = origin == CommandOrigin::kReplay ? "" : who;
  Enter(turn, MissionState::kApproved, words::ApprovedBy(who), now);
  SendUntilAnswered(turn, *m.status.approval, now);
  return Ok();
}

}  // namespace palace
