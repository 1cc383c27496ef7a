// palacectl: the engine's verbs for scripts and analysts.
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>

#include "engine/core/log.h"
#include "engine/tools/analyze.h"
#include "engine/tools/calibrate_command.h"
#include "engine/tools/camera_command.h"
#include "engine/tools/capture_command.h"
#include "engine/tools/evaluate_command.h"
#include "engine/tools/log_command.h"
#include "engine/tools/simulate_command.h"
#include "gui/platform/offscreen_scene_camera.h"

int main(int argc, char** argv) {
  palace::InitLogging(false);
  CLI::App app(
      "PALACE without a window: simulate, analyze, capture, calibrate, camera, evaluate, log",
      "palacectl");
  app.set_version_flag("--version", "palacectl 0.1.0");
  app.require_subcommand(1);
  int exit_code = 0;
  palace::AddSimulateCommand(app, exit_code, palace::MakeOffscreenSceneCamera);
  palace::AddAnalyzeCommand(app, exit_code);
  palace::AddCaptureCommand(app, exit_code);
  palace::AddCalibrateCommand(app, exit_code);
  palace::AddCameraCommand(app, exit_code);
  palace::AddEvaluateCommand(app, exit_code, palace::MakeOffscreenSceneCamera);
  palace::AddLogCommand(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::RequiredError& error) {
    const std::string verb = argc > 1 ? argv[1] : "";
    if (!verb.empty() && verb[0] != '-' && app.get_subcommands().empty()) {
      std::cerr
          << "palacectl: there is no command '" << verb
          << "'; choose one of simulate, analyze, capture, calibrate, camera, evaluate, log\n";
    } else {
      std::cerr << "palacectl: " << error.what() << "; see palacectl --help\n";
    }
    return 2;
  } catch (const CLI::ParseError& error) {
    std::cerr << "palacectl: " << error.what() << "; see palacectl --help\n";
    return 2;
  }
  return exit_code;
}
