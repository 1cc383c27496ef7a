// Whole-pixel disparity by semi-global matching, as the settings ask for it.
#pragma once

#include "engine/model/image.h"
#include "engine/model/settings/settings.h"
#include "engine/stereo/stereo.h"

namespace palace {

/// Disparity of the left picture, NaN unknown, right to about a pixel: a start for RefineDisparity,
/// not a measurement. Our matcher (semi_global.h) or OpenCV's three-way SGBM, with uniqueness,
/// left-right and speckle checks, then the decision beside depth edges (depth_edges.h);
/// settings.pyramid_levels times at half the size, then brought back by correlation refinement at
/// each size. A window wider than 256 px is searched at half the size too.
///
/// Pixels on uniform black or white areas (picture borders after rectification, overexposure) are
/// unknown, in either picture. Same size pictures; window.min_px + 16 <= width.
ImageF MatchWholePixels(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                        const StereoSettings& settings);

/// The window that holds the same surfaces in pictures at half the size.
DisparityWindow HalfWindow(const DisparityWindow& window);

}  // namespace palace
