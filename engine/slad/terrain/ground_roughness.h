// Roughness of the ground around each cell. Internal to the SLAD room.
#pragma once

#include "engine/model/grid.h"

namespace palace {

/// Scale of what cells stand off their surroundings by, as the standard deviation of a normal
/// distribution about zero, in metres (Hampel 1974, median absolute deviation):
///
///   1.4826 median(median |prominence_m|)
///
/// the inner median over a square block, the outer over it and the eight blocks around. A block is
/// 1.5 m wide and at least 10 cells. Unknown cells are NaN; blocks of which less than a quarter is
/// known are left out; without a block, 0. A few things do not move the scale; things on a third of
/// the ground raise it by 1.7.
class GroundRoughness {
 public:
  GroundRoughness(const GridF& prominence_m, double cell_m);

  /// `row` and `col` lie in the grid.
  double At(int row, int col) const;

 private:
  int block_;       ///< cells along a side
  GridF scales_m_;  ///< a block each
};

}  // namespace palace
