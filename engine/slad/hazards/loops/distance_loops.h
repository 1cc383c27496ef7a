// Distance to the nearest hazard: along the columns, then of the rows above and below, along one
// row. Included by slad_loops_table.h only.
#pragma once

#include "engine/core/lanes/float_lanes.h"
#include "engine/slad/hazards/loops/slad_loops.h"

namespace palace {
namespace {

void ColumnGapsRow(const unsigned char* hazard, const float* near, int count,
                   float* __restrict__ gap) {
  for (int c = 0; c < count; ++c) {
    const float next = near[c] + 1;
    const float least = gap[c] < next ? gap[c] : next;
    gap[c] = hazard[c] == 0 ? least : 0.0F;
  }
}

void SquareGapsRow(const float* gap, float inset, int count, float* __restrict__ square) {
  for (int c = 0; c < count; ++c) {
    const float along = gap[c] > inset ? gap[c] - inset : 0.0F;
    square[c] = along * along;
  }
}

bool NearestInRow(const float* square, float inset, int count, double cell_m, float* distance_m) {
  constexpr int kCount = FloatLanes::kCount;
  constexpr float kFarthest = static_cast<float>(kNearestReach);
  const FloatLanes most = Fill((kFarthest - inset) * (kFarthest - inset));
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
    if (Any(Less(most, best))) {
      return false;
    }
    float squares[kCount];
    Store(squares, best);
    for (int k = 0; k < kCount && c + k < count; ++k) {
      distance_m[c + k] = squares[k];
    }
  }
  for (int c = 0; c < count; ++c) {
    distance_m[c] = static_cast<float>(cell_m * __builtin_sqrt(static_cast<double>(distance_m[c])));
  }
  return true;
}

}  // namespace
}  // namespace palace
