// Wires and ropes that run nearly along the baseline.
//
// Moved along itself a line looks the same, so the disparity of such a line is not seen. What is
// seen is its parallax across itself: with the right picture laid over the left one by the ground's
// disparity (scene_ground.h), a line that is `above` pixels of disparity nearer and climbs M rows a
// column lies
//
//   v = M above    rows aside; a line painted on the ground lies at v = 0.
//
// Thin lines of the left picture (line_marks.h, ridges) are chained over strips of 32 columns; the
// grey across a chain is averaged along its whole length in both pictures, where the line of the
// left one must be found again v rows aside and not at 0. Where the vehicle's own motion tells the
// height better (line_parallax.h), it counts. A line of v below one row is not told from paint: one
// that climbs less than a sixteenth (3.7 degrees) and spans most of the picture is taken without
// its height, however faint, for nothing but a line goes on over so many strips; others are not
// found (2 m above ground that is 15 m away: between 4 and 7 degrees, 1 m: to 15).
#pragma once

#include <vector>

#include "engine/slad/pictures/line_sums.h"
#include "engine/slad/pictures/older_views.h"
#include "engine/slad/pictures/scene_ground.h"
#include "engine/slad/pictures/thin_piece.h"

namespace palace {

/// Lines within 30 degrees of the baseline, in a fixed order. `ground` must not be empty.
std::vector<ThinPiece> FindAlongBaseline(const SceneView& view, const SceneGround& ground,
                                         const OlderViews& older, LineSums& lines);

}  // namespace palace
