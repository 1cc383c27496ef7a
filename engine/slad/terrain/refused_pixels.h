// Pixels that stereo refused, per cell: what stands too steep or too narrow to be matched leaves a
// gap in the ranges, and what is known around the gap reads too low. Internal to the SLAD room.
#pragma once

#include "engine/model/grid.h"
#include "engine/model/range_map.h"

namespace palace {

/// With fewer pixels the share says nothing: one of six is no sixth.
inline constexpr float kLeastPixels = 12;

/// Pixels of the frames remembered that fall into a cell.
struct PixelCount {
  float known = 0;
  float refused = 0;

  /// 0 with fewer than kLeastPixels.
  double RefusedShare() const {
    return known + refused < kLeastPixels
               ? 0.0
               : static_cast<double>(refused) / static_cast<double>(known + refused);
  }
};

/// Adds the pixels of one range map, which has a pose, to the cells of `geometry`.
/// A refused pixel lies at the depth of the farther of the two known pixels that end its gap in the
/// row: on the ground behind. Gaps that reach the picture's edge count nowhere, for the other
/// camera does not see there. A pixel is known when depth and sigma are.
void CountPixels(const RangeMap& range, const GridGeometry& geometry, Grid<PixelCount>& counts);

}  // namespace palace
