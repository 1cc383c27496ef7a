// Prefilters of the thesis (4.2): pictures made ready for matching.
#pragma once

#include <optional>

#include "engine/camera/rectification.h"
#include "engine/model/image.h"
#include "engine/model/settings/settings.h"

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

/// Raw pictures filtered first and rectified then, as in the thesis (4.2; E25: filtering before
/// resampling is not the same as after). Nothing unless the settings ask for it, and nothing when
/// the pictures do not fit the rig: `Rectify` says so for the pair itself.
std::optional<RectifiedPair> FilterThenRectify(const StereoFrame& raw,
                                               const StereoRectifier& rectifier,
                                               const StereoSettings& settings);

}  // namespace palace
