// Correlation refinement: the fraction of a disparity, and how well it is known.
//
// Around each pixel p a square window of the left picture is compared with the right picture warped
// by the current disparity field. With L the left window, R the warped right window (both without
// their mean), g the horizontal gradient of the left picture and a the gain between them,
//
//   e = L - a R,   delta = -sum(e g) / (G - N),   d <- smooth(d) + delta        (Gauss-Newton)
//
// where G = sum(g g) and N is the share of G that is camera noise (from the residuals).
//
// Each window pixel is warped by its own disparity, so a window follows slopes and steps instead
// of flattening them. R is read between its pixels from a cubic B-spline: a cubic through four
// pixels (Catmull-Rom) shifts fine texture by up to 0.04 px, 1.3 cm of height at 50 ft. The field
// is smoothed between steps over neighbours within 1 px (0.3 px in the last step) of the centre, or
// in balance with the neighbour opposite (steep ground: half a pixel a row at 10 ft and 45
// degrees), which removes what a window sum cannot see: errors finer than the window. The gradient
// is taken in the left picture only: its noise is then uncorrelated with e, so noise does not pull
// towards whole pixels (SGBM's own parabola does: 0.2 px).
//
//   sigma_d^2 = sigma_e^2 G / (G - N)^2 + (0.018 px)^2
//
// with sigma_e from the residuals; the constant is what interpolation and texture leave over
// without noise.
//
// Sources: Lucas & Kanade 1981 in one dimension; Unser, Aldroubi & Eden 1993 (spline); deviations:
// per-pixel warp, gain, smoothing.
#pragma once

#include "engine/model/image.h"
#include "engine/stereo/stereo_loops.h"

namespace palace {

struct SubpixelOptions {
  int window_px = 9;          ///< side of the window, odd
  int iterations = 2;         ///< Gauss-Newton steps
  double max_shift_px = 1;    ///< refuse results further than this from the start
  double max_sigma_px = 0.5;  ///< refuse results known less well than this
};

/// NaN where unknown.
struct SubpixelDisparity {
  ImageF disparity_px;
  ImageF sigma_px;
};

/// `coarse`: whole-pixel or better disparity of the left picture, NaN unknown. All images have the
/// same size, at least 16 columns. Unknown pixels take no part in any window. A window that is less
/// than 40 % known, has no texture, or correlates by less than 0.4 gives an unknown result.
SubpixelDisparity RefineDisparity(const ImageU8& left, const ImageU8& right, const ImageF& coarse,
                                  const SubpixelOptions& options,
                                  const StereoLoops& loops = FastestLoops());

}  // namespace palace
