#include "engine/experiments/evaluate_site_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/units.h"
#include "engine/experiments/field_options.h"
#include "engine/experiments/shape_field.h"
#include "engine/slad/hazards/explanation.h"
#include "engine/slad/slad.h"

namespace palace {
namespace {

constexpr std::array kLimits_m = {0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.10, 0.12};
constexpr double kStepPerDeviation = 1.5;
constexpr std::array kFrames = {1, 10};
constexpr std::array kKinds = {ShapeFieldKind::kObjects, ShapeFieldKind::kObjects,
                               ShapeFieldKind::kSlope, ShapeFieldKind::kHouse};

struct ShapesOptions {
  double height_ft = 50;
  FieldOptions field{45, {}};
};

/// One judged map and the field it shows.
struct Judged {
  Judged(const ShapeField& its_field, const HoverView& its_view,
         std::shared_ptr<const TerrainDecision> its_decision)
      : field(its_field),
        view(its_view),
        decision(std::move(its_decision)),
        map(*decision->elevation),
        hazards(*decision->hazards),
        settings(decision->settings) {}

  const ShapeField& field;
  const HoverView& view;
  std::shared_ptr<const TerrainDecision> decision;
  const ElevationMap& map;
  const HazardMaps& hazards;
  const SladSettings& settings;
  double north(int row) const { return map.geometry.NorthOfRow(row); }
  double east(int col) const { return map.geometry.EastOfCol(col); }
};

/// Rows of one field seen in so many frames and judged under one limit.
class RowWriter {
 public:
  RowWriter(const ShapeField& field, int frames, std::vector<TrialRow>& rows)
      : start_{NameOf(field.kind), NameOf(field.world.ground.texture), std::to_string(frames)},
        rows_(rows) {}

  struct Counts {
    int tested = 0;
    int found = 0;
    int elevated = 0;
    int accepted = 0;
  };
  void Add(const std::string& shape, double limit_m, const Counts& n, double error_deg = NAN,
           const std::string& held = "-") {
    TrialRow row = start_;
    row.insert(row.end(), {shape, CsvNumber(100 * limit_m), std::to_string(n.tested),
                           std::to_string(n.found), std::to_string(n.elevated),
                           std::to_string(n.accepted), CsvNumber(error_deg), held});
    rows_.push_back(std::move(row));
  }

 private:
  TrialRow start_;
  std::vector<TrialRow>& rows_;
};

std::vector<std::string> Columns() {
  return {"field", "texture",  "frames",   "shape",     "limit_cm", "tested",
          "found", "elevated", "accepted", "error_deg", "held"};
}

bool IsKnownHazard(const HazardMaps& hazards, Cell cell) {
  return (hazards.reasons.at(cell) & ~(kHazardUnknown | kHazardFlagged)) != 0;
}

template <typename Visit>
void ForCells(const GridGeometry& g, Visit visit) {
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      visit(Cell{r, c});
    }
  }
}

bool IsDetected(const Judged& judged, const PlacedShape& shape) {
  bool detected = false;
  ForCells(judged.map.geometry, [&](Cell cell) {
    detected = detected || (IsKnownHazard(judged.hazards, cell) &&
                            DistanceToShape(judged.field, shape, judged.north(cell.row),
                                            judged.east(cell.col)) <= judged.map.geometry.cell_m);
  });
  return detected;
}

bool IsSeen(const Judged& judged, Cell cell, double margin_m) {
  const GroundInView seen = GroundSeenBy(judged.view);
  const double n = judged.north(cell.row), e = judged.east(cell.col);
  return n - margin_m >= seen.north_min_m && n + margin_m <= seen.north_max_m &&
         e - margin_m >= seen.east_min_m && e + margin_m <= seen.east_max_m;
}

/// Measured cells seen whole, more than two cells from any solid, and those of them that are known
/// hazards.
RowWriter::Counts CountClearCells(const Judged& judged) {
  RowWriter::Counts n;
  ForCells(judged.map.geometry, [&](Cell cell) {
    if (judged.map.state.at(cell) == CellState::kMeasured && IsSeen(judged, cell, 0) &&
        ObstacleDistance(judged.field.world, judged.north(cell.row), judged.east(cell.col)) >
            2 * judged.map.geometry.cell_m) {
      ++n.tested;
      n.found += IsKnownHazard(judged.hazards, cell) ? 1 : 0;
    }
  });
  return n;
}

/// Whether the lander could be sent to the cell: the rule of site selection.
bool IsOffered(const Judged& judged, Cell cell) {
  return ExplainCell(judged.map, judged.hazards, judged.settings, cell).can_bear;
}

