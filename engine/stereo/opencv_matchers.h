// OpenCV's block and semi-global matchers: the peers that ours is measured beside, and a choice in
// the settings (stereo.method = sgbm).
#pragma once

#include "engine/model/image.h"
#include "engine/stereo/stereo.h"

namespace palace {

enum class OpenCvMatcher { kBm, kSgbm, kSgbm3Way, kSgbmHh, kSgbmHh4 };

/// "SGBM 3WAY", as tables and plots show it.
const char* NameOf(OpenCvMatcher matcher);

/// Disparity of the left picture, NaN unknown, with the matcher's own fraction of a pixel
/// (sixteenths). Block settings.block_size_px, P1 = 8 n^2, P2 = 32 n^2, the settings' uniqueness
/// and left-right limits, speckles below 100 px removed; BM: 15 px window, 31 px Sobel prefilter.
///
/// The left picture is cut at column window.min_px and the right one at its right end, so a far
/// window start costs nothing; the columns OpenCV would drop are kept by padding. Same size
/// pictures; window.min_px + 16 <= width, and no smaller than the window for BM.
ImageF MatchWithOpenCv(OpenCvMatcher matcher, const ImageU8& left, const ImageU8& right,
                       const DisparityWindow& window, const StereoSettings& settings);

}  // namespace palace
