#include "engine/slad/hazards/terrain_figures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/slad/hazards/hazard_layers.h"
#include "engine/slad/hazards/plane_fit.h"
#include "engine/slad/terrain/raised_surface.h"
#include "engine/slad/terrain/sense_check.h"

namespace palace {
namespace {

void MeasureThesis(const ElevationMap& map, const Lander& lander, TerrainFigures& figures) {
  const double cell_m = map.geometry.cell_m;
  // Samples a rock's size apart: a rock then spoils few of the nine and LMedS rejects it.
  const int stride = std::clamp(static_cast<int>(lander.max_rock_size_m / cell_m), 1,
                                std::max(1, std::min(map.geometry.rows, map.geometry.cols) / 3));
  PlaneMaps planes = FitThesisPlanes(map.height_m, cell_m, stride);
  for (float& deviation : planes.residual_m.cells()) {
    deviation = std::abs(deviation);  // erratum E22: pits count as rocks do
  }
  figures.deviation_m = std::move(planes.residual_m);
  figures.north_gradient = std::move(planes.north_gradient);
  figures.east_gradient = std::move(planes.east_gradient);
}

/// Flags of the map, and kFlagElevated.
Grid<std::uint8_t> FlagsOf(const ElevationMap& map) {
  Grid<std::uint8_t> flags = FindRaisedSurfaces(map);
  for (std::size_t i = 0; i < map.flags.cells().size(); ++i) {
    flags.cells()[i] |= map.flags.cells()[i];
  }
  return flags;
}

}  // namespace

bool TerrainFigures::HoldFor(const SladSettings& settings) const {
  const Lander& asked = settings.lander;
  const auto same = [](double a, double b) { return a == b || (a != a && b != b); };
  return mode == settings.mode && same(lander.max_rock_size_m, asked.max_rock_size_m) &&
         (mode == SladMode::kThesis ||
          (same(lander.base_size_m, asked.base_size_m) && lander.gear == asked.gear &&
           same(lander.gear_length_m, asked.gear_length_m) &&
           same(lander.gear_width_m, asked.gear_width_m) &&
           // The gear's worst heading depends on the up vector.
           same(lander.up_tilt_deg, asked.up_tilt_deg) &&
           same(lander.up_azimuth_deg, asked.up_azimuth_deg)));
}

TerrainFigures MeasureTerrain(const ElevationMap& map, const SladSettings& settings) {
  TerrainFigures figures;
  figures.mode = settings.mode;
  figures.lander = settings.lander;
  if (map.height_m.empty()) {
    return figures;
  }
  PALACE_CHECK(LayersFit(map) && map.geometry.cell_m > 0, map.height_m.rows(), map.geometry.rows,
               map.geometry.cell_m);
  const Lander lander = WithinReason(settings.lander, map.geometry);
  if (settings.mode == SladMode::kThesis) {
    MeasureThesis(map, lander, figures);
  } else {
    figures.flags = FlagsOf(map);
    figures.narrow = map.narrow;
    MeasureModern(map, lander, figures);
  }
  return figures;
}

}  // namespace palace
