#include "engine/experiments/evaluate_site_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/experiments/cone_field.h"
#include "engine/experiments/field_options.h"
#include "engine/experiments/site_range_report.h"

namespace palace {
namespace {

struct RangeOptions {
  std::vector<double> altitudes_ft = {10, 20, 30, 40, 50, 60, 70, 100, 150};
  std::vector<double> cones_in = {28, 18};
  int frames = 10;
  FieldOptions field{};
};

/// How one decision compares with the truth.
struct Judgement {
  const LandingSite* site = nullptr;
  double true_distance_m = std::nan("");
  double true_slope_rad = std::nan("");
  int safe_cells = 0;     ///< truly
  int refused_cells = 0;  ///< of those
  int listed = 0, listed_unsafe = 0;
};

bool TrulySafe(const World& world, const Eigen::Vector3d& p_WS, const SladSettings& settings) {
  return ObstacleDistance(world, p_WS.x(), p_WS.y()) >= settings.lander.clear_radius_m() &&
         std::atan(world.ground.rise_north) <= Rad(settings.limits.max_slope_deg);
}

/// Cells whose clear disc lies in the map and in what both cameras see and truly has no cone in it.
void CountRefused(const ConeField& field, const TerrainDecision& decision, Judgement& judgement) {
  const double radius_m = decision.settings.lander.clear_radius_m();
  const Eigen::Vector2d room = HalfOverlap(field.view) - Eigen::Vector2d::Constant(radius_m);
  const GridGeometry& grid = decision.hazards->geometry;
  const int rim = static_cast<int>(std::ceil(radius_m / grid.cell_m));
  for (int r = rim; r < grid.rows - rim; ++r) {
    for (int c = rim; c < grid.cols - rim; ++c) {
      const double north_m = grid.NorthOfRow(r), east_m = grid.EastOfCol(c);
      const Eigen::Vector2d place = RightForward(field, north_m, east_m).cwiseAbs();
      if (place.x() > room.x() || place.y() > room.y() ||
          ObstacleDistance(field.world, north_m, east_m) < radius_m) {
        continue;
      }
      ++judgement.safe_cells;
      const float distance_m = decision.hazards->safe_distance_m.at(r, c);
      judgement.refused_cells += static_cast<double>(distance_m) >= radius_m ? 0 : 1;
    }
  }
}

Judgement Judge(const ConeField& field, const TerrainDecision& decision) {
  Judgement judgement;
  for (const LandingSite& site : decision.selection.sites) {
    ++judgement.listed;
    judgement.listed_unsafe += TrulySafe(field.world, site.p_WS, decision.settings) ? 0 : 1;
  }
  if (!decision.selection.sites.empty()) {
    judgement.site = &decision.selection.sites.front();
    judgement.true_distance_m =
        ObstacleDistance(field.world, judgement.site->p_WS.x(), judgement.site->p_WS.y());
    judgement.true_slope_rad = std::atan(field.world.ground.rise_north);
  }
  CountRefused(field, decision, judgement);
  return judgement;
}

TrialRow RowOf(double altitude_ft, double cone_in, const char* method, const ConeField& field,
               const TerrainDecision& decision) {
  const Judgement j = Judge(field, decision);
  const double unknown = std::nan("");
  const bool safe = j.site != nullptr && TrulySafe(field.world, j.site->p_WS, decision.settings);
  return {CsvNumber(altitude_ft),
          CsvNumber(cone_in),
          method,
          NameOf(field.world.ground.texture),
          CsvNumber(Deg(std::atan(field.world.ground.rise_north))),
          j.site == nullptr ? kNoSite : (safe ? kRightSite : kWrongSite),
          j.site == nullptr ? "-" : (j.site->confirmed ? kConfirmed : kProvisional),
          CsvNumber(j.site ? j.site->p_WS.x() : unknown),
          CsvNumber(j.site ? j.site->p_WS.y() : unknown),
          CsvNumber(j.true_distance_m),
          CsvNumber(j.site ? j.site->safe_distance_m : unknown),
          CsvNumber(j.site ? j.site->height_m.three_sigma : unknown),
          CsvNumber(j.site ? j.site->safe_probability : unknown),
          std::to_string(j.safe_cells),
          std::to_string(j.refused_cells),
          std::to_string(j.listed),
          std::to_string(j.listed_unsafe),
          CsvNumber(decision.hazards->geometry.cell_m)};
}

Result<std::vector<TrialRow>> RunTrial(const RangeOptions& options, std::uint64_t seed) {
  const Result<Settings> given = SettingsOf(options.field);
  if (!given) {
    return given.error();
  }
  const Settings& settings = *given;
  Settings thesis = settings;
  thesis.slad.mode = SladMode::kThesis;
  std::vector<TrialRow> rows;
  for (const double altitude_ft : options.altitudes_ft) {
    HoverView view;
    view.height_m = altitude_ft * kMetresPerFoot;
    view.field_of_view_rad = Rad(options.field.field_of_view_deg);
    view.frames = options.frames;
    const std::uint64_t field_seed =
        RandomStream(seed, "at " + CsvNumber(altitude_ft) + " ft").NextBits();
    ConeFieldPlan plan;
    plan.clear_radius_m = settings.slad.lander.clear_radius_m();
    const ConeField bare = MakeConeField(plan, view, field_seed);
    const BakedGround ground =
        BakeForHover(bare.world, bare.view, HoverPoses(bare.view, field_seed));
    for (const double cone_in : options.cones_in) {
      plan.cone_height_m = cone_in * kMetresPerFoot / 12;
      const ConeField field = MakeConeField(plan, view, field_seed);
      const auto frames =
          LookAtField(field.world, field.view, settings.stereo, field_seed, &ground);
      if (!frames) {
        return frames.error();
      }
      const auto add = [&](const char* method, const Settings& how, int count) {
        rows.push_back(
            RowOf(altitude_ft, cone_in, method, field, *DecideOnField(*frames, how, count)));
      };
      add(kFused, settings, 0);
      add(kOneFrame, settings, 1);
      add(kThesisMode, thesis, 1);
    }
  }
  return rows;
}

std::string ListText(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "" : " ") + CsvNumber(value);
  }
  return text;
}

