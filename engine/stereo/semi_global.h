// Semi-global matching: the whole-pixel disparity of every pixel.
//
//   C(p,d)   = differing bits of two 24-bit centre-symmetric census codes, 7x7 pixels
//   L_r(p,d) = C(p,d) + min(L_r(q,d), L_r(q,d+-1) + P1, min L_r(q) + P2) - min L_r(q),   q = p - r
//   S(p,d)   = sum of L_r over r = from the left, from the right, from above
//
// Census codes compare pixels of one picture with each other, so brightness, contrast and
// vignetting of the two cameras may differ. C <= 24 and P2 <= 61 keep every S within one byte.
//
// The picture is cut into bands of 120 rows that are matched apart, on OpenCV's threads; the path
// from above starts 24 rows before its band. Bands do not depend on the number of threads.
//
// Sources: Hirschmueller, Stereo processing by semiglobal matching and mutual information, 2008
// (equation 13, paths); Spangenberg, Langner & Rojas, Weighted semi-global matching and
// centre-symmetric census transform, 2013 (cost). Deviations: three paths instead of eight.
#pragma once

#include "engine/model/image.h"
#include "engine/stereo/stereo.h"
#include "engine/stereo/stereo_loops.h"

namespace palace {

struct SemiGlobalOptions {
  int small_jump_cost = 9;         ///< P1, census bits for a step of one disparity
  int large_jump_cost = 30;        ///< P2, for any other; P1 <= P2 <= 61
  double uniqueness_percent = 10;  ///< least margin of the best cost over any not beside it
  double max_left_right_px = 1;    ///< largest disagreement of the two matching directions
};

/// Disparity of the left picture, NaN unknown; the fraction is where two lines of equal and
/// opposite slope through S at the best disparity and its neighbours meet (census costs fall
/// linearly, and a parabola pulls twice as far towards whole pixels). It is only a start for
/// RefineDisparity. Same size pictures, at least 16 x 1; window.count <= 256 and window.min_px + 16
/// < width. Columns left of the window's end are kept.
ImageF MatchSemiGlobal(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                       const SemiGlobalOptions& options, const StereoLoops& loops = FastestLoops());

}  // namespace palace
