#include "gui/app/app.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/core/address_space.h"
#include "engine/core/check.h"
#include "engine/core/log.h"
#include "engine/simulation/vehicle_file.h"
#include "engine/world/scene_library.h"
#include "gui/app/exit_code.h"
#include "gui/app/run.h"
#include "gui/app/script.h"
#include "gui/app/session.h"

namespace palace {
namespace {

/// What the station maps before its first flight, with software GL; more is asked for later.
constexpr std::size_t kLeastMemory_MiB = 640;

}  // namespace

AppOptions OptionsOfNext(AppOptions options, const NextFlight& next) {
  options.script_file.clear();
  options.workspace.reset();
  if (next.choice) {
    options.workspace = Workspace::kSimulate;  // where such a choice is made
    options.scenario = next.choice->scenario;
    options.seed = next.choice->seed;
    options.vehicle = next.choice->vehicle;
  }
  if (next.kind == NextFlight::Kind::kReview) {
    if (options.source != SourceChoice::kReplay) {
      options.source = SourceChoice::kReplay;
      options.channels_file.clear();  // our logs have our own names, whatever the bus calls them
      options.settings = {};          // those of the record
    }
    options.source_path = next.log;
    options.replay_part = next.part;
    options.record = false;
  } else if (options.source == SourceChoice::kReplay) {
    options.source = SourceChoice::kSimulation;
    options.source_path.clear();
    options.replay_part = 0;
    options.channels_file.clear();
    options.settings = {};  // those were to judge the record by
    options.record = options.report;
  }
  return options;
}

FlightChoice ChoiceOf(const AppOptions& options) {
  return {options.scenario, options.seed,
          options.vehicle.empty() ? kDefaultVehicle : options.vehicle};
}

OfferedFlights FlightsOffered(const AppOptions& options) {
  OfferedFlights offered;
  for (const std::string_view name : SceneNames()) {
    offered.scenarios.emplace_back(name);
  }
  offered.vehicles = VehicleNames();
  const FlightChoice now = ChoiceOf(options);
  for (const auto& [names, own] :
       {std::pair(&offered.scenarios, &now.scenario), std::pair(&offered.vehicles, &now.vehicle)}) {
    if (std::find(names->begin(), names->end(), *own) == names->end()) {
      names->push_back(*own);
    }
  }
  return offered;
}

WayOut WayOutOfReview(const AppOptions& options) {
  const std::string ends = "Ends the review (Ctrl+N) and ";
  switch (options.source) {
    case SourceChoice::kSimulation:
      return {"New flight", ends + "starts the simulation anew"};
    case SourceChoice::kReplay:
      return {"New flight", ends + "flies the built-in simulation"};
    case SourceChoice::kConnect:
      return {"Back to live", ends + "listens to " + options.source_path + " again"};
    case SourceChoice::kCameras:
      return {"Back to cameras", ends + "opens " + options.source_path + " again"};
    case SourceChoice::kImages:
      return {"Back to images", ends + "opens " + options.source_path + " again"};
  }
  PALACE_CHECK(false);
}

int RunApp(const AppOptions& options) {
  InitLogging(options.verbose);
  if (const Status memory = EnoughMemory(kLeastMemory_MiB); !memory) {
    return FailWith(memory.error());
  }
  const Termination termination;  // before the first thread
  std::optional<std::vector<ScriptLine>> script;
  std::string script_name = options.script_file;
  if (!options.script_file.empty()) {
    Result<std::vector<ScriptLine>> lines = LoadScript(options.script_file);
    if (!lines) {
      return FailWith(lines.error());
    }
    script = std::move(*lines);
  } else if (options.headless) {
    script_name = "the default script";
    const bool mission = options.source == SourceChoice::kSimulation;
    Result<std::vector<ScriptLine>> lines =
        ParseScript(mission ? DefaultMissionScript() : DefaultViewScript(), script_name);
    PALACE_CHECK(lines.ok(), lines.error().message);
    script = std::move(*lines);
  }
  AppOptions now = options;
  while (true) {
    Result<Session> session = OpenSession(now, /*threaded=*/!now.headless);
    if (!session) {
      return FailWith(session.error());
    }
    const StationEnd end = RunStation(now, termination, *session, WayOutOfReview(options),
                                      std::exchange(script, std::nullopt), script_name);
    if (!end.script_left.empty()) {
      script = end.script_left;
    }
    // Without a window nobody but a script flies on.
    const bool goes_on = script ? end.exit_code == 0 : !now.headless;
    if (!end.next || !goes_on || termination.asked()) {
      return end.exit_code;
    }
    now = OptionsOfNext(options, *end.next);
    now.width_px = end.width_px;
    now.height_px = end.height_px;
  }
}

}  // namespace palace
