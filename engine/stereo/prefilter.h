// Prefilters of the thesis (4.2): pictures made ready for matching.
#pragma once

#include "engine/model/image.h"
#include "engine/model/settings.h"

namespace palace {

/// The picture as the settings ask for it, for the whole-pixel stage only: filtering correlates the
/// noise of neighbouring pixels, so the fraction and its sigma are always measured in the pictures
/// themselves.
///
///   none       the picture
///   laplacian  128 + 2 * Laplacian of a Gaussian, sigma 1 px, clipped to 0..255: removes slow
///   changes
///              of brightness
///   bilateral  5x5, 30 grey levels, 2 px (Tomasi & Manduchi 1998): removes noise, keeps edges
ImageU8 Prefilter(const ImageU8& picture, StereoPrefilter filter);

/// The picture at half the size, each pixel the mean of four; a last odd row or column is dropped.
/// At least 2 x 2. Pixel (x, y) of the result has its centre at (2 x + 0.5, 2 y + 0.5).
ImageU8 HalfSize(const ImageU8& picture);

}  // namespace palace
