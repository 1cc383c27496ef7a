// Bumps of the ground around each cell, told from the noise that they are measured with. Internal
// to the SLAD room.
#pragma once

#include "engine/model/grid.h"

namespace palace {

/// Standard deviation b, in metres, of what places stand off their surroundings by beyond their
/// noise, for normal bumps and noise of sigma s: the root of
///
///   quartile of |off_m| / sqrt(s^2 + b^2) = 0.3186
///
/// over a square block and the eight around; 0 where without bumps the quotient is larger by no
/// more than two sigmas of what chance makes it. A block is 1.5 m wide and at least 10 cells.
/// Unknown places are NaN; where less than a quarter is known, 0. The lower quartile (after Hampel
/// 1974, who takes the median) stands half of the ground full of things, and of what their flanks
/// do to their surroundings.
class GroundBumps {
 public:
  /// Both of one size. `width`: cells that share what was looked at, each way: a place as far away
  /// is a figure by itself.
  GroundBumps(const GridF& off_m, const GridF& sigma_m, double cell_m, int width);

  /// b; `row` and `col` lie in the grid.
  double At(int row, int col) const;

 private:
  int block_;      ///< cells along a side
  GridF bumps_m_;  ///< a block each
};

}  // namespace palace
