#include "engine/tools/analyze.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/command_line.h"
#include "engine/core/text.h"
#include "engine/model/site_standing.h"
#include "engine/runtime/settings_io.h"
#include "engine/slad/hazards/explanation.h"
#include "engine/tools/analyze_files.h"
#include "engine/tools/analyze_inputs.h"
#include "engine/tools/analyze_outcome.h"
#include "engine/tools/explanation_json.h"
#include "engine/tools/stage_progress.h"

namespace palace {
namespace {

struct Options {
  std::string left, right, rig, poses, euroc, settings_file, out, elevation, points;
  std::vector<std::string> set;
  std::optional<double> cell_m;
  std::vector<std::string> explain;
};

Status CheckOptions(const Options& options) {
  const bool pair = !options.left.empty() || !options.right.empty() || !options.rig.empty();
  const int inputs = int{pair} + int{!options.euroc.empty()} + int{!options.elevation.empty()} +
                     int{!options.points.empty()};
  if (inputs != 1) {
    return UsageError(
        "give one input: --left, --right and --rig, or --euroc, or --elevation, or --points");
  }
  if (pair && (options.left.empty() || options.right.empty() || options.rig.empty())) {
    return UsageError("a pair needs all of --left, --right and --rig");
  }
  if (!pair && !options.poses.empty()) {
    return UsageError("--poses belongs to --left, --right and --rig");
  }
  for (const std::string& text : options.explain) {
    if (const auto cell = ParseCell(text); !cell) {
      return cell.error();
    }
  }
  return Ok();
}

Result<Settings> LoadSettings(const Options& options) {
  Result<Settings> settings = SettingsOfCommandLine(Settings{}, options.settings_file, {});
  if (settings && options.cell_m) {
    settings->slad.grid.cell_m = *options.cell_m;
  }
  return settings ? SettingsOfCommandLine(*settings, {}, options.set) : settings;
}

Result<AnalyzeInput> LoadInput(const Options& options, const Settings& settings) {
  if (!options.elevation.empty()) {
    return ElevationOfModel(options.elevation, options.cell_m, settings);
  }
  if (!options.points.empty()) {
    return ElevationOfCloud(options.points, options.cell_m, settings);
  }
  return ElevationOfPairs({options.left, options.right, options.rig, options.poses, options.euroc},
                          settings);
}

void WarnOfCell(const SladSettings& slad, std::vector<std::string>& warnings) {
  if (slad.grid.cell_m > slad.lander.max_rock_size_m) {
    warnings.push_back(
        WithNumbers("cells of %.3g m are larger than slad.max_rock_size_m (%.3g m): lower rocks of "
                    "that size may be averaged away",
                    slad.grid.cell_m, slad.lander.max_rock_size_m));
  }
}

Status Analyze(const Options& options) {
  if (const Status good = CheckOptions(options); !good) {
    return good;
  }
  const auto settings = LoadSettings(options);
  if (!settings) {
    return settings.error();
  }
  const StageProgress progress("analyze");
  progress.Begin("reading (1 of 3)");
  auto input = LoadInput(options, *settings);
  if (!input) {
    return input.error();
  }
  const GridGeometry& grid = input->slad.elevation()->geometry;
  if (const Status room = RoomToDecide(grid, settings->slad.mode, "ask for larger cells"); !room) {
    return room;
  }
  for (const std::string& text : options.explain) {
    if (!grid.Contains(*ParseCell(text))) {  // its form was checked with the options
      return UsageError("--explain " + text +
                        WithNumbers(": the map has rows 0 to %.0f and columns 0 to %.0f",
                                    grid.rows - 1, grid.cols - 1));
    }
  }
  progress.Begin(WithNumbers("judging %.0f x %.0f cells (2 of 3)", grid.cols, grid.rows));
  AnalyzeOutcome o{{}, options.settings_file, std::move(input).value(), *settings};
  for (const std::string* file : {&options.left, &options.right, &options.rig, &options.poses,
                                  &options.euroc, &options.elevation, &options.points}) {
    if (!file->empty()) {
      o.files.push_back(*file);
    }
  }
  o.decision = o.input.slad.Decide(o.settings, Letters::kOfRecord);
  o.input.watch.Lap("decide");
  o.settings.slad.grid.cell_m = o.map().geometry.cell_m;
  WarnOfCell(o.settings.slad, o.input.warnings);
  progress.End();
  for (const std::string& text : options.explain) {
    const auto cell = ParseCell(text);  // checked with the options
    o.explained.push_back(ExplainCell(o.map(), o.hazards(), o.settings.slad, *cell));
    std::printf("cell %d,%d: %s\n", cell->row, cell->col, o.explained.back().verdict.c_str());
  }
  progress.Begin("writing (3 of 3)");
  const auto is_there = [&](const char* name) {
    std::error_code none;
    return std::filesystem::exists(std::filesystem::path(options.out) / name, none);
  };
  const bool replaces = is_there("site.json");
  const bool replaces_other = is_there("report.html") || is_there("elevation.tif");
  if (const Status done = PublishAnalysis(o, options.out); !done) {
    return done;
  }
  progress.End();
  if (replaces) {
    std::cerr << "palacectl: warning: an earlier analysis in " << options.out << " was replaced\n";
  } else if (replaces_other) {
    std::cerr << "palacectl: warning: report.html or elevation.tif in " << options.out
              << " were of something else and were replaced\n";
  }
  for (const std::string& warning : o.input.warnings) {
    std::cerr << "palacectl: warning: " << warning << '\n';
  }
  if (o.selection().sites.empty()) {
    std::cout << "no landing site: " << o.selection().none_reason << '\n';
  } else {
    const LandingSite& site = o.selection().sites.front();
    const std::string doubt = WhyProvisional(site, o.settings.slad);
    std::printf(
        "landing site at row %d, column %d, %.2f m north, %.2f m east, %.2f m clear, %.2f m "
        "needed%s\n",
        site.cell.row, site.cell.col, site.p_WS.x(), site.p_WS.y(), site.safe_distance_m,
        site.clear_radius_m,
        doubt.empty()
            ? ""
            : (std::string(", ") + StandingWord(StandingOf(site, o.settings.slad)) + ": " + doubt)
                  .c_str());
  }
  return Ok();
}

}  // namespace

void AddAnalyzeCommand(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "analyze", "stereo pairs, an elevation model or a point cloud: maps and landing site");
  auto options = std::make_shared<Options>();
  verb->add_option("--left", options->left,
                   "left picture; with --poses a pattern such as 'left_*.png'");
  verb->add_option("--right", options->right, "right picture or pattern");
  verb->add_option("--rig", options->rig, "RIG.toml");
  verb->add_option(
      "--poses", options->poses,
      "POSES.csv of several pairs (file,time,north,east,down,roll,pitch,heading), "
      "which modern mode fuses in order of time; without it [images] poses of RIG.toml");
  verb->add_option("--euroc", options->euroc,
                   "a folder in EuRoC's layout (mav0 with cam0, cam1, "
                   "state_groundtruth_estimate0) instead: its pairs with its poses");
  verb->add_option("--elevation", options->elevation, "GeoTIFF elevation model instead of a pair");
  verb->add_option("--points", options->points, "xyz or ply cloud instead of a pair");
  verb->add_option("--cell-m", options->cell_m, "cell size for --elevation and --points, metres")
      ->check(FiniteRange(0.001, 1000));
  verb->add_option("--settings", options->settings_file, "settings TOML");
  verb->add_option("--set", options->set, "one setting, e.g. slad.max_slope_deg=8; repeatable")
      ->take_all();
  verb->add_option("--explain", options->explain,
                   "row,col of a cell: why it is as it is, printed and in site.json; repeatable")
      ->take_all();
  verb->add_option("--out", options->out,
                   "folder for site.json, report.html, pictures, and the layers as GeoTIFF: "
                   "metres, slope.tif in radians, NaN unknown")
      ->required();
  verb->callback([options, &exit_code] {
    const Status done = Analyze(*options);
    if (!done) {
      std::cerr << "palacectl analyze: " << done.error().message << '\n';
      exit_code = done.error().code == ErrorCode::kUsage ? 2 : 1;
    }
  });
}

}  // namespace palace