std::string SetupText(const RangeOptions& options) {
  std::string text = "field of view " + CsvNumber(options.field.field_of_view_deg) + " deg, " +
                     std::to_string(options.frames) + " frames, altitudes " +
                     ListText(options.altitudes_ft) + " ft, cones " + ListText(options.cones_in) +
                     " in";
  for (const std::string& assignment : options.field.set) {
    text += ", " + assignment;
  }
  return text;
}

}  // namespace

Experiment SiteRangeExperiment() {
  auto options = std::make_shared<RangeOptions>();
  Experiment experiment;
  experiment.name = "site-range";
  experiment.purpose = "The right site among random cones, by altitude (thesis Table 4.5)";
  experiment.default_trials = 300;
  experiment.columns = SiteRangeColumns();
  experiment.add_options = [options](CLI::App& app) {
    app.add_option("--altitudes-ft", options->altitudes_ft, "Heights above the ground, ft")
        ->check(FiniteRange(5.0, 500.0))
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--cones-in", options->cones_in, "Heights of the cones, inches")
        ->check(FiniteRange(4.0, 60.0))
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--frames", options->frames, "Frames fused")
        ->check(FiniteRange(1, 100))
        ->capture_default_str();
    AddFieldOptions(app, options->field);
  };
  experiment.setup = [options] { return SetupText(*options); };
  experiment.run = [options](int, std::uint64_t seed) { return RunTrial(*options, seed); };
  experiment.report = ReportSiteRange;
  return experiment;
}

}  // namespace palace
