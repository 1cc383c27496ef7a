// The ground all SLAD benchmarks look at, ours and the peers'.
#pragma once

#include "tests/slad/worlds.h"

namespace palace::testing {

/// Gentle slope of 2 cm noise with boxes of 0.15 to 0.8 m on it, one for each 600 cells.
inline ElevationMap BoxField(int side) {
  constexpr double kCell_m = 0.15;
  ElevationMap map = MakeMap(side, side, kCell_m, Slope(0.05, 1), /*sigma_m=*/0.02);
  RandomStream random(3, "boxes");
  for (int boxes = side * side / 600; boxes > 0; --boxes) {
    const int size = 1 + random.Index(5);
    const float height_m = static_cast<float>(random.Uniform(0.15, 0.8));
    const Cell corner{random.Index(side), random.Index(side)};
    for (int k = 0; k < size * size; ++k) {
      const Cell cell{corner.row + k / size, corner.col + k % size};
      if (map.geometry.Contains(cell)) {
        map.height_m.at(cell) += height_m;
      }
    }
  }
  return map;
}

}  // namespace palace::testing
