// Stereo: from a rectified pair to a range map with a standard deviation for every pixel.
#pragma once

#include <memory>

#include "engine/camera/rectification.h"
#include "engine/core/frames.h"
#include "engine/core/result.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Whole-pixel disparities searched: min_px .. min_px + count - 1. count is a multiple of 16.
struct DisparityWindow {
  int min_px = 0;
  int count = 64;
  friend bool operator==(const DisparityWindow&, const DisparityWindow&) = default;
};

/// Objects up to this height stand on the ground that a predicted window must hold.
inline constexpr double kTallestObject_m = 3;

/// The window that holds level ground at `ground_height_m` (metres above the origin of W,
/// up-positive) and objects up to `tallest_m` on it, seen by the left camera at X_WC:
/// d = fx b / Z with Z where the rays of the picture's border meet the ground. Rays at or above the
/// horizon put the far end at disparity 0. At least settings.num_disparities wide, at most 256;
/// where more would be needed the far end is given up, the ground nearest to the camera is kept.
DisparityWindow PredictWindow(const PinholeCamera& camera, double baseline_m,
                              const RigidTransform& X_WC, double ground_height_m, double tallest_m,
                              const StereoSettings& settings);

struct StereoResult {
  RangeMap range;
  StereoQuality quality;
};

/// Matches rectified pairs. Whole pixels by semi-global matching (semi_global.h; Hirschmueller
/// 2008), the fraction by correlation refinement (subpixel.h). Same input, same bits, for any
/// number of OpenCV threads and with or without AVX2. left_frozen and right_frozen are not filled:
/// they need the pairs before, see frozen_check.h.
class StereoMatcher {
 public:
  /// The range map has no pose: who knows it adds it. Pixels without texture, without a unique
  /// match, hidden from one camera, outside the window or with a sigma over settings.max_sigma_px
  /// are NaN in all layers. Refuses pictures whose sizes differ from the camera's, a baseline that
  /// is not positive, and impossible windows. `filtered`: pictures for the whole-pixel stage, from
  /// FilterThenRectify; null: the prefilter of the settings is applied here.
  Result<StereoResult> Match(const ImageU8& left, const ImageU8& right, const PinholeCamera& camera,
                             double baseline_m, const DisparityWindow& window,
                             const StereoSettings& settings, Timestamp time,
                             const RectifiedPair* filtered = nullptr);
};

}  // namespace palace
