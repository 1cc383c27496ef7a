// What frames repeat of their errors, measured by asking what can have no answer. Internal to the
// SLAD room.
//
// Sensor noise is new in every frame; what sampling makes of a texture is not, as long as a place
// falls alike between the pixels of both pictures. In a still view it repeats in all frames, a
// drift of half a pixel undoes it, and no model says how much of it a texture has. So it is
// measured: a height answers to the gradients g of its own pixels, noise to any. With the gradients
// c of pixels 8 rows off, the residuals e of a place are asked as they are for its height
// (fine_relief.h; sums over its pixels and all frames, w = 1 / (k s)^2):
//
//   R = -sum e g k w,  answer = -sum e c k w - (C / A) R,  C = sum g c w
//   variance of the answer = sum c^2 w - 2 C^2 / A + (C / A)^2 G
//
// (C / A) R takes out what the height itself answers where both gradients are alike. If all noise
// is new, answer^2 / variance is 1 in the mean; so its mean over the places around is how many
// times larger the variance of such sums really is. It is read from the median, 0.4549 for a
// squared normal, for over things the residuals answer too: a height is no constant over a place.
// To it comes what it may be too small by chance, three sigmas; less than 1 is taken as 1.
//
// Measured on level ground of six textures by two renderers, 10 to 50 frames, still and moving: the
// true variance is 0.8 to 13 times the stated one, and the median says 1.0 to 16. In a recorded
// hover p / sigma (narrow_things.h, of the pictures alone) was normal with two sigmas: 0.66 in the
// middle of its size, 2.6 at one in a hundred, 3.3 at one in a thousand, of 28,000 at most 4.3.
#pragma once

#include <array>

#include "engine/model/grid.h"
#include "engine/slad/terrain/fine_sums.h"

namespace palace {

/// What pixels tell of a place: A, G, J of fine_relief.h, and what is asked beside.
struct FinePlace {
  enum {
    kNet,         ///< A, 1/m^2
    kGross,       ///< G, 1/m^2
    kHeight,      ///< J, 1/m
    kOff,         ///< R, 1/m
    kOtherGross,  ///< sum c^2 w, 1/m^2
    kOther,       ///< -sum e c k w, 1/m
    kShared,      ///< C, 1/m^2
    kEnergy,      ///< sum e^2 / (s^2 + q), q of unexplained.h
    kSampled,     ///< sum q / (s^2 + q)
    kPixels,
    kCount
  };
  std::array<float, kCount> of{};
};

/// How many times the stated variance the places' is: at least 1. By blocks of 16 x 16 places of
/// which 64 answer, bilinear between them; other blocks take the middle of the known ones, 1 where
/// there is none.
GridF VarianceTimes(const Grid<FinePlace>& places);

/// The places' heights with the variance that they really have.
Grid<FineKnown> WithRepeatedNoise(const Grid<FinePlace>& places);

}  // namespace palace
