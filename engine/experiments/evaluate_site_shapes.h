// palacectl evaluate site-shapes: which objects are seen as hazards, which ground is refused, and
// how exactly slopes are measured, from one height over fields of known shapes.
#pragma once

#include "engine/experiments/experiment.h"

namespace palace {

/// One trial is one field (shape_field.h), the kinds in turn: objects, objects, slope, structures.
/// Ten rendered pairs from a hover at nadir, fused as in flight; beside it the first frame alone.
///
/// Each map is judged under a row of limits on roughness L, with the step limit 1.5 L:
///   detected     a hazard that is known (not merely unknown) in a cell whose centre lies within
///                one cell of the object's outline
///   false alarm  share of truly clear footprints refused: circles of the clear radius on an even
///                slope, at least 3 degrees below the limit, that hold no object and are seen whole
/// Options: --height-ft, --fov-deg, --set. Passes on what the report lists under "Must show".
Experiment SiteShapesExperiment();

/// How the table of all trials is read (site_shapes_report.cpp).
ExperimentReport ReportSiteShapes(const TrialTable& table);

/// Limit on roughness that the report speaks of: in the middle of those (6 to 8 cm, 320 trials)
/// that find every wanted shape and refuse fewer than 1 % of the clear footprints.
inline constexpr double kShapesLimit_m = 0.07;

// Names of rows that are no shape.
inline constexpr const char* kClearFootprints = "clear footprints";
/// Refused ones of them, by the first of these found inside the circle.
inline constexpr const char* kRefusedByHeight = "refused by height";
inline constexpr const char* kRefusedByFlags = "refused by flags";
inline constexpr const char* kRefusedByUnknown = "refused by unknown";
inline constexpr const char* kRefusedByOdds = "refused by probability";
inline constexpr const char* kClearCells = "clear cells";
inline constexpr const char* kGroundSlope = "ground slope";
inline constexpr const char* kChosenSite = "chosen site";

}  // namespace palace
