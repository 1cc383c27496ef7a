// What a lens does to the light of a picture beside projecting it.
#pragma once

#include "engine/model/image.h"

namespace palace {

/// Gaussian blur of that standard deviation; 0 changes nothing.
void Blur(ImageF& grey, double sigma_px);

/// grey * (1 - share * r^2), r = 1 at the corners: cos^4 of the angle off the axis, to its first
/// term. 0 changes nothing.
void Vignette(ImageF& grey, double share);

}  // namespace palace