/// What stands against a footprint that is refused.
const char* CauseOfRefusal(const Judged& judged, Cell centre) {
  unsigned reasons = 0;
  const double radius_m = judged.settings.lander.clear_radius_m();
  ForCells(judged.map.geometry, [&](Cell cell) {
    const double away_m =
        judged.map.geometry.cell_m * std::hypot(cell.row - centre.row, cell.col - centre.col);
    reasons |= away_m <= radius_m ? judged.hazards.reasons.at(cell) : 0U;
  });
  return (reasons & (kHazardSlope | kHazardRoughness | kHazardStep)) != 0 ? kRefusedByHeight
         : (reasons & kHazardFlagged) != 0                                ? kRefusedByFlags
         : (reasons & kHazardUnknown) != 0                                ? kRefusedByUnknown
                                                                          : kRefusedByOdds;
}

/// Footprints a lander radius apart, on a field without objects.
void AddFootprints(const Judged& judged, double limit_m, RowWriter& rows) {
  const int apart =
      std::max(1, static_cast<int>(judged.settings.lander.radius_m() / judged.map.geometry.cell_m));
  const double truth_rad = std::atan(judged.field.world.ground.rise_north);
  RowWriter::Counts n;
  ForCells(judged.map.geometry, [&](Cell cell) {
    if (cell.row % apart != 0 || cell.col % apart != 0 ||
        !IsSeen(judged, cell, judged.settings.lander.clear_radius_m())) {
      return;
    }
    ++n.tested;
    if (!IsOffered(judged, cell)) {
      ++n.found;
      rows.Add(CauseOfRefusal(judged, cell), limit_m, {1, 1});
    }
    if (limit_m == kShapesLimit_m) {
      const double slope_rad = static_cast<double>(judged.hazards.slope_rad.at(cell));
      rows.Add(kGroundSlope, limit_m, {1, 0}, Deg(slope_rad - truth_rad));
    }
  });
  rows.Add(kClearFootprints, limit_m, n);
}

/// Cells well inside a raised top: hazards under slad.elevated = avoid, cells called elevated, and
/// cells without a hazard under allow.
RowWriter::Counts CountTop(const Judged& avoided, const Judged& allowed, const PlacedShape& shape) {
  RowWriter::Counts n;
  ForCells(avoided.map.geometry, [&](Cell cell) {
    const double north_m = avoided.north(cell.row), east_m = avoided.east(cell.col);
    if (DepthInShape(avoided.field, shape, north_m, east_m) < 1.5 * avoided.map.geometry.cell_m) {
      return;
    }
    for (const PlacedShape& other : avoided.field.shapes) {  // what stands on it is no top
      if (other.first_solid != shape.first_solid &&
          DistanceToShape(avoided.field, other, north_m, east_m) <
              2 * avoided.map.geometry.cell_m) {
        return;
      }
    }
    const bool has_flags = !avoided.hazards.flags.empty();
    ++n.tested;
    n.found += avoided.hazards.reasons.at(cell) != kHazardNone ? 1 : 0;
    n.elevated += has_flags && (avoided.hazards.flags.at(cell) & kFlagElevated) != 0 ? 1 : 0;
    n.accepted += allowed.hazards.reasons.at(cell) == kHazardNone ? 1 : 0;
  });
  return n;
}

bool IsTop(const PlacedShape& shape) {
  return shape.name == "table" || shape.name == "roof" || shape.name == "platform";
}

/// Slope of the least-squares plane through the ground as measured well inside a ramp, radians: not
/// through its top, which has what may stand there.
double MeasuredRampSlope(const Judged& judged, const PlacedShape& ramp) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  ForCells(judged.map.geometry, [&](Cell cell) {
    const double n = judged.north(cell.row), e = judged.east(cell.col);
    if (judged.map.state.at(cell) == CellState::kMeasured &&
        DepthInShape(judged.field, ramp, n, e) >= judged.map.geometry.cell_m) {
      const Eigen::Vector3d basis(1, n, e);
      normal += basis * basis.transpose();
      right += static_cast<double>(judged.map.Measured().at(cell)) * basis;
    }
  });
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  return std::atan(plane.tail<2>().norm());
}

