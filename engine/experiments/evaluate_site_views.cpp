#include "engine/experiments/evaluate_site_views.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/random.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/experiments/cone_field.h"
#include "engine/experiments/field_trial.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

using Eigen::Vector2d;

constexpr double kSame_m = 0.5;  ///< the thesis's repeatability, as wanted here
constexpr double kLowest_ft = 35, kHighest_ft = 60;

struct ViewsOptions {
  int viewpoints = 20;
  int frames = 10;
};

/// Cones all over, too close for a lander, but for one disc about `clear_middle`: the only site.
struct ClosedField {
  World world;
  Vector2d clear_middle = Vector2d::Zero();
  double clear_radius_m = 0;
};

ClosedField MakeClosedField(std::uint64_t seed) {
  constexpr double kSpacing_m = 2.6, kJitter_m = 0.3, kHalf_m = 13;
  RandomStream random(seed, "closed field");
  ClosedField field;
  field.world.ground.texture = static_cast<GroundTexture>(random.Index(4));
  field.world.ground.texture_seed = random.NextBits() >> 16;
  field.world.ground.rise_north = std::tan(random.Uniform(0, Rad(3)));
  field.clear_middle = {random.Uniform(-1, 1), random.Uniform(-1, 1)};
  field.clear_radius_m = random.Uniform(2.8, 3.2);
  const double row_m = kSpacing_m * std::numbers::sqrt3 / 2;
  for (int i = -6; i <= 6; ++i) {
    for (int j = -6; j <= 6; ++j) {
      const Vector2d at(i * row_m + random.Uniform(-kJitter_m, kJitter_m),
                        (j + 0.5 * (i & 1)) * kSpacing_m + random.Uniform(-kJitter_m, kJitter_m));
      const double turn_rad = random.Uniform(0, std::numbers::pi);
      if (at.cwiseAbs().maxCoeff() > kHalf_m ||
          (at - field.clear_middle).norm() < field.clear_radius_m) {
        continue;
      }
      for (const Solid& part : MakeTrafficCone(0, 0, kTallCone_m)) {
        const double down_m = -field.world.ground.rise_north * at.x() + 0.01;
        field.world.solids.push_back(Moved(part, turn_rad, {at.x(), at.y(), down_m}));
      }
    }
  }
  return field;
}

/// Any height, heading and tilt whose pictures and map hold the clear disc: from high up the map is
/// smaller than the pictures, and what lies outside it cannot be chosen.
HoverView RandomViewpoint(const ClosedField& field, const ViewsOptions& options,
                          const SladSettings& slad, RandomStream& random) {
  HoverView view;
  view.frames = options.frames;
  view.height_m = random.Uniform(kLowest_ft, kHighest_ft) * kMetresPerFoot;
  view.heading_rad = random.Uniform(-std::numbers::pi, std::numbers::pi);
  view.tilt_rad = -std::numbers::pi / 2 + random.Uniform(-Rad(8), Rad(8));
  // Where the picture's middle falls: the disc may stand off it while it stays in both pictures
  // and, at any heading, in the map, which follows the picture's middle within a metre.
  const double slack_m = std::max(0.0, HalfOverlap(view).minCoeff() - field.clear_radius_m - 1.0);
  Vector2d off(random.Uniform(-slack_m, slack_m), random.Uniform(-slack_m, slack_m));
  const double half_map_m = std::min(slad.grid.rows, slad.grid.cols) * slad.grid.cell_m / 2;
  const double most_m = std::max(0.1, half_map_m - field.clear_radius_m - 1.5);
  off *= std::min(1.0, most_m / std::max(off.norm(), 1e-9));
  const double right_m = off.x() - view.baseline_m / 2;
  const double forward_m =
      off.y() + view.height_m * std::tan(-std::numbers::pi / 2 - view.tilt_rad);
  const double c = std::cos(view.heading_rad), s = std::sin(view.heading_rad);
  const double ground_m = field.world.ground.rise_north * field.clear_middle.x();
  view.north_m = field.clear_middle.x() + c * forward_m - s * right_m;
  view.east_m = field.clear_middle.y() + s * forward_m + c * right_m;
  view.height_m += ground_m;
  return view;
}

Result<std::vector<TrialRow>> RunTrial(const ViewsOptions& options, std::uint64_t seed) {
  const ClosedField field = MakeClosedField(seed);
  const Settings settings;
  RandomStream random(seed, "viewpoints");
  std::vector<TrialRow> rows;
  for (int i = 0; i < options.viewpoints; ++i) {
    const HoverView view = RandomViewpoint(field, options, settings.slad, random);
    const auto frames = LookAtField(field.world, view, settings.stereo, random.NextBits());
    if (!frames) {
      return frames.error();
    }
    const auto decision = DecideOnField(*frames, settings);
    const bool found = !decision->selection.sites.empty();
    const double unknown = std::nan("");
    const Eigen::Vector3d p_WS =
        found ? decision->selection.sites.front().p_WS : Eigen::Vector3d::Constant(unknown);
    rows.push_back(
        {std::to_string(i + 1), NameOf(field.world.ground.texture),
         CsvNumber(view.height_m / kMetresPerFoot), CsvNumber(Deg(view.heading_rad)),
         CsvNumber(Deg(view.tilt_rad)), CsvNumber(view.north_m), CsvNumber(view.east_m),
         found ? "found" : "none", CsvNumber(p_WS.x()), CsvNumber(p_WS.y()),
         CsvNumber(found ? ObstacleDistance(field.world, p_WS.x(), p_WS.y()) : unknown),
         CsvNumber(found ? decision->selection.sites.front().safe_distance_m : unknown)});
  }
  return rows;
}

