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

void MeasureThesis(const ElevationMap& map, const SladSettings& settings, TerrainFigures& figures) {
  const double cell_m = map.geometry.cell_m;
  // Samples a rock's size apart: a rock then spoils few of the nine and LMedS rejects it.
  const int stride = std::clamp(static_cast<int>(settings.max_rock_size_m / cell_m), 1,
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

TerrainFigures MeasureTerrain(const ElevationMap& map, const SladSettings& settings) {
  TerrainFigures figures;
  figures.mode = settings.mode;
  figures.max_rock_size_m = settings.max_rock_size_m;
  figures.lander_base_size_m = settings.lander_base_size_m;
  figures.gear = settings.gear;
  figures.gear_length_m = settings.gear_length_m;
  figures.gear_width_m = settings.gear_width_m;
  figures.up_tilt_deg = settings.up_tilt_deg;
  figures.up_azimuth_deg = settings.up_azimuth_deg;
  if (map.height_m.empty()) {
    return figures;
  }
  PALACE_CHECK(LayersFit(map) && map.geometry.cell_m > 0, map.height_m.rows(), map.geometry.rows,
               map.geometry.cell_m);
  const SladSettings sizes = WithinReason(settings, map.geometry);
  if (settings.mode == SladMode::kThesis) {
    MeasureThesis(map, sizes, figures);
  } else {
    figures.flags = FlagsOf(map);
    MeasureModern(map, sizes, figures);
  }
  return figures;
}

}  // namespace palace
