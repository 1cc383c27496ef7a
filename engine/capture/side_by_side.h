// One picture that holds both of a pair.
#pragma once

#include <utility>

#include "engine/model/image.h"

namespace palace {

/// The left and the right half, pixel columns 0 .. w/2-1 and w/2 .. w-1. The width is even.
std::pair<ImageU8, ImageU8> SplitSideBySide(const ImageU8& both);

}  // namespace palace