// ---- report ----

/// Sites of one field about their mean place.
struct FieldSpread {
  int viewpoints = 0, found = 0, same = 0;
  double rms_m = 0, most_m = 0;
  double least_distance_m = 0;  ///< true, to the nearest cone
  PlotSeries places;
};

FieldSpread SpreadOfField(const TrialTable& rows) {
  FieldSpread spread;
  spread.viewpoints = static_cast<int>(rows.rows.size());
  const auto north = rows.Numbers("site_north_m"), east = rows.Numbers("site_east_m");
  const Vector2d mean(SpreadOf(north).mean, SpreadOf(east).mean);
  double square = 0;
  for (std::size_t i = 0; i < north.size(); ++i) {
    if (!std::isfinite(north[i])) {
      continue;
    }
    const Vector2d off = Vector2d(north[i], east[i]) - mean;
    ++spread.found;
    spread.same += off.norm() <= kSame_m ? 1 : 0;
    square += off.squaredNorm();
    spread.most_m = std::max(spread.most_m, off.norm());
    spread.places.x.push_back(off.y());
    spread.places.y.push_back(off.x());
  }
  spread.rms_m = spread.found > 0 ? std::sqrt(square / spread.found) : std::nan("");
  spread.least_distance_m = SpreadOf(rows.Numbers("true_distance_m")).min;
  return spread;
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: one field, many viewpoints, one site")};
  report.page.Paragraph(
      "Cones of 28 in stand all over a sloping field, too close together for a lander, but for one "
      "disc of 2.8 to 3.2 m radius. Each viewpoint has its own place, heading, height (35 to 60 "
      "ft) and tilt (within 8° of straight down), 10 frames of drift, sensor noise and pose "
      "errors; pictures and map hold the disc. The chosen site should be one place whoever looks: "
      "within 0.5 m of the mean over all viewpoints. "
      "Below 35 ft the disc does not stay in both pictures from every heading.");
  LinePlot plot{"Chosen sites about their field's mean place", "east, m", "north, m"};
  std::vector<std::vector<std::string>> rows;
  int viewpoints = 0, same = 0;
  double most_m = 0;
  for (const std::string& seed : table.Values("seed")) {
    const TrialTable field = table.Where("seed", seed);
    FieldSpread spread = SpreadOfField(field);
    viewpoints += spread.viewpoints;
    same += spread.same;
    most_m = std::max(most_m, spread.most_m);
    rows.push_back({seed, field.Values("texture").front(), std::to_string(spread.viewpoints),
                    std::to_string(spread.found), std::to_string(spread.same),
                    OrDash("%.2f", spread.rms_m), OrDash("%.2f", spread.most_m),
                    OrDash("%.2f", spread.least_distance_m)});
    spread.places.name = "seed " + seed;
    spread.places.line = false;
    plot.series.push_back(std::move(spread.places));
    report.lines.push_back("seed " + seed + ", " + rows.back()[1] + ": " + rows.back()[4] + " of " +
                           rows.back()[2] + " viewpoints within 0.5 m, rms " + rows.back()[5] +
                           " m, most " + rows.back()[6] + " m, nearest cone " + rows.back()[7] +
                           " m");
  }
  const Interval interval = WilsonInterval(same, viewpoints);
  const std::string text =
      std::to_string(same) + " of " + std::to_string(viewpoints) +
      " viewpoints chose the same site within 0.5 m (" + OrDash("%.1f", 100 * interval.low) + "-" +
      OrDash("%.1f %%", 100 * interval.high) + "), the farthest " + OrDash("%.2f m", most_m);
  report.Judge(viewpoints > 0 && same == viewpoints, text);
  report.page.Figure(LinePlotSvg(plot), "One colour a field.")
      .Table({"seed", "texture", "viewpoints", "site found", "within 0.5 m", "rms, m", "most, m",
              "least true distance to a cone, m"},
             rows);
  return report;
}

}  // namespace

Experiment SiteViewsExperiment() {
  auto options = std::make_shared<ViewsOptions>();
  Experiment experiment;
  experiment.name = "site-views";
  experiment.purpose = "One field from many viewpoints: the same site";
  experiment.default_trials = 5;
  experiment.columns = {"viewpoint",    "texture",     "height_ft",       "heading_deg",
                        "tilt_deg",     "north_m",     "east_m",          "outcome",
                        "site_north_m", "site_east_m", "true_distance_m", "safe_distance_m"};
  experiment.add_options = [options](CLI::App& app) {
    app.add_option("--viewpoints", options->viewpoints, "Viewpoints of each field")
        ->check(FiniteRange(2, 200))
        ->capture_default_str();
    app.add_option("--frames", options->frames, "Frames fused at each")
        ->check(FiniteRange(1, 100))
        ->capture_default_str();
  };
  experiment.setup = [options] {
    return std::to_string(options->viewpoints) + " viewpoints, " + std::to_string(options->frames) +
           " frames";
  };
  experiment.run = [options](int, std::uint64_t seed) { return RunTrial(*options, seed); };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
