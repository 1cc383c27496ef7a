// Speckles: small patches of disparity that hang together with nothing around them.
#pragma once

#include "engine/model/image.h"

namespace palace {

/// Makes patches of fewer than `least_area_px` pixels unknown (NaN). Neighbours, left-right and
/// up-down, belong to one patch when both are known and differ by at most `largest_step_px`.
void RemoveSpeckles(ImageF& disparity_px, int least_area_px, float largest_step_px);

}  // namespace palace
