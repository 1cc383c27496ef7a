#include "engine/mission/permission.h"

#include <variant>

#include "engine/mission/wording.h"

namespace palace {
namespace {

struct ConcernsVehicle {
  template <typename T>
  bool operator()(const T&) const {
    return false;
  }
  bool operator()(const SelectSite&) const { return true; }
  bool operator()(const DisarmSite&) const { return true; }
  bool operator()(const ApproveSite&) const { return true; }
  bool operator()(const LookAtSite&) const { return true; }
  bool operator()(const TurnApproach&) const { return true; }
  bool operator()(const RefuseSite&) const { return true; }
  bool operator()(const FlyTo&) const { return true; }
  bool operator()(const SetFlyArea&) const { return true; }
  bool operator()(const ClearFlyArea&) const { return true; }
  bool operator()(const HoldHere&) const { return true; }
  bool operator()(const WaveOff&) const { return true; }
  bool operator()(const AcknowledgeWaveOff&) const { return true; }
  bool operator()(const AskForCommand&) const { return true; }
  bool operator()(const ReleaseCommand&) const { return true; }
};

}  // namespace

std::string WhyNotAllowed(const MissionOptions& station, const MissionFacts& facts,
                          const EngineCommand& command) {
  const bool recorded = command.origin == CommandOrigin::kReplay;
  if (recorded && !FollowsRecord(facts.role)) {
    return words::kRecordedOnly;
  }
  if (!std::visit(ConcernsVehicle{}, command.action)) {
    return {};
  }
  if (!recorded && !MaySend(facts.role)) {
    return facts.why_no_vehicle;
  }
  const bool commits = std::holds_alternative<SelectSite>(command.action) ||
                       std::holds_alternative<ApproveSite>(command.action) ||
                       std::holds_alternative<LookAtSite>(command.action) ||
                       std::holds_alternative<TurnApproach>(command.action) ||
                       std::holds_alternative<FlyTo>(command.action);
  const bool decides = commits || std::holds_alternative<RefuseSite>(command.action) ||
                       std::holds_alternative<SetFlyArea>(command.action) ||
                       std::holds_alternative<ClearFlyArea>(command.action);
  if (!recorded && decides && WhyViewOnly(facts) != nullptr) {
    return WhyViewOnly(facts);
  }
  const bool script_may = station.allow_script_approvals && facts.simulated_vehicle;
  if (commits && command.origin == CommandOrigin::kScript && !script_may) {
    return words::kNoScript;
  }
  return {};
}

}  // namespace palace
