#include "engine/experiments/evaluate_things.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/experiments/ground_field.h"
#include "engine/experiments/thing_field.h"
#include "engine/model/site_standing.h"
#include "engine/report/statistics.h"
#include "engine/runtime/settings_io.h"

namespace palace {
namespace {

/// The hover drifts: nearer to the picture's edge a thing may be out of view in some frames.
constexpr double kWellInView_m = 1;

struct ThingsOptions {
  std::vector<double> heights_m = {8, 15, 20, 30};
  double size = 1;
  std::vector<std::string> only{};  ///< kinds by name; empty: all
  std::string pictures{};
  std::vector<std::string> set{};

  std::string Setup() const {
    std::string text = "heights";
    for (const double height_m : EachHeight()) {
      text += " " + CsvNumber(height_m);
    }
    text += " m, sizes times " + CsvNumber(size);
    text += only.empty() ? "" : ", only " + Joined(only);
    for (const std::string& assignment : set) {
      text += ", " + assignment;
    }
    return text;
  }
  /// One that is given twice is asked once, or its field counted twice.
  std::set<double> EachHeight() const { return {heights_m.begin(), heights_m.end()}; }
  bool Asks(ThingKind kind) const {
    return only.empty() || std::find(only.begin(), only.end(), NameOf(kind)) != only.end();
  }
};

/// What is wrong with a kind's name, or nothing.
std::string CheckKind(const std::string& name) {
  std::vector<std::string> known;
  for (const ThingKind kind : kThingKinds) {
    known.emplace_back(NameOf(kind));
  }
  return std::find(known.begin(), known.end(), name) != known.end()
             ? std::string()
             : "no kind is called \"" + name + "\"; known: " + Joined(known);
}

/// What became of the things of one field, or of the footprints of bare ground.
struct Tally {
  int asked = 0;
  int found = 0;     ///< bare ground: refused
  int not_seen = 0;  ///< of the others: no site there could be confirmed, for something may hide
};

/// Whether more may hide under a touchdown there than under a confirmed site.
bool MayHide(const HazardMaps& hazards, Cell cell) {
  return !hazards.hidden_things.empty() &&
         !(static_cast<double>(hazards.hidden_things.at(cell)) <= kMostHidden);
}

/// Visits the cells whose square reaches into the disc.
template <typename Visit>
void ForCellsNear(const GridGeometry& g, const Eigen::Vector2d& place_m, double radius_m,
                  Visit visit) {
  const double reach_m = radius_m + g.cell_m / std::sqrt(2.0);
  for (int row = 0; row < g.rows; ++row) {
    const double north_m = g.NorthOfRow(row) - place_m.x();
    for (int col = 0; std::abs(north_m) <= reach_m && col < g.cols; ++col) {
      if (std::hypot(north_m, g.EastOfCol(col) - place_m.y()) <= reach_m) {
        visit(Cell{row, col});
      }
    }
  }
}

Tally TallyThings(const ThingField& field, const ViewPlan& plan, const HazardMaps& hazards) {
  Tally tally;
  for (const Eigen::Vector2d& place_m : field.places_m) {
    const auto at = hazards.geometry.CellFromPoint(place_m.x(), place_m.y());
    if (!SeenWhole(field.world, plan, place_m, kWellInView_m) || !at) {
      continue;
    }
    bool hazard = false, known = false;
    ForCellsNear(hazards.geometry, place_m, field.reach_m, [&](Cell cell) {
      const unsigned reasons = hazards.reasons.at(cell);
      known = known || (reasons & kHazardUnknown) == 0;
      hazard = hazard || (reasons & ~unsigned{kHazardUnknown}) != 0;
    });
    ++tally.asked;
    tally.found += hazard ? 1 : 0;
    tally.not_seen += !hazard && (!known || MayHide(hazards, *at)) ? 1 : 0;
  }
  return tally;
}

/// Whether something is known of a cell: that it shows no texture is not.
bool IsKnown(const HazardMaps& hazards, Cell cell) {
  return (hazards.reasons.at(cell) & kHazardUnknown) == 0 &&
         (hazards.flags.at(cell) & kFlagNoTexture) == 0;
}

/// Footprints whose clear radius is known everywhere.
Tally TallyFootprints(const HazardMaps& hazards, double clear_radius_m) {
  Tally tally;
  const GridGeometry& g = hazards.geometry;
  const int reach = static_cast<int>(std::ceil(clear_radius_m / g.cell_m));
  for (int row = reach; row < g.rows - reach; ++row) {
    for (int col = reach; col < g.cols - reach; ++col) {
      bool known = true;
      ForCellsNear(g, {g.NorthOfRow(row), g.EastOfCol(col)}, clear_radius_m,
                   [&](Cell cell) { known = known && IsKnown(hazards, cell); });
      const bool landable = hazards.ground.at(row, col) == GroundClass::kLandable;
      tally.asked += known ? 1 : 0;
      tally.found += known && !landable ? 1 : 0;
      tally.not_seen += known && landable && MayHide(hazards, {row, col}) ? 1 : 0;
    }
  }
  return tally;
}

Result<std::vector<TrialRow>> RunTrial(const ThingsOptions& options, std::uint64_t seed) {
  const Result<Settings> settings = SettingsOfCommandLine(Settings{}, {}, options.set);
  if (!settings) {
    return settings.error();
  }
  std::vector<TrialRow> rows;
  for (const ThingKind kind : kThingKinds) {
    if (!options.Asks(kind)) {
      continue;
    }
    const ThingField field = MakeThingField(kind, options.size, seed);
    for (const double height_m : options.EachHeight()) {
      ViewPlan plan = DrawViewPlan(NameOf(kind), seed);
      plan.height_m = height_m;
      const KeptPictures kept =
          options.pictures.empty()
              ? KeptPictures{}
              : KeptPictures(options.pictures, std::string(NameOf(kind)) + "-" +
                                                   std::to_string(seed) + "-" +
                                                   CsvNumber(height_m) + "m");
      const auto frames = LookAtGround(field.world, plan, 1, settings->stereo, seed, kept);
      if (!frames) {
        return frames.error();
      }
      const auto decision = DecideOnField(*frames, *settings);
      const Tally tally =
          kind == ThingKind::kNone
              ? TallyFootprints(*decision->hazards, settings->slad.lander.clear_radius_m())
              : TallyThings(field, plan, *decision->hazards);
      rows.push_back({NameOf(kind), CsvNumber(height_m), CsvNumber(Deg(plan.tilt_rad)),
                      CsvNumber(Deg(2 * std::atan(plan.camera.width / 2.0 / plan.camera.fx_px))),
                      CsvNumber(tally.asked), CsvNumber(tally.found), CsvNumber(tally.not_seen),
                      CsvNumber(tally.asked - tally.found - tally.not_seen)});
    }
  }
  return rows;
}

int Sum(const TrialTable& table, const char* column) {
  double sum = 0;
  for (const double value : table.Numbers(column)) {
    sum += value;
  }
  return static_cast<int>(sum);
}

std::string Share(int hits, int trials) {
  if (trials == 0) {
    return "-";
  }
  const Interval share = WilsonInterval(hits, trials);
  return WithNumbers("%.0f of %.0f", hits, trials) + WithNumbers(" = %.1f %% (%.1f to %.1f)",
                                                                 100.0 * hits / trials,
                                                                 100 * share.low, 100 * share.high);
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: things of the limits' size")};
  std::vector<std::vector<std::string>> rows;
  for (const std::string& kind : table.Values("kind")) {
    const TrialTable of_kind = table.Where("kind", kind);
    for (const std::string& height : table.Values("height_m")) {
      const TrialTable at = of_kind.Where("height_m", height);
      const int asked = Sum(at, "asked");
      const bool bare = kind == NameOf(ThingKind::kNone);
      rows.push_back({bare ? "bare ground" : kind, height + " m", Share(Sum(at, "found"), asked),
                      Share(Sum(at, "not_seen"), asked), Share(Sum(at, "missed"), asked)});
      report.lines.push_back(rows.back()[0] + " at " + rows.back()[1] +
                             (bare ? ": footprints refused " : ": found ") + rows.back()[2] +
                             (bare ? "; sure " : "; missed ") + rows.back()[4]);
    }
  }
  report.page
      .Paragraph(
          "Shares with 95 % intervals (Wilson). Found: a cell that the thing touches is a hazard. "
          "Not seen: its cells are unknown, or more may hide about its middle than under a "
          "confirmed site. Missed: neither, so that a site there may be confirmed. Of bare ground: "
          "footprints, known everywhere within the clear radius (nowhere \"no texture\"), that are "
          "refused, under which too much may hide, and the others: sure. Footprints of one field "
          "are related.")
      .Table({"Thing", "Height", "Found (bare: refused)", "Not seen", "Missed (bare: sure)"}, rows);
  return report;
}

}  // namespace

Experiment ThingsExperiment() {
  auto options = std::make_shared<ThingsOptions>();
  Experiment experiment;
  experiment.name = "things";
  experiment.purpose = "Holes, rocks, kerbs, posts of the limits' size: found or missed";
  experiment.default_trials = 10;
  experiment.columns = {"kind",  "height_m", "tilt_deg", "fov_deg",
                        "asked", "found",    "not_seen", "missed"};
  experiment.add_options = [options](CLI::App& verb) {
    verb.add_option("--heights", options->heights_m, "Heights over the ground, m")
        ->delimiter(',')
        ->check(FiniteRange(3.0, 60.0))
        ->capture_default_str();
    verb.add_option("--size", options->size, "Times the things' sizes")
        ->check(FiniteRange(0.3, 3.0))
        ->capture_default_str();
    verb.add_option("--kind", options->only,
                    "Only this kind; may be given again. none: bare ground. Default: all")
        ->check(CheckKind);
    verb.add_option("--pictures", options->pictures, "Keep the drawn pairs in this folder");
    verb.add_option("--set", options->set, "One setting, e.g. slad.max_slope_deg=8");
  };
  experiment.setup = [options] { return options->Setup(); };
  experiment.run = [options](int, std::uint64_t seed) { return RunTrial(*options, seed); };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
