// Hazard evaluation: elevation map in, every hazard layer out (thesis 4.3.2, 4.3.3).
//
// Thesis mode: slope = acos(n . u) (erratum E21), roughness = |height - plane| (E22) of the 3x3
// LMedS plane, product cost (4.6-4.10). Filled and border cells count as data.
//
// Modern mode keeps two notions apart. A CELL is a hazard (`reasons`) for what is wrong at that
// cell: the ground plane around it is too steep, the cell stands off that plane, it makes a step,
// it is unknown, or has a flag that forbids it; so is a mark that rather is a thing than none
// (hidden_things.h). The layers slope, roughness, step, cost and safe_probability speak of the
// lander's FOOTPRINT centred on the cell.
// Heights count only beyond their noise: a deviation r with sigma s has the value sqrt(max(0, r^2 -
// 16 s^2)).
//
// safe_probability is that of a touchdown of the lander's gear (touchdown.h) at its worst heading:
// the ground plane's slope and the gear's tilt within the slope limit, deviation and step within
// theirs, the ground below the belly. The product of the Gaussian tails of these five is a score,
// and P is the share of simulated touchdowns of that score that were safe
// (touchdown_calibration.h, `palacectl evaluate probability`). 0 where the gear would reach unknown
// ground. Anchor: Ivanov, Huertas & Carson 2013; there one sigma holds for all cells and pads are
// put on the noisy heights themselves.
// safe_distance is exact Euclidean from the cell's centre to the nearest point of a hazard's square
// (thesis mode: to its centre); outside the map counts as unknown.
#pragma once

#include "engine/model/elevation_map.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/settings/settings.h"
#include "engine/slad/hazards/terrain_figures.h"

namespace palace {

/// TerrainFlag bits that make a cell a hazard. Shadow alone does not: what little is seen there has
/// its larger sigma. Nor does a mark that is flagged once the cells are judged (kFlagUnexplained).
unsigned ForbiddenFlags(const HazardLimits& limits);

/// Works on any size of map, also empty or all unknown: then nothing is safe.
/// rejected and safe_cells together count every cell once; safe_cells could bear the lander.
/// Rows are shared among OpenCV's threads; their number changes no bit.
HazardMaps EvaluateHazards(const ElevationMap& map, const SladSettings& settings);

/// The same from figures measured before: what a moved limit needs. The figures must HoldFor the
/// settings.
HazardMaps JudgeTerrain(const GridGeometry& geometry, const TerrainFigures& figures,
                        const SladSettings& settings);

}  // namespace palace
