// Ground whose texture is too faint for the full picture, measured in the picture at half the size.
//
// A pixel of the half picture is the mean of four: white noise has half its deviation there, and a
// window of as many pixels sees four times the ground. Snow, roofs, dry sand and mud, whose fine
// texture drowns in the noise, show a coarser one. Most pixels that the full picture refuses are of
// another kind, though: hidden from one camera, beside an edge, of a pattern that repeats. There
// the half picture would be as wrong, so only what was refused for faintness is filled:
//
//   1.25 n^2 <= var L <= 4 n^2   over 9x9 pixels;   n: noise of one picture, grey levels, sigma
//   n = 1.4826 / 2 median |e(x) - e(x+1)|,   e(x) = L(x) - R(x - d)
//
// with e taken where the measured d is within 0.1 px of a whole number, so that nothing is
// interpolated; the difference of neighbours takes out what the two cameras see unequally bright.
// Below the lower bound the picture shows noise alone, as still water does: what a window of twice
// the width finds there is the rim of the pool, and stays out.
//
// Where so little is seen, noise alone matches now and then. What strays from the mean of its
// window by more than 1.5 sigma is such a chance match, or an edge has come near its window: it is
// unknown, in the half picture, and in the full one at pixels as faint. What is filled follows the
// ground over windows twice as wide: its sigma says how well the mean of such a window is known,
// not what is smaller than it.
//
// Chosen on drawn pairs of twelve kinds of ground (2026-11-26): below 4 n^2 fewer than 1 % of the
// filled pixels are wrong by more than 2 px and errors are 1.1 to 1.5 sigma; above it, where it is
// occlusion that is refused, 10 to 30 %.
#pragma once

#include <cstdint>

#include "engine/model/image.h"
#include "engine/stereo/subpixel.h"

namespace palace {

/// What a pixel of the left picture that both cameras see shows of texture.
enum FaintPixel : std::uint8_t {
  kClear = 0,  ///< enough for the full picture; or the right camera does not look there
  kNoiseAlone = 1,
  kFaint = 2,
};

/// A FaintPixel a pixel. Empty where too few faint ones are unknown for a second pass to be worth
/// its time (1 in 50), or too few are known to tell the noise (200).
ImageU8 FindFaintGround(const ImageU8& left, const ImageU8& right, const ImageF& disparity_px);

/// Fills unknown kFaint pixels from what was measured in the pictures at half the size
/// (half_size.h): disparity and sigma doubled, between the middles of its pixels by bilinear
/// weights over those that are known and within 1 px of the nearest. Nothing is filled where that
/// one is unknown or the doubled sigma exceeds `max_sigma_px`. Then drops chance matches among all
/// that are not clear.
void FillFaintGround(const ImageU8& faint, SubpixelDisparity half, double max_sigma_px,
                     SubpixelDisparity& filled);

}  // namespace palace
