#include "engine/runtime/scripted_operator.h"

#include <algorithm>
#include <utility>

#include "engine/model/site_standing.h"

namespace palace {
namespace {

constexpr double kLooksFor_s = 2;
constexpr double kBlockedFor_s = 10;  // then another site
constexpr double kStoppedFor_s = 15;  // then a look from higher up
constexpr double kLow_m = 10;         // above the site: there at once
constexpr double kLookedFor_s = 30;   // the same where a look ended

constexpr double kNothingFor_s =
    14;  // that could be approved, of what is listed: then other ground
constexpr double kNothingListed_s = 5;  // the same where nothing is

std::vector<EngineCommand> Command(CommandAction action) {
  return {{CommandOrigin::kScript, std::move(action)}};
}

}  // namespace

const LandingSite* ScriptedOperator::Choice(const EngineSnapshot& snapshot) const {
  if (!snapshot.terrain->applied || low_) {
    return nullptr;
  }
  const MissionStatus& mission = snapshot.flight->mission;
  const std::vector<LandingSite>& sites = snapshot.terrain->applied->selection.sites;
  if (!insists_) {
    return mission.BestStanding(sites);
  }
  const auto failures = [&](const LandingSite& site) {
    const auto found = failures_.find(site.id);
    return found == failures_.end() ? 0 : found->second;
  };
  const LandingSite* best = nullptr;
  for (const LandingSite& site : sites) {
    if (IsInView(site) && !mission.IsRefused(site.id) &&
        (best == nullptr || failures(site) < failures(*best))) {
      best = &site;
    }
  }
  return best;
}

std::vector<EngineCommand> ScriptedOperator::Insist(const EngineSnapshot& snapshot,
                                                    double in_state_s) {
  const MissionStatus& mission = snapshot.flight->mission;
  if (IsFlying(mission.state)) {
    flown_at_ = snapshot.time;
    flown_site_ = mission.armed ? mission.armed->id : 0;
    flew_to_look_ = mission.IsLook();
    return {};
  }
  if (mission.state == MissionState::kLanded) {
    return {};
  }
  const bool stopped =
      mission.state == MissionState::kHold || mission.state == MissionState::kAborting;
  flew_to_look_ = flew_to_look_ && !stopped;
  if (flown_site_ != 0 && (stopped || !flew_to_look_)) {
    ++failures_[std::exchange(flown_site_, 0)];
  }
  if (mission.state == MissionState::kAborting) {
    flown_at_.reset();
    low_ = false;
    return mission.wave_off.over ? Command(AcknowledgeWaveOff{}) : std::vector<EngineCommand>();
  }
  for (const Alarm& alarm : mission.alarms) {
    if (alarm.level == AlarmLevel::kWarning && !alarm.active && !alarm.acknowledged) {
      return Command(AcknowledgeAlarm{alarm.id});
    }
  }
  const double stopped_s = flown_at_ ? SecondsBetween(*flown_at_, snapshot.time) : 0;
  // What hangs over the ground is not seen from below it.
  low_ = low_ || (mission.state == MissionState::kHold && mission.height_above_site_m < kLow_m);
  const double patience_s = low_ ? kLooksFor_s : flew_to_look_ ? kLookedFor_s : kStoppedFor_s;
  if (stopped_s >= patience_s && looks_again_ > 0 && mission.why_no_wave_off.empty()) {
    --looks_again_;
    flown_at_.reset();
    return Command(WaveOff{});
  }
  if (mission.state == MissionState::kArmed && !mission.can_approve && in_state_s > kBlockedFor_s) {
    ++failures_[mission.armed->id];
    return Command(DisarmSite{});
  }
  return {};
}

std::vector<EngineCommand> ScriptedOperator::Search(const EngineSnapshot& snapshot) {
  const MissionStatus& mission = snapshot.flight->mission;
  const bool searches = mission.state == MissionState::kSearch ||
                        mission.state == MissionState::kProposed ||
                        (mission.state == MissionState::kArmed && !mission.can_approve);
  if (!searches || mission.going || !nothing_since_) {
    nothing_since_ = snapshot.time;
    return {};
  }
  const bool listed =
      snapshot.terrain->applied && !snapshot.terrain->applied->selection.sites.empty();
  if (SecondsBetween(*nothing_since_, snapshot.time) <
      (listed ? kNothingFor_s : kNothingListed_s)) {
    return {};
  }
  if (mission.next_look && mission.why_not_go.empty()) {
    return Command(FlyTo{mission.next_look->p_WB, mission.next_look->heading_rad});
  }
  if (mission.state == MissionState::kArmed) {
    return Command(DisarmSite{});
  }
  return {};
}

std::vector<EngineCommand> ScriptedOperator::Decide(const EngineSnapshot& snapshot) {
  const MissionStatus& mission = snapshot.flight->mission;
  if (mission.state != last_ || !seen_since_) {
    last_ = mission.state;
    seen_since_ = snapshot.time;
  }
  const double in_state_s = SecondsBetween(*seen_since_, snapshot.time);
  if (insists_) {
    if (std::vector<EngineCommand> commands = Insist(snapshot, in_state_s); !commands.empty()) {
      return commands;
    }
  }
  if (searches_) {
    if (std::vector<EngineCommand> commands = Search(snapshot); !commands.empty()) {
      return commands;
    }
  }
  if (in_state_s < kLooksFor_s) {
    return {};
  }
  switch (mission.state) {
    case MissionState::kProposed:
      if (const LandingSite* site = Choice(snapshot)) {
        return Command(SelectSite{site->id});
      }
      return {};
    case MissionState::kArmed:
      if (mission.can_approve && mission.OffersLook() && looks_closer_ &&
          looked_at_.insert(mission.armed->id).second) {
        return Command(LookAtSite{mission.armed->id, snapshot.sequence, mission.look_from_m});
      }
      if (mission.can_approve && mission.armed) {
        return Command(ApproveSite{mission.armed->id, snapshot.sequence});
      }
      return {};
    case MissionState::kLanded:
      finished_ = true;
      return {};
    default:
      return {};
  }
}

}  // namespace palace
