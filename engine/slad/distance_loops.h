// Distance to the nearest hazard of the rows above and below, along one row. Included by
// slad_loops.cpp and slad_loops_avx2.cpp only.
#pragma once

#include "engine/slad/float_lanes.h"
#include "engine/slad/slad_loops.h"

namespace palace {
namespace {

void NearestInRow(const float* square, float inset, int count, double cell_m, float* distance_m) {
  constexpr int kCount = FloatLanes::kCount;
  for (int c = 0; c < count; c += kCount) {
    FloatLanes best = Load(square + c);
    for (int d = 1; d <= kNearestReach; ++d) {
      const float aside = static_cast<float>(d) - inset;
      const FloatLanes aside2 = Fill(aside * aside);
      if (!Any(Less(aside2, best))) {
        break;
      }
      best = Min(best, Min(Load(square + c + d), Load(square + c - d)) + aside2);
    }
    float squares[kCount];
    Store(squares, best);
    for (int k = 0; k < kCount && c + k < count; ++k) {
      distance_m[c + k] =
          static_cast<float>(cell_m * __builtin_sqrt(static_cast<double>(squares[k])));
    }
  }
}

}  // namespace
}  // namespace palace
