// Pieces shared inside the SLAD room.
#pragma once

#include "engine/model/elevation_map.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/settings/settings.h"
#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/hazards/terrain_figures.h"

namespace palace {

/// A lander smaller than its cells is looked at over a disc of at least this radius.
inline constexpr double kLeastDisc_cells = 1.5;

/// Fills the layers of modern mode.
void MeasureModern(const ElevationMap& map, const Lander& lander, TerrainFigures& figures);

/// The limits as the loops take them. Relief finer than cells is no more presumed where it was
/// measured: what that leaves open is counted (hidden_things.h).
ModernLimits LimitsOf(const SladSettings& settings, bool finer_measured);

}  // namespace palace
