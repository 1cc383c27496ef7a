// palacectl: the engine's verbs for scripts and analysts.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/core/freed_memory.h"
#include "engine/core/log.h"
#include "engine/core/version.h"
#include "engine/tools/analyze.h"
#include "engine/tools/calibrate_command.h"
#include "engine/tools/camera_command.h"
#include "engine/tools/capture_command.h"
#include "engine/tools/evaluate_command.h"
#include "engine/tools/faults_command.h"
#include "engine/tools/log_command.h"
#include "engine/tools/simulate_command.h"
#include "engine/tools/track_command.h"
#include "engine/tools/trust_command.h"
#include "engine/tools/vehicle_command.h"
#include "engine/tools/worlds_command.h"
#include "gui/platform/offscreen_scene_camera.h"

namespace {

/// The verb that the command line chose so far, as a person types it, e.g. "palacectl camera info".
std::string VerbText(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return app.get_name() + (chosen.empty() ? "" : " " + VerbText(*chosen.front()));
}

const CLI::App& ChosenVerb(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : ChosenVerb(*chosen.front());
}

std::string VerbsOf(const CLI::App& app) {
  std::string names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    names += (names.empty() ? "" : ", ") + verb->get_name();
  }
  return names;
}

/// What is wrong with the command line. A word that no verb knows comes before options that miss:
/// it may be the missing one, misspelt.
std::string MistakeText(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& verb = ChosenVerb(app);
  const std::string name = VerbText(app);
  const std::string help = "; see " + name + " --help";
  const std::string verbs = VerbsOf(verb);
  const std::vector<std::string> unknown = app.remaining(true);
  const bool names_a_lack = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr ||
                            dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  if (!names_a_lack || unknown.empty()) {
    return error.what() + (names_a_lack && !verbs.empty() ? ": choose one of " + verbs : "") + help;
  }
  const auto is_option = [](const std::string& word) { return word.size() > 1 && word[0] == '-'; };
  if (!verbs.empty() && !is_option(unknown.front())) {  // its options are unknown with it
    return (&verb == &app ? "" : name + ": ") + "there is no command '" + unknown.front() +
           "'; choose one of " + verbs;
  }
  const auto option = std::find_if(unknown.begin(), unknown.end(), is_option);
  if (option != unknown.end()) {
    return name + " has no option " + *option + help;
  }
  return name + ": nothing is known to do with '" + unknown.front() +
         "'; files and values follow an option" + help;
}

/// False if what was printed did not arrive: a full disk behind stdout.
bool IsPrinted() {
  const bool stream = std::cout.flush().good();
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && stream;
}

int ExitCode(int code) {
  if (!IsPrinted()) {
    std::cerr << "palacectl: stdout cannot be written, what was printed is lost; choose a place "
                 "that has room\n";
    return code == 0 ? 1 : code;
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  palace::KeepFreedMemory();
  palace::InitLogging(false);
  CLI::App app(
      "PALACE without a window: simulate, analyze, capture, calibrate, camera, evaluate, "
      "faults, log, track, trust, vehicle, worlds",
      "palacectl");
  app.set_version_flag("--version", std::string("palacectl ") + palace::kProgramVersion);
  app.require_subcommand(1);
  int exit_code = 0;
  palace::AddSimulateCommand(app, exit_code, palace::MakeOffscreenSceneCamera);
  palace::AddAnalyzeCommand(app, exit_code);
  palace::AddCaptureCommand(app, exit_code);
  palace::AddCalibrateCommand(app, exit_code);
  palace::AddCameraCommand(app, exit_code);
  palace::AddEvaluateCommand(app, exit_code, palace::MakeOffscreenSceneCamera);
  palace::AddLogCommand(app, exit_code);
  palace::AddTrackCommand(app, exit_code);
  palace::AddTrustCommand(app, exit_code);
  palace::AddVehicleCommand(app, exit_code);
  palace::AddFaultsCommand(app, exit_code);
  palace::AddWorldsCommand(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {
    return ExitCode(app.exit(done));
  } catch (const CLI::ParseError& error) {
    std::cerr << "palacectl: " << MistakeText(app, error) << "\n";
    return 2;
  } catch (const std::bad_alloc&) {
    std::cerr << "palacectl: out of memory; allow this program more (ulimit -v), end other "
                 "programs, or give fewer cells or smaller pictures\n";
    return ExitCode(1);
  } catch (const std::exception& error) {  // the file system, wherever it was
    std::cerr << "palacectl: " << error.what() << "\n";
    return ExitCode(1);
  }
  return ExitCode(exit_code);
}
