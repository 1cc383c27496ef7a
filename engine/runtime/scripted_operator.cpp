#include "engine/runtime/scripted_operator.h"

namespace palace {
namespace {

constexpr double kLooksFor_s = 2;

}  // namespace

std::vector<EngineCommand> ScriptedOperator::Decide(const EngineSnapshot& snapshot) {
  const MissionStatus& mission = snapshot.flight->mission;
  if (mission.state != last_ || !seen_since_) {
    last_ = mission.state;
    seen_since_ = snapshot.time;
  }
  if (SecondsBetween(*seen_since_, snapshot.time) < kLooksFor_s) {
    return {};
  }
  switch (mission.state) {
    case MissionState::kProposed:
      if (snapshot.terrain->applied) {
        if (const LandingSite* site =
                mission.BestStanding(snapshot.terrain->applied->selection.sites)) {
          return {{CommandOrigin::kScript, SelectSite{site->id}}};
        }
      }
      return {};
    case MissionState::kArmed:
      if (mission.can_approve && mission.armed) {
        return {{CommandOrigin::kScript, ApproveSite{mission.armed->id, snapshot.sequence}}};
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
