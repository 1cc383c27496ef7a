// Thin structures above the ground, seen in a stereo pair: wires, ropes, poles, masts.
//
// The right picture is laid over the left one with the ground's disparity (scene_ground.h). Ground
// cancels, with everything painted on it; a line above it stays. Differences beyond the local mean
// are marked, straight lines with many marks are found in strips of 32 pixels (line_sums.h), and
// each piece is matched by itself: its own pixels must be found again at one nearer disparity,
// clearly better than on the ground and than at other disparities. Three pieces in a row, which may
// bend a little, are a thin structure.
//
// Lines within 30 degrees of the baseline hardly move along it: along_baseline.h finds them.
#pragma once

#include <vector>

#include "engine/slad/pictures/older_views.h"
#include "engine/slad/pictures/scene_ground.h"
#include "engine/slad/pictures/thin_piece.h"

namespace palace {

/// Whether most of the ground is no nearer than kNearestThin_m: else what was found from farther
/// away stands (flag_memory.h).
bool CanTellThinStructures(const SceneView& view, const SceneGround& ground);

/// Nothing without a ground or where they cannot be told. Pieces in a fixed order.
std::vector<ThinPiece> FindThinStructures(const SceneView& view, const SceneGround& ground,
                                          const OlderViews& older);

}  // namespace palace
