// Roughness of the ground around each cell. Internal to the SLAD room.
#pragma once

#include "engine/model/grid.h"

namespace palace {

/// Scale of what cells stand off their surroundings by, as the standard deviation of a normal
/// distribution, in metres:
///
///   1.4826 median(median |stands_m|)   (Hampel 1974)
///
/// the inner median over a block of 10 x 10 cells, the outer over it and the eight blocks around.
/// Things on less than half of that ground do not count. Unknown cells are NaN; blocks of which
/// less than a quarter is known are left out; without a block, 0.
class GroundRoughness {
 public:
  explicit GroundRoughness(const GridF& stands_m);

  double At(int row, int col) const;

 private:
  GridF scales_m_;  ///< a block each
};

}  // namespace palace
