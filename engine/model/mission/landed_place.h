// Where the vehicle says that it stands, against the place that was approved.
#pragma once

#include "engine/model/mission/mission_status.h"

namespace palace {

/// At touchdown it was farther from the centre of the approved site, by the estimate, than the
/// clear radius that was asked around it: caught in a wire, on a roof, or on other ground. False
/// where nobody knows.
inline bool MissedSite(const MissionStatus& status) {
  return status.armed && status.touchdown_miss_m &&
         *status.touchdown_miss_m > status.armed->clear_radius_m;
}

}  // namespace palace
