#include "gui/app/options.h"

#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/text.h"
#include "engine/core/version.h"
#include "engine/faults/fault_plan.h"
#include "engine/model/settings/settings.h"
#include "engine/simulation/vehicle_file.h"
#include "engine/world/scene_library.h"

namespace palace {
namespace {

/// One of these, or none.
struct SourceArguments {
  std::string replay;
  std::string images;
  std::string cameras;
  std::string connect;
};

void Declare(CLI::App& app, AppOptions& options, SourceArguments& sources, bool& no_record) {
  app.set_version_flag("--version", std::string("palace ") + kProgramVersion);
  auto* source = app.add_option_group(
      "source", "Where the pictures come from; nothing: the built-in simulated mission");
  source->add_option("--scenario", options.scenario, "Simulated scene: " + SceneList())
      ->capture_default_str();
  source->add_option("--replay", sources.replay, "Play a recorded flight (LCM event log)");
  app.add_option("--part", options.replay_part,
                 "Of a log in which the vehicle restarted, the part to play; else the longest")
      ->check(CLI::PositiveNumber);
  source->add_option(
      "--images", sources.images,
      "Stereo pairs from disk: their RIG.toml, or a folder in EuRoC's layout (mav0 with "
      "cam0 and cam1), with its poses");
  source->add_option("--cameras", sources.cameras,
                     "Stereo cameras without a vehicle, by [capture] of their RIG.toml: V4L2 "
                     "devices, RTSP or HTTP streams, video files");
  source->add_option("--connect", sources.connect,
                     "A live vehicle on an LCM bus, e.g. udpm://239.255.76.67:7667?ttl=0");
  app.add_option("--vehicle", options.vehicle,
                 "The vehicle simulated, or the one that --connect or pictures speak of: " +
                     Joined(VehicleNames()) + ", or its file (default " + kDefaultVehicle + ")");
  app.add_option("--seed", options.seed, "One seed decides everything in the simulation")
      ->check(Seed())
      ->capture_default_str();
  app.add_option("--wind", options.wind_mps,
                 WithNumbers("Mean wind of the simulation 6 m above ground, m/s; with more at the "
                             "vehicle than its limit (%.0f for the default one) nothing can be "
                             "approved",
                             MissionSettings{}.max_wind_mps, 0))
      ->check(FiniteRange(0.0, 15.0))
      ->capture_default_str();
  app.add_option("--fault", options.faults, kFaultHelp);
  app.add_option("--faults", options.faults_file, kFaultsHelp);
  app.add_option("--settings", options.settings.file, "Settings file (TOML)");
  app.add_option(
      "--channels", options.channels_file,
      "Channel names of --connect or --replay (TOML); without it a vehicle's are those of "
      "config/channels.toml beside this program");
  app.add_option("--key", options.key,
                 "Key to command the vehicle of --connect with: a name (palacectl trust list) or a "
                 "file; without it the only key there is, else the station may only look");
  app.add_option("--set", options.settings.set,
                 "One setting, e.g. slad.max_slope_deg=8; may be repeated");
  app.add_flag("--headless", options.headless,
               "No window: draw offscreen and fly the mission by script");
  app.add_option("--script", options.script_file,
                 "Drive the window by item name (README, \"Scripts\")");
  app.add_option("--record", options.record_dir, "Folder for flight logs")->capture_default_str();
  app.add_flag("--no-record", no_record, "Do not record the flight, leave no report");
  app.add_option("--width", options.width_px, "Window width, pixels")
      ->check(FiniteRange(640, 7680))
      ->capture_default_str();
  app.add_option("--height", options.height_px, "Window height, pixels")
      ->check(FiniteRange(480, 4320))
      ->capture_default_str();
  app.add_option("--ui-scale", options.ui_scale,
                 "Size of text and controls, 0.75 to 2.5; 0: from the monitor")
      ->capture_default_str();
  app.add_option("--theme", options.theme, "dark, light or contrast")
      ->check(CLI::IsMember({"dark", "light", "contrast"}))
      ->capture_default_str();
  app.add_flag("--verbose", options.verbose, "Also print messages for developers");
}

const char* OptionOf(SourceChoice source) {
  switch (source) {
    case SourceChoice::kReplay:
      return "--replay";
    case SourceChoice::kImages:
      return "--images";
    case SourceChoice::kCameras:
      return "--cameras";
    case SourceChoice::kConnect:
      return "--connect";
    case SourceChoice::kSimulation:
      break;
  }
  return "--scenario";
}

}  // namespace

Result<AppOptions> ParseCommandLine(int argc, const char* const* argv) {
  AppOptions options;
  SourceArguments sources;
  bool no_record = false;
  CLI::App app("PALACE ground station: find a safe landing site, approve it, watch the descent",
               "palace");
  app.footer(
      "Exit 0 done, 1 failed, 2 bad usage. SIGINT (Ctrl-C), SIGTERM and SIGHUP end the station in "
      "order: log closed, report written, exit 128 + signal; a second one ends it at once.\n"
      "A flight log grows by about 6.3 MB a second, 23 GB an hour; each flight has a folder of its "
      "own below --record, remove what you do not need. When the disk fills, pictures are thinned "
      "first; telemetry and decisions are recorded to the last.");
  Declare(app, options, sources, no_record);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    options.print = app.help();
    return options;
  } catch (const CLI::CallForVersion&) {
    options.print = std::string("palace ") + kProgramVersion + "\n";
    return options;
  } catch (const CLI::ParseError& error) {
    return UsageError(std::string(error.what()) + "; see palace --help");
  }
  const std::pair<const std::string*, SourceChoice> choices[] = {
      {&sources.replay, SourceChoice::kReplay},
      {&sources.images, SourceChoice::kImages},
      {&sources.cameras, SourceChoice::kCameras},
      {&sources.connect, SourceChoice::kConnect}};
  int chosen = 0;
  for (const auto& [path, choice] : choices) {
    if (!path->empty()) {
      ++chosen;
      options.source = choice;
      options.source_path = *path;
    }
  }
  if (app.count("--connect") > 0 && sources.connect.empty()) {
    return UsageError("--connect needs the URL of a bus, e.g. udpm://239.255.76.67:7667?ttl=0");
  }
  for (const auto& [path, choice] : choices) {
    if (app.count(OptionOf(choice)) > 0 && path->empty()) {
      return UsageError(std::string(OptionOf(choice)) + " needs a path; it is empty");
    }
  }
  if (chosen > 1) {
    return UsageError("--replay, --images, --cameras and --connect exclude each other");
  }
  if (chosen > 0) {
    for (const char* simulated : {"--scenario", "--seed", "--wind", "--fault", "--faults"}) {
      if (app.count(simulated) > 0) {
        return UsageError(std::string(simulated) +
                          " is of the built-in simulation; leave it out with " +
                          OptionOf(options.source));
      }
    }
  }
  if (!options.vehicle.empty() && options.source == SourceChoice::kReplay) {
    return UsageError("--vehicle is not of --replay: a record tells its own; leave it out here");
  }
  if (!options.channels_file.empty() && options.source != SourceChoice::kConnect &&
      options.source != SourceChoice::kReplay) {
    return UsageError("--channels is of --connect and --replay; leave it out here");
  }
  if (options.replay_part != 0 && options.source != SourceChoice::kReplay) {
    return UsageError("--part is of --replay; leave it out here");
  }
  if (!options.key.empty() && options.source != SourceChoice::kConnect) {
    return UsageError("--key is of --connect; leave it out here");
  }
  if (options.ui_scale != 0 && !(options.ui_scale >= 0.75 && options.ui_scale <= 2.5)) {
    return UsageError("--ui-scale is " + NumberText(options.ui_scale) +
                      "; it must lie between 0.75 and 2.5, or be 0");
  }
  options.report = !no_record;
  // A replay, or pictures from disk, are on disk already.
  options.record = !no_record && options.source != SourceChoice::kReplay &&
                   options.source != SourceChoice::kImages;
  return options;
}

}  // namespace palace
