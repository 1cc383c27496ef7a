// How far a square of places stands off the ground around it. Internal to the SLAD room.
//
// The ground around is the plane through a frame of places. With own figures A, G and those of the
// frame A', G', and q the squared distance between its middle and the square's in its own spread
// (fine_sums.h),
//
//   p = h - plane,   sigma_p^2 = G / A^2 + (1 + q) G' / A'^2
//
// A roof, a wall or a rock on one side lifts that plane, and level ground beside it looks like a
// hole. So a square that seems to stand out is asked again. Its frame is sixteen blocks, two deep
// on each side of the square and one as wide as it. Where one of them stands off their plane by as
// many sigmas as a thing does, the ground is that of the whole frame and of the four that end at
// one side of the square whose blocks lie nearest to their own plane (least mean square, weighted
// by A, over the degrees of freedom). What stands in the square stands off that one as well.
#pragma once

#include "engine/slad/terrain/fine_sums.h"

namespace palace {

/// A square of `side` places about a place (FineSums::Over); its frame begins one square beyond it
/// and ends `ring_to` squares beyond.
struct SquareAndFrame {
  int row = 0, col = 0;
  int side = 1;
  int ring_to = 2;
};

/// What a square shows; heights in metres, above the sums' reference.
struct ShownBySquare {
  bool told = false;      ///< enough is known of both
  double off_m = 0;       ///< p
  double sigma_m = 0;     ///< sigma_p
  double level_m = 0;     ///< of the ground around
  double off_laid_m = 0;  ///< of the height, off the ground that the square's pixels were laid on
};

/// Off the whole frame.
ShownBySquare OffFrame(const FineSums& sums, const SquareAndFrame& at);
/// Off the best of the whole frame and those that are cut; not told only where OffFrame is not.
/// `bumps_m`: of the ground, one sigma.
ShownBySquare OffGroundAround(const FineSums& sums, const SquareAndFrame& at, double bumps_m);

}  // namespace palace
