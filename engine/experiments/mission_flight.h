// One whole mission flown by the scripted operator, engine and simulator in lockstep: what the
// mission says of it, how it met the ground, and why it ended where it did.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/faults/fault_plan.h"
#include "engine/model/mission/fly_area.h"
#include "engine/model/settings/settings.h"
#include "engine/runtime/flight_summary.h"
#include "engine/simulation/simulator.h"

namespace palace {

struct MissionFlight {
  std::string scenario = "runway";
  std::uint64_t seed = 1;
  VehicleDescription vehicle = DefaultVehicle();
  Settings settings{};
  double wind_mps = 0;
  FaultPlan faults{};
  double limit_s = 180;  ///< of flown time
  /// It also ends when no approval stood for that long, climbs away not counted, or when it holds
  /// or climbs away that long without going on.
  double unapproved_limit_s = std::numeric_limits<double>::infinity();
  double stopped_limit_s = std::numeric_limits<double>::infinity();
  /// How often the operator waves off and looks again where a descent was stopped for good.
  int looks_again = 0;
  /// Whether it flies down to look, where a look is offered, before it approves.
  bool looks_closer = false;
  bool searches = false;
  std::optional<FlyArea> area{};      ///< that the operator draws as soon as somebody commands
  std::filesystem::path record_in{};  ///< its log: <record_in>/<scenario>-<seed>; empty: none
};

struct FlownMission {
  FlightSummary summary;
  std::optional<Touchdown> touchdown{};
  /// Of a mission that did not land: what the station says of its last state.
  std::string why{};
  int ways = 0;          ///< to another hover, that were begun
  double outside_m = 0;  ///< of that area, by the truth of B, at most
};

/// Looks on after every pass: what the station shows, and the newest position that it sent, null
/// before the first. False: enough was seen, the flight ends.
using MissionWatcher =
    std::function<bool(const EngineSnapshot& snapshot, const PositionEstimate* sent)>;

/// Errors: an unknown scenario is one of usage; those of a camera that cannot draw and of a log
/// that cannot be written.
Result<FlownMission> FlyMission(const MissionFlight& flight, const SceneCameraFactory& camera,
                                const MissionWatcher& watcher = {});

}  // namespace palace
