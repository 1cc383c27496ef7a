// From one exposure of a rig to its range map: the order of calls of stereo, for flight, `analyze`
// and folders of pictures alike.
//
//   window: the rig's own; else by pose and ground; without a pose from infinity on
//   FilterThenRectify (where the settings ask for it) -> StereoMatcher::Match -> pose
//     -> RefuseBeyondRightPicture (where the window was predicted)
#pragma once

#include <optional>

#include "engine/camera/rectification.h"
#include "engine/core/result.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/settings/settings.h"
#include "engine/model/view_pose.h"
#include "engine/stereo/stereo.h"

namespace palace {

/// What is known of an exposure. References must outlive the call.
struct RigExposure {
  const StereoFrame& raw;
  const RectifiedPair& pair;  ///< of `raw`, by `rectifier`
  const StereoRig& rig;
  const StereoRectifier& rectifier;
  std::optional<ViewPose> pose;  ///< of the rectified left camera
  double ground_height_m = 0;    ///< above the origin of W, where a window must be predicted
};

/// The range map carries the pose. Errors are the matcher's refusals.
Result<StereoResult> MeasureRanges(const RigExposure& exposure, const StereoSettings& settings,
                                   StereoMatcher& matcher);

}  // namespace palace
