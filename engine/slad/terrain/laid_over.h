// The right picture laid over the left one by a smooth ground, and what is left between them.
// Internal to the SLAD room.
//
//   e = L(x, y) - a R(x - d0, y) - b
//
// d0 is the ground's disparity without what is narrow: of each patch of 4 x 4 pixels the plane
// through what stereo measured in the 28 x 28 pixels around, or its own mean where that lies half a
// pixel off the plane, between patches bilinear. R between its pixels is a cubic B-spline. Gain a
// and offset b give both pictures the same mean and contrast over the same windows, and the mean
// square of e there is s^2: noise, and whatever d0 does not explain.
//
// L and R are the pictures smoothed along their rows by (1, 2, 1) / 4. Of their finest detail the
// spline shifts some too little and some too far, the more so the farther d0 lies from whole
// pixels: level ground waved with each pixel of disparity, by 0.02 px in the default scene. What
// lenses leave of it is little, and most of that is aliased.
//
// Sources: Unser, Aldroubi & Eden 1993 (spline); Shimizu & Okutomi 2001 (errors that follow the
// fraction of a pixel).
#pragma once

#include "engine/model/image.h"

namespace palace {

/// Pictures that are less wide or high than this are not looked at.
inline constexpr int kLeastPicture_px = 64;

struct LaidOver {
  static constexpr int kPatch_px = 4;

  ImageF disparity_px;  ///< d0
  ImageF residual;      ///< e, grey
  ImageF noise2;        ///< s^2 of each patch, grey^2
  ImageF known;         ///< 1 where all three are, else 0 (they are 0 then)
  ImageF left;          ///< L
};

/// Pictures and disparities of one size, at least kLeastPicture_px each way; NaN disparities are
/// unknown. Nothing is known of windows of which stereo measured less than 15 %, beyond the right
/// picture, and between patches whose disparities differ by more than a pixel: a depth edge. Rows
/// are shared among OpenCV's threads; their number changes no bit.
LaidOver LayOver(const ImageU8& left, const ImageU8& right, const ImageF& disparity_px);

}  // namespace palace
