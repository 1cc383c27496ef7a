// What the command line of palace asks for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/runtime/wanted_settings.h"
#include "gui/app/intent.h"

namespace palace {

enum class SourceChoice { kSimulation, kReplay, kImages, kCameras, kConnect };

struct AppOptions {
  SourceChoice source = SourceChoice::kSimulation;
  std::string source_path;  ///< log, RIG.toml or LCM URL
  int replay_part = 0;      ///< of the log; 0: the longest
  std::string scenario = "runway";
  std::uint64_t seed = 1;
  double wind_mps = 0;
  std::vector<std::string> faults;  ///< of the simulation, as fault_text.h has them
  std::string faults_file;          ///< more of them; empty: none
  std::string vehicle;              ///< a name or a file; empty: the default one
  SettingsRequest settings;         ///< read where it is known what they stand over
  std::string channels_file;        ///< empty: see channels_file.h
  std::string key;                  ///< of --connect: a name or a file; empty: see station_key.h
  /// Shown first; empty: what a person comes for with such a source (FirstWorkspace). Not of the
  /// command line: a flight begun in Simulate is looked at there.
  std::optional<Workspace> workspace{};
  bool headless = false;
  std::string script_file;
  std::filesystem::path record_dir = "logs";
  bool record = true;
  bool report = true;  ///< false: not even report.html is left behind
  int width_px = 1920;
  int height_px = 1080;
  double ui_scale = 0;  ///< 0: from the monitor
  std::string theme = "dark";
  bool verbose = false;
  std::string print;  ///< of --help and --version: print this and leave
};

/// Errors are usage errors (exit 2).
Result<AppOptions> ParseCommandLine(int argc, const char* const* argv);

}  // namespace palace
