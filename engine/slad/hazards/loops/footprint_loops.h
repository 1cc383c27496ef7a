// Largest deviation from the plane over a disc around each cell. Included by slad_loops_table.h
// only.
#pragma once

#include "engine/core/lanes/float_lanes.h"
#include "engine/slad/hazards/loops/slad_loops.h"

namespace palace {
namespace {

void DiscDeviationRow(const DiscRows& disc, const float* plane, const float* east,
                      const float* south, int count, float* square, float* denoised_off) {
  const FloatLanes stride = Fill(static_cast<float>(disc.stride));
  for (int c = 0; c < count; c += FloatLanes::kCount) {
    FloatLanes most = Load(square + c), denoised_most = Load(denoised_off + c);
    const FloatLanes slope = Load(east + c);
    for (int i = 0; i < disc.rows; ++i) {
      const FloatLanes base =
          Load(plane + c) + Load(south + c) * Fill(static_cast<float>(disc.row_offset[i]));
      const float* height = disc.height[i] + c;
      const float* noise2 = disc.noise2[i] + c;
      const float* denoised = disc.denoised[i] + c;
      FloatLanes aside = Fill(static_cast<float>(-disc.half[i]));
      for (int dc = -disc.half[i]; dc <= disc.half[i]; dc += disc.stride) {
        const FloatLanes rise = slope * aside;
        const FloatLanes off = SubtractFused(Load(height + dc), base) - rise;
        most = Max(off * off - Load(noise2 + dc), most);
        denoised_most = Max(Abs(SubtractFused(Load(denoised + dc), base) - rise), denoised_most);
        aside = AddFused(aside, stride);
      }
    }
    Store(square + c, most);
    Store(denoised_off + c, denoised_most);
  }
}

/// The cell that stands off the ground makes the step, not its level neighbour: one that stands off
/// by less than this share of what the neighbour does makes none.
constexpr float kMakesStep = 0.9F;

void StepRow(const StepRows& rows, int count, float* most2, float* at_cell2) {
  const FloatLanes none = Fill(-kBeyondHeights), never = Fill(kBeyondHeights);
  for (int c = 0; c < count; c += FloatLanes::kCount) {
    const FloatLanes height = Load(rows.height[1] + c), noise2 = Load(rows.noise2[1] + c);
    const FloatLanes east = Load(rows.east + c), south = Load(rows.south + c);
    const FloatLanes own_off = Abs(height - Load(rows.plane[1] + c));
    FloatLanes most = none, at_cell = none;
    for (int k = 0; k < 9; ++k) {
      if (k == 4) {
        continue;
      }
      const int dr = k / 3 - 1, dc = k % 3 - 1, near = c + dc;
      const FloatLanes near_height = Load(rows.height[1 + dr] + near);
      const FloatLanes near_noise2 = Load(rows.noise2[1 + dr] + near);
      const FloatLanes rise = near_height - height - east * Fill(static_cast<float>(dc)) -
                              south * Fill(static_cast<float>(dr));
      const FloatLanes step2 =
          Select(Less(near_noise2, never), rise * rise - noise2 - near_noise2, none);
      most = Max(step2, most);
      const FloatLanes near_off = Abs(near_height - Load(rows.plane[1 + dr] + near));
      at_cell = Select(Less(own_off, Fill(kMakesStep) * near_off), at_cell, Max(step2, at_cell));
    }
    const LaneMask known = Less(noise2, never);
    Store(most2 + c, Select(known, most, none));
    Store(at_cell2 + c, Select(known, at_cell, none));
  }
}

/// What the square root leaves of `off` beyond noise, with its sign.
inline float BeyondNoise(float off, float noise2) {
  const float square = off * off - noise2;
  const float size = __builtin_sqrtf(square > 0 ? square : 0);
  return off < 0 ? -size : size;
}

void DenoiseRow(const DenoiseRows& rows, int count, float* __restrict__ denoised) {
  // Nine sigmas^2. The mean of nine cells, of which neighbours share their noise, keeps 0.31 of it.
  constexpr float kBroad = 9 * 0.31F, kFine = 9 * 0.69F;
  const float *h0 = rows.height[0], *h1 = rows.height[1], *h2 = rows.height[2];
  const float *k0 = rows.known[0], *k1 = rows.known[1], *k2 = rows.known[2];
  for (int c = 0; c < count; ++c) {
    const float n0 = k0[c - 1] + k0[c] + k0[c + 1], n2 = k2[c - 1] + k2[c] + k2[c + 1];
    const float west = k0[c - 1] + k1[c - 1] + k2[c - 1], east = k0[c + 1] + k1[c + 1] + k2[c + 1];
    const float n = n0 + k1[c - 1] + k1[c] + k1[c + 1] + n2;
    // Heights that are not known are 0.
    const float sum = (h0[c - 1] + h0[c] + h0[c + 1]) + (h1[c - 1] + h1[c] + h1[c + 1]) +
                      (h2[c - 1] + h2[c] + h2[c + 1]);
    const float around =
        (sum - rows.east[c] * (east - west) - rows.south[c] * (n2 - n0)) / (n > 0 ? n : 1.0F) -
        rows.plane[c];
    const float rest = h1[c] - rows.plane[c] - around;
    const float variance = rows.variance_m2[c];
    const float height = rows.plane[c] + BeyondNoise(around, kBroad * variance) +
                         BeyondNoise(rest, kFine * variance);
    denoised[c] = k1[c] > 0 ? height : 0.0F;
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
