#include "engine/stereo/range_measurement.h"

#include "engine/stereo/beyond_right_picture.h"
#include "engine/stereo/prefilter.h"
#include "engine/stereo/stereo_quality.h"

namespace palace {
namespace {

/// Whether the window is predicted: the rig has none, and a pose is known. Where nobody knows the
/// ground, its height is that of the origin, for the window as for what is refused.
bool IsPredicted(const RigExposure& exposure) {
  return exposure.pose && exposure.rig.num_disparities <= 0;
}

DisparityWindow WindowOf(const RigExposure& exposure, const StereoSettings& settings) {
  if (exposure.rig.num_disparities > 0) {
    return {exposure.rig.min_disparity_px, exposure.rig.num_disparities};
  }
  if (!IsPredicted(exposure)) {
    return {0, settings.num_disparities};
  }
  return PredictWindow(exposure.rectifier.camera(), exposure.rectifier.baseline_m(),
                       exposure.pose->X_WC, exposure.ground_height_m, kTallestObject_m, settings);
}

}  // namespace

Result<StereoResult> MeasureRanges(const RigExposure& exposure, const StereoSettings& settings,
                                   StereoMatcher& matcher) {
  const StereoRectifier& rectifier = exposure.rectifier;
  const auto filtered = FilterThenRectify(exposure.raw, rectifier, settings);
  Result<StereoResult> result = matcher.Match(
      *exposure.pair.left, *exposure.pair.right, rectifier.camera(), rectifier.baseline_m(),
      WindowOf(exposure, settings), settings, exposure.raw.time, filtered ? &*filtered : nullptr);
  if (!result) {
    return result;
  }
  result->range.pose = exposure.pose;
  if (IsPredicted(exposure)) {
    RefuseBeyondRightPicture(exposure.pose->X_WC, exposure.ground_height_m, result->range);
    SummariseRange(result->range, result->quality);
  }
  return result;
}

}  // namespace palace
