// Whole-pixel disparity by semi-global matching.
#pragma once

#include "engine/model/image.h"
#include "engine/model/settings.h"
#include "engine/stereo/stereo.h"

namespace palace {

/// Disparity of the left picture, NaN unknown. OpenCV's three-way SGBM (Hirschmueller 2008; cost
/// Birchfield & Tomasi 1998) with uniqueness, left-right and speckle checks. Its fraction of a
/// pixel is locked to whole pixels by up to 0.2 px: a start for RefineDisparity, not a measurement.
///
/// The left picture is cut at column window.min_px and the right one at its right end, so a far
/// window start costs nothing; the columns OpenCV would drop are kept by padding. A difference of
/// brightness and contrast between the cameras is taken out first. Pixels on uniform black or white
/// areas (picture borders after rectification, overexposure) are unknown, in either picture.
/// Same size pictures; window.min_px + 16 < width.
ImageF MatchWholePixels(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                        const StereoSettings& settings);

}  // namespace palace
