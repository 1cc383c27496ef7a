#include "engine/experiments/mission_flight.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "engine/experiments/overheard_link.h"
#include "engine/faults/faulted_source.h"
#include "engine/journal/flight_recorder.h"
#include "engine/runtime/engine.h"
#include "engine/runtime/scripted_operator.h"
#include "engine/simulation/session.h"

namespace palace {
namespace {

/// How long the mission has been in its present state, and when that is long enough.
class Patience {
 public:
  explicit Patience(const MissionFlight& flight) : flight_(flight) {}

  bool IsOver(const EngineSnapshot& snapshot, const FlightSummary& flown) {
    const MissionState state = snapshot.flight->mission.state;
    if (state != state_) {
      state_ = state;
      since_s_ = flown.duration_s;
    }
    if (IsFlying(state) || state == MissionState::kAborting) {
      approved_s_ = flown.duration_s;
    }
    const bool stopped = state == MissionState::kHold || state == MissionState::kAborting;
    return flown.duration_s > flight_.limit_s ||
           flown.duration_s - approved_s_ > flight_.unapproved_limit_s ||
           (stopped && flown.duration_s - since_s_ > flight_.stopped_limit_s);
  }

 private:
  const MissionFlight& flight_;
  MissionState state_ = MissionState::kNoLive;
  double since_s_ = 0;
  double approved_s_ = 0;  ///< an approval stood last, or it climbed away
};

/// Draws the area once, and follows what the vehicle makes of it and of the search.
class AreaAndWays {
 public:
  explicit AreaAndWays(const std::optional<FlyArea>& area) : area_(area) {}

  void Follow(Engine& engine, const EngineSnapshot& snapshot, FlownMission& flown) {
    const MissionStatus& mission = snapshot.flight->mission;
    if (area_ && mission.may_select && !drawn_) {
      engine.Post({CommandOrigin::kScript, SetFlyArea{*area_}});
      drawn_ = true;
    }
    flown.ways += mission.going && !goes_ ? 1 : 0;
    goes_ = mission.going.has_value();
    const auto& truth = snapshot.sensors->truth;
    if (area_ && truth && !IsInside(*area_, truth->X_WB.p.head<2>())) {
      flown.outside_m = std::max(flown.outside_m, ToEdge_m(*area_, truth->X_WB.p.head<2>()));
    }
  }

 private:
  const std::optional<FlyArea>& area_;
  bool drawn_ = false, goes_ = false;
};

std::string WhyNotLanded(const EngineSnapshot& snapshot) {
  const MissionStatus& mission = snapshot.flight->mission;
  switch (mission.state) {
    case MissionState::kLanded:
      return "";
    case MissionState::kArmed:
      return mission.cannot_approve_reason;
    case MissionState::kSearch:
      if (snapshot.terrain->applied && snapshot.terrain->applied->selection.sites.empty()) {
        return "no site: " + snapshot.terrain->applied->selection.none_reason;
      }
      return mission.why;
    default:
      return mission.why;
  }
}

}  // namespace

Result<FlownMission> FlyMission(const MissionFlight& flight, const SceneCameraFactory& camera,
                                const MissionWatcher& watcher) {
  Result<SimulatedSession> session = OpenSimulatedSession({.scenario = flight.scenario,
                                                           .seed = flight.seed,
                                                           .vehicle = flight.vehicle,
                                                           .wind_mps = flight.wind_mps},
                                                          camera);
  if (!session) {
    return session.error();
  }
  const std::shared_ptr<Simulator> simulator = session->simulator;
  const auto source = std::make_shared<FaultedSource>(simulator, simulator, flight.seed);
  if (const Status planned = source->faults().Add(flight.faults); !planned) {
    return planned.error();
  }
  EngineParts parts;
  parts.settings = flight.settings;
  parts.mission.session_id = session->id;
  parts.source = source;
  const auto link = std::make_shared<OverheardLink>(source);
  parts.link = link;
  if (!flight.record_in.empty()) {
    Result<std::unique_ptr<FlightRecorder>> recorder = FlightRecorder::Open(
        flight.record_in,
        std::filesystem::path(flight.scenario).stem().string() + "-" + std::to_string(flight.seed));
    if (!recorder) {
      return recorder.error();
    }
    parts.sink = std::move(*recorder);
  }
  Engine engine(std::move(parts), /*threaded=*/false);
  FlightSummarizer summarizer(std::move(session->scene));
  ScriptedOperator pilot(flight.looks_again, flight.looks_closer, flight.searches);
  Patience patience(flight);
  FlownMission flown;
  AreaAndWays area(flight.area);
  while (engine.Step()) {
    const auto snapshot = engine.Latest();
    summarizer.Add(*snapshot);
    area.Follow(engine, *snapshot, flown);
    for (const EngineCommand& command : pilot.Decide(*snapshot)) {
      engine.Post(command);
    }
    flown.why = WhyNotLanded(*snapshot);
    if (watcher && !watcher(*snapshot, link->newest() ? &*link->newest() : nullptr)) {
      break;
    }
    if (pilot.finished() || patience.IsOver(*snapshot, summarizer.summary())) {
      break;
    }
  }
  if (!engine.error().empty()) {
    return UnavailableError(engine.error());
  }
  if (const Status closed = engine.Stop(); !closed) {
    return closed.error();
  }
  flown.summary = summarizer.summary();
  const Touchdown* touchdown = simulator->touchdown();
  flown.touchdown = touchdown ? std::optional(*touchdown) : std::nullopt;
  return flown;
}

}  // namespace palace
