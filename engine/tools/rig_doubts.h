// What a pair's own measurements say against the numbers of its RIG.toml: a length in millimetres,
// a height with a digit too many. Such maps look right and are wrong in scale or place.
#pragma once

#include <string>

#include "engine/model/range_map.h"
#include "engine/model/rig.h"

namespace palace {

/// Of pinholes that RIG.toml writes out: a field of view that no such lens has, with fx and width.
/// Empty: none.
std::string DoubtOfFocalLength(const StereoRig& rig);

/// Where the ground is expected near down = 0: it was measured more than half as far again, or less
/// than two thirds as far, below the camera as its pose says, by the median of all ranges. Empty:
/// it was not, the camera looks near the horizon, or nothing was measured.
std::string DoubtOfHeight(const RangeMap& range);

}  // namespace palace
