// Left-right check after the refinement: pixels that the right camera cannot see.
#pragma once

#include "engine/model/image.h"

namespace palace {

/// Of all left pixels of a row that land on one column of the right picture, the nearest surface
/// (greatest disparity) is what the right camera sees there. Pixels more than `limit_px` behind it
/// become NaN in both images. The disparities are refined, so the limit may be below a pixel.
void RefuseHidden(double limit_px, ImageF& disparity_px, ImageF& sigma_px);

}  // namespace palace