/// The best site, and the last shape that the lander's circle there holds part of; a raised top
/// with room for the whole circle holds it.
void AddSite(const Judged& judged, RowWriter& rows) {
  const SiteSelection& selection = judged.decision->selection;
  RowWriter::Counts n;
  std::string held = "-";
  if (!selection.sites.empty()) {
    const Eigen::Vector3d& p_WS = selection.sites.front().p_WS;
    const double radius_m = judged.settings.lander.radius_m();
    n.tested = 1;
    for (const PlacedShape& shape : judged.field.shapes) {
      if (IsTop(shape) && DepthInShape(judged.field, shape, p_WS.x(), p_WS.y()) > radius_m) {
        n.elevated = 1;
      } else if (DistanceToShape(judged.field, shape, p_WS.x(), p_WS.y()) < radius_m) {
        n.found = 1;
        held = shape.name;
      }
    }
  }
  rows.Add(kChosenSite, judged.settings.limits.max_deviation_m, n, NAN, held);
}

/// The map that SLAD holds, judged under every limit.
void AddRows(const ShapeField& field, const HoverView& view, Slad& slad, Settings settings,
             RowWriter& rows) {
  for (const double limit_m : kLimits_m) {
    settings.slad.limits.max_deviation_m = limit_m;
    settings.slad.limits.max_step_m = kStepPerDeviation * limit_m;
    const Judged judged(field, view, slad.Decide(settings, Letters::kOfCopy));
    if (limit_m == kShapesLimit_m) {
      AddSite(judged, rows);
    }
    if (field.kind == ShapeFieldKind::kSlope) {
      AddFootprints(judged, limit_m, rows);
    }
    rows.Add(kClearCells, limit_m, CountClearCells(judged));
    Settings allowing = settings;
    allowing.slad.limits.elevated = ElevatedSurface::kAllow;
    const Judged allowed(field, view, slad.Decide(allowing, Letters::kOfCopy));
    for (const PlacedShape& shape : field.shapes) {
      if (IsTop(shape)) {
        rows.Add(shape.name, limit_m, CountTop(judged, allowed, shape));
      } else if (shape.slope_rad > 0) {
        if (limit_m == kShapesLimit_m) {
          rows.Add(shape.name, limit_m, {1, 0},
                   Deg(MeasuredRampSlope(judged, shape) - shape.slope_rad));
        }
      } else {
        rows.Add(shape.name, limit_m, {1, IsDetected(allowed, shape) ? 1 : 0});
      }
    }
    if (field.kind == ShapeFieldKind::kPlatform && limit_m == kShapesLimit_m) {
      AddSite(allowed, rows);
    }
  }
}

Result<std::vector<TrialRow>> RunField(const ShapesOptions& options, const Settings& settings,
                                       int trial, std::uint64_t seed) {
  HoverView view;
  view.height_m = options.height_ft * kMetresPerFoot;
  view.field_of_view_rad = Rad(options.field.field_of_view_deg);
  const int turn = trial / static_cast<int>(kKinds.size());
  ShapeFieldKind kind = kKinds[static_cast<std::size_t>(trial) % kKinds.size()];
  if (kind == ShapeFieldKind::kHouse && turn % 2 == 1) {
    kind = ShapeFieldKind::kPlatform;
  }
  const ShapeField field = MakeShapeField(kind, view, trial, seed);
  view.frames = kFrames.back();
  const Result<std::vector<FieldFrame>> frames =
      LookAtField(field.world, view, settings.stereo, seed);
  if (!frames) {
    return frames.error();
  }
  std::vector<TrialRow> rows;
  for (const int count : kFrames) {
    Slad slad = MapOfField(*frames, settings.slad, count);
    RowWriter writer(field, count, rows);
    AddRows(field, view, slad, settings, writer);
  }
  return rows;
}

}  // namespace

Experiment SiteShapesExperiment() {
  auto options = std::make_shared<ShapesOptions>();
  Experiment experiment;
  experiment.name = "site-shapes";
  experiment.purpose = "Small objects, tables, roofs and slopes: what is seen, what is refused";
  experiment.default_trials = 40;
  experiment.columns = Columns();
  experiment.add_options = [options](CLI::App& app) {
    app.add_option("--height-ft", options->height_ft, "Camera above the ground, feet")
        ->check(FiniteRange(5.0, 500.0))
        ->capture_default_str();
    AddFieldOptions(app, options->field);
  };
  experiment.setup = [options] {
    std::string text = "height " + CsvNumber(options->height_ft) + " ft; field of view " +
                       CsvNumber(options->field.field_of_view_deg) + " deg; settings";
    for (const std::string& setting : options->field.set) {
      text += " " + setting;
    }
    return options->field.set.empty() ? text + " default" : text;
  };
  experiment.run = [options](int trial, std::uint64_t seed) -> Result<std::vector<TrialRow>> {
    const Result<Settings> settings = SettingsOf(options->field);
    return settings ? RunField(*options, *settings, trial, seed) : settings.error();
  };
  experiment.report = ReportSiteShapes;
  return experiment;
}

}  // namespace palace
