// Commands: who may ask for what, and when.
#include <cmath>

#include "engine/core/check.h"
#include "engine/mission/mission.h"

namespace palace {
namespace {

constexpr double kSnapshotOld_s = 2;
constexpr std::uint64_t kRefreshes = 60;  ///< at most, between two passes

template <typename T>
bool Is(const EngineCommand& command) {
  return std::holds_alternative<T>(command.action);
}

bool ConcernsVehicle(const EngineCommand& c) {
  return Is<SelectSite>(c) || Is<DisarmSite>(c) || Is<ApproveSite>(c) || Is<RefuseSite>(c) ||
         Is<HoldHere>(c) || Is<WaveOff>(c) || Is<AcknowledgeWaveOff>(c);
}

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

}  // namespace

Status Mission::Refuse(Timestamp now, std::string_view what, std::string why) {
  AddEvent(now, EventKind::kDecision, std::string(what) + " refused: " + why);
  return UsageError(std::move(why));
}

std::string Mission::WhyNoCommand(const EngineCommand& command) const {
  const bool recorded = command.origin == CommandOrigin::kReplay;
  if (recorded && facts_.source_kind != SourceKind::kReplay) {
    return "Recorded commands act in a replay only";
  }
  if (!ConcernsVehicle(command)) {
    return {};
  }
  if (!recorded && facts_.source_kind == SourceKind::kReplay) {
    return "No link in replay";
  }
  if (HasPicturesOnly(facts_.source_kind)) {
    return WhyNoVehicle(facts_.source_kind);
  }
  const bool commits = Is<SelectSite>(command) || Is<ApproveSite>(command);
  const bool script_may = options_.allow_script_approvals && facts_.simulated_vehicle;
  if (commits && command.origin == CommandOrigin::kScript && !script_may) {
    return "A script may select and approve only on a simulated vehicle";
  }
  return {};
}

Status Mission::Apply(const EngineCommand& command, Timestamp now) {
  std::string why_not = WhyNoCommand(command);
  if (!why_not.empty()) {
    return Refuse(now, "Command", std::move(why_not));
  }
  const auto nothing = [](const auto&) { return Ok(); };
  return std::visit(Overloaded{
                        nothing,
                        [&](const SelectSite& a) { return Select(a.site_id, now); },
                        [&](const DisarmSite&) { return Disarm(now); },
                        [&](const ApproveSite& a) { return Approve(a, command.origin, now); },
                        [&](const RefuseSite& a) { return RefuseProposal(a.site_id, now); },
                        [&](const HoldHere&) -> Status {
                          if (status_.state != MissionState::kDescending &&
                              status_.state != MissionState::kApproved) {
                            return Refuse(now, "Hold", "No descent to hold");
                          }
                          Hold("Held by the operator", now);
                          return Ok();
                        },
                        [&](const WaveOff&) -> Status {
                          Abort("Waved off by the operator", now);
                          return Ok();
                        },
                        [&](const AcknowledgeWaveOff&) -> Status {
                          if (status_.state != MissionState::kAborting) {
                            return Refuse(now, "Acknowledge", "No wave-off to acknowledge");
                          }
                          wave_off_acknowledged_ = true;
                          alarms_.Acknowledge("wave_off");
                          return Ok();
                        },
                        [&](const AcknowledgeAlarm& a) -> Status {
                          if (!alarms_.Acknowledge(a.alarm)) {
                            return Refuse(now, "Acknowledge", "No alarm '" + a.alarm + "'");
                          }
                          AddEvent(now, EventKind::kAlarm, "Acknowledged: " + a.alarm);
                          return Ok();
                        },
                        [&](const AddBookmark& a) -> Status {
                          AddEvent(now, EventKind::kBookmark, a.note);
                          return Ok();
                        },
                    },
                    command.action);
}

const LandingSite* Mission::FindSite(std::uint64_t site_id) const {
  for (const LandingSite& site : facts_.sites) {
    if (site.id == site_id) {
      return &site;
    }
  }
  return nullptr;
}

Status Mission::Select(std::uint64_t site_id, Timestamp now) {
  const LandingSite* site = FindSite(site_id);
  // A refused site is never proposed again: a second look must not wait for that. It stays refused
  // until it is approved.
  const bool reconsidered = status_.state == MissionState::kSearch && status_.IsRefused(site_id);
  if (status_.state != MissionState::kProposed && status_.state != MissionState::kArmed &&
      !reconsidered) {
    return Refuse(
        now, "Select",
        std::string("No site can be selected in state ") + MissionStateWord(status_.state));
  }
  if (site == nullptr) {
    return Refuse(now, "Select", "That site is not on the newest map");
  }
  if (!site->p_WS.allFinite() || !std::isfinite(site->clear_radius_m)) {
    return Refuse(now, "Select", "The place of that site is not known");
  }
  if (status_.state == MissionState::kArmed && status_.armed->id == site_id) {
    return Ok();  // set, not toggle: a second copy changes nothing (I8)
  }
  const LandingSite chosen = *site;
  ForgetSite();
  refusal_.clear();
  status_.armed = chosen;
  status_.armed_at = now;
  status_.arm_expires = AddSeconds(now, facts_.limits.arm_window_s);
  status_.approval_phase = MissionStatus::ApprovalPhase::kNone;
  status_.approval_answer.clear();
  status_.rechecks.clear();
  armed_.map_hash = facts_.map_hash;
  armed_.settings_hash = facts_.settings_hash;
  armed_.terrain_settings_hash = facts_.terrain_settings_hash;
  armed_.calibration_hash = facts_.calibration_hash;
  armed_.boot_id = watch_.boot_id();
  armed_.confirmed = chosen.confirmed;
  PlanApproach();
  Enter(MissionState::kArmed, "Site " + std::string(1, chosen.letter) + " selected", now);
  return Ok();
}

Status Mission::Disarm(Timestamp now) {
  if (status_.state != MissionState::kArmed && status_.state != MissionState::kApproved) {
    return Refuse(now, "Disarm", "No site is selected");
  }
  Drop(status_.state == MissionState::kArmed ? "Deselected by the operator"
                                             : "Approval withdrawn by the operator",
       now);
  return Ok();
}

Status Mission::RefuseProposal(std::uint64_t site_id, Timestamp now) {
  const LandingSite* site = FindSite(site_id);
  const bool armed = status_.state == MissionState::kArmed && status_.armed->id == site_id;
  if (status_.state != MissionState::kProposed && status_.state != MissionState::kArmed) {
    return Refuse(
        now, "Refuse",
        status_.state == MissionState::kApproved || status_.state == MissionState::kDescending
            ? "Already approved, hold or wave off"
            : "No site is proposed");
  }
  if (site == nullptr && !armed) {
    return Refuse(now, "Refuse", "That site is not on the newest map");
  }
  const std::string name =
      "Site " + std::string(1, armed ? status_.armed->letter : site->letter) + " refused";
  if (!status_.IsRefused(site_id)) {
    status_.refused_sites.push_back(site_id);
  }
  AddEvent(now, EventKind::kDecision, name + " by the operator");
  if (winner_.id == site_id) {
    winner_ = {};
  }
  const LandingSite* next = status_.BestStanding(facts_.sites);
  const std::string why =
      name + (next != nullptr ? ", next is " + std::string(1, next->letter) : ", no other site");
  if (armed) {
    Kill(why);
    ForgetSite();
  }
  // What was not proposed before must win its maps first.
  if (!WinnerStands(now)) {
    Enter(MissionState::kSearch, why, now);
  } else if (armed) {
    Enter(MissionState::kProposed, why, now);
  }
  return Ok();
}

Status Mission::Approve(const ApproveSite& action, CommandOrigin origin, Timestamp now) {
  if (status_.state != MissionState::kArmed) {
    return Refuse(
        now, "Approve",
        status_.state == MissionState::kApproved || status_.state == MissionState::kDescending
            ? "Already approved"
            : "Select a site first");
  }
  if (action.site_id != status_.armed->id) {
    return Refuse(now, "Approve", "Selected is " + SiteName() + ", not the site to approve");
  }
  const bool recorded = origin == CommandOrigin::kReplay;
  const auto guards = EvaluateGuards(MakeGuardInputs(now));
  if (const GuardResult* failed = FirstFailure(guards, recorded)) {
    return Refuse(now, "Approve", failed->reason);
  }
  if (!recorded) {
    // G6: the picture the operator decided on showed this site armed, and was recent. Snapshots
    // refreshed between two passes carry numbers the mission has not seen yet.
    bool recent = false;
    for (const auto& [sequence, shown_at] : shown_) {
      recent = recent || (sequence <= action.snapshot_sequence &&
                          action.snapshot_sequence <= sequence + kRefreshes &&
                          SecondsBetween(shown_at, now) <= kSnapshotOld_s);
    }
    if (!recent || action.snapshot_sequence < *armed_.first_sequence) {
      return Refuse(now, "Approve", "The picture on the screen was not that of this selection");
    }
  }
  std::erase(status_.refused_sites, status_.armed->id);  // approved on a second look
  status_.approval = MakeApproval(now);
  status_.approval_phase = MissionStatus::ApprovalPhase::kSent;
  status_.approval_answer.clear();
  status_.arm_expires.reset();
  approved_now_ = now;
  repeating_ = *status_.approval;
  sent_at_ = now;
  AddEvent(now, EventKind::kDecision,
           "Approval " + std::to_string(counter_) + " of " + SiteName() +
               (status_.approval->provisional ? ", provisional" : "") + " given");
  const char* who = origin == CommandOrigin::kScript ? "a script" : "the operator";
  Enter(MissionState::kApproved, std::string("Approved by ") + who + ", sent to the vehicle", now);
  Send(*status_.approval);
  return Ok();
}

Approval Mission::MakeApproval(Timestamp now) {
  const LandingSite& site = *status_.armed;
  const std::uint64_t session = options_.session_id ^ (options_.session_id >> 32);
  Approval a;
  a.counter = ++counter_;
  a.id = (session << 32) | counter_;
  a.session_id = options_.session_id;
  a.site_id = site.id;
  a.map_hash = armed_.map_hash;
  a.settings_hash = armed_.settings_hash;
  a.calibration_hash = armed_.calibration_hash;
  a.vehicle_boot_id = armed_.boot_id;
  a.approved_at = watch_.VehicleTime(now);
  a.expires_at = AddSeconds(a.approved_at, facts_.limits.approval_expiry_s);
  a.provisional = !armed_.confirmed;
  a.p_WS = site.p_WS;
  PALACE_CHECK(status_.approach.has_value());
  a.approach_heading_rad = status_.approach->heading_rad;
  a.glide_slope_rad = status_.approach->glide_slope_rad;
  a.descent_rate_mps = status_.approach->descent_rate_mps;
  a.clear_radius_m = site.clear_radius_m;
  if (facts_.source_kind != SourceKind::kReplay) {
    options_.signer.Sign(a);  // a replayed approval stays unsigned: no vehicle may take it (I7)
  }
  return a;
}

}  // namespace palace
