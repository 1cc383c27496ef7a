// A picture at half the size, as stereo and the flags of landing sites see coarser texture.
#pragma once

#include "engine/model/image.h"

namespace palace {

/// Each pixel the mean of four, rounded; a last odd row or column is dropped. At least 2 x 2. Pixel
/// (x, y) of the result has its centre at (2 x + 0.5, 2 y + 0.5).
ImageU8 HalfSize(const ImageU8& picture);

}  // namespace palace
