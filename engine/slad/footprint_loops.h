// Largest deviation from the plane over a disc around each cell. Included by slad_loops.cpp and
// slad_loops_avx2.cpp only.
#pragma once

#include "engine/slad/float_lanes.h"
#include "engine/slad/slad_loops.h"

namespace palace {
namespace {

void DiscDeviationRow(const DiscRows& disc, const float* plane, const float* east,
                      const float* south, int count, float* square) {
  for (int c = 0; c < count; c += FloatLanes::kCount) {
    FloatLanes most = Load(square + c);
    const FloatLanes slope = Load(east + c);
    for (int i = 0; i < disc.rows; ++i) {
      const FloatLanes base =
          Load(plane + c) + Load(south + c) * Fill(static_cast<float>(disc.row_offset[i]));
      for (int dc = -disc.half[i]; dc <= disc.half[i]; dc += disc.stride) {
        const FloatLanes off =
            Load(disc.height[i] + c + dc) - base - slope * Fill(static_cast<float>(dc));
        most = Max(off * off - Load(disc.noise2[i] + c + dc), most);
      }
    }
    Store(square + c, most);
  }
}

void WindowMaximumRow(const float* values, int half, int count, float* work, float* most) {
  // Runs of 2, 4, 8 .. values, then two overlapping runs that fill the window.
  const int width = 2 * half + 1;
  for (int k = 0; k < count + 2 * half; ++k) {
    work[k] = values[k - half];
  }
  int run = 1;
  for (; 2 * run <= width; run *= 2) {
    for (int k = 0; k < count + 2 * half - 2 * run + 1; ++k) {
      work[k] = work[k] > work[k + run] ? work[k] : work[k + run];
    }
  }
  for (int c = 0; c < count; ++c) {
    const float a = work[c], b = work[c + width - run];
    const float larger = a > b ? a : b;
    most[c] = most[c] > larger ? most[c] : larger;
  }
}

}  // namespace
}  // namespace palace
