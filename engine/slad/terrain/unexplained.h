// Marks: where two pictures differ by what no height of the ground explains. Internal to the SLAD
// room.
//
// A post seen end-on from above shows the left camera its top on one piece of ground and the right
// one on another. Its disparity is pixels off the ground's: too far for what is linear about the
// ground (fine_relief.h), and the top is too small for stereo's window. But the pictures, laid over
// each other (laid_over.h), do not agree there. Over all pixels of a place and all frames, n in
// number, what is left between them beyond noise and beyond what one height answers for,
//
//   U = (sum e^2 / (s^2 + q) - R^2 / G) / n,   q = 0.2^2 g^2 + 0.12 h^2
//
// is 1 over ground whatever its height, tone or paint. q is what sampling makes of its detail. At
// hard edges e has what g has times by what a place's pixels differ from its one height, and from
// each other, 0.2 px. A speck narrower than a pixel lies in one pixel of one picture and in two of
// the other, and shows as h, half the second difference of L along the row: of a smoothed speck of
// contrast C it is C / 4 in its middle, and e up to some C / 3. By chance U errs by some
// 1 / sqrt(n); by a tenth that frames repeat; and by the share S that q has in the variance, the
// mean of q / (s^2 + q), for what a place's specks show of it is drawn once for all frames:
//
//   v = (U - 1) / sqrt(1 / n + 0.1^2 + S^2)
//
// A top that moved lies over ground of another kind in one of the pictures: e is its whole contrast
// where L has neither g nor h.
//
// Over bare ground without specks (places of six families, from 8 and 13 m, 1 to 10 frames, 4 to
// 400 pixels) the tail of (U - 1) sqrt(n) is one and the same: 3.7 at one in a hundred, 5.8 at one
// in a thousand, 8 at one in ten thousand, so it falls as exp(-v). Under a thing whose top moved by
// more than a pixel or two v is as large as the thing's contrast: over 20 for most posts from 8 to
// 15 m. With as few things as are reckoned with (hidden_things.h) there is one as likely as not at
// v0 = 12:
//
//   chance = 1 / (1 + exp(v0 - v))
//
// What it is nobody knows: a post, a blade, a wire above, water that glints, a leaf that moves. A
// thing must be two pixels of disparity high to leave so much; h2 = 2 k. How many of those reach a
// limit is hidden_things.h's. A look from nearer finds it by stereo, or explains it.
//
// Source: ours.
#pragma once

#include "engine/model/elevation_map.h"
#include "engine/slad/terrain/narrow_things.h"
#include "engine/slad/terrain/repeated_noise.h"

namespace palace {

/// v of each place; NaN where fewer than 8 pixels saw it.
GridF Unexplained(const Grid<FinePlace>& places);

/// Gives the map's narrow figures their marks. `unexplained`: of the map's places. Heights that
/// move by so much are taken along the ray, not along the axis of the camera.
void TakeMarks(const GridF& unexplained, const Viewpoint& view, double focal_times_baseline,
               ElevationMap& map);

}  // namespace palace
