// SiteView: one picture of the ground at the site, and what is known of it beforehand.
#pragma once

#include "engine/core/frames.h"
#include "engine/core/time.h"
#include "engine/model/image.h"
#include "engine/model/range_map.h"
#include "engine/model/rig.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Refers to what its maker holds for as long as a tracker looks at it.
struct SiteView {
  const ImageU8& left;                   ///< rectified
  const PinholeCamera& camera;           ///< of the size of the picture
  const RigidTransform& X_WC_predicted;  ///< of the left camera at exposure
  const RangeMap* range;                 ///< of this picture; null where none was made
  const TrackingSettings& settings;
  Timestamp time;
};

}  // namespace palace
