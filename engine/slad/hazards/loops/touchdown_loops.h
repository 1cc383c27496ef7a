// Puts the gear down around each cell of a row, heading after heading (touchdown.h says how it
// rests). Included by slad_loops_table.h only.
#pragma once

#include "engine/core/lanes/float_lanes.h"
#include "engine/slad/hazards/loops/slad_loops.h"

namespace palace {
namespace {

constexpr int kBellyRun = 10;  // columns

/// How the gear rests: gradients forward and to the right, and the height of its middle.
struct Resting {
  FloatLanes pitch, roll, middle_m;
};

/// What the headings tried so far have come to.
struct WorstRest {
  FloatLanes tan2, rise_m;
};

inline FloatLanes HeightAt(const float* height, int pitch, const GearPoint& point) {
  const float* at = height + point.offset;
  return Load(at) * Fill(point.weight[0]) + Load(at + 1) * Fill(point.weight[1]) +
         (Load(at + pitch) * Fill(point.weight[2]) + Load(at + pitch + 1) * Fill(point.weight[3]));
}

/// Highest of the skid's N points above a line through its middle that rises by `step` from point
/// to point.
template <int N>
FloatLanes Support(const FloatLanes* skid, FloatLanes step) {
  FloatLanes most = skid[0] + step * Fill(0.5F * (N - 1));
#pragma GCC unroll 16
  for (int k = 1; k < N; ++k) {
    most = Max(skid[k] - step * Fill(static_cast<float>(k) - 0.5F * (N - 1)), most);
  }
  return most;
}

/// The two skids' supports add up to max over s of G(s) - pitch x(s), where G(s) is the highest sum
/// of one point of each that lie together at x(s): their least is the height at 0 of the concave
/// hull of G, and its pitch is the hull's there. N points a skid, unrolled: it is nearly all the
/// time.
template <int N>
Resting RestOfSkids(const GearShape& gear, const GearHeading& heading, const float* height) {
  constexpr int kMost = N - 1;  // sums run from -kMost to kMost, in spacings
  FloatLanes skid[2][N];
  FloatLanes sum[2 * N - 1];
#pragma GCC unroll 16
  for (int k = 0; k < N; ++k) {
    skid[0][k] = HeightAt(height, gear.pitch, heading.point[0][k]);
    skid[1][k] = HeightAt(height, gear.pitch, heading.point[1][k]);
  }
#pragma GCC unroll 32
  for (int s = 0; s <= 2 * kMost; ++s) {
    const int first = s > kMost ? s - kMost : 0, last = s < kMost ? s : kMost;
    FloatLanes best = AddFused(skid[0][first], skid[1][s - first]);
#pragma GCC unroll 16
    for (int k = first + 1; k <= last; ++k) {
      best = Max(AddFused(skid[0][k], skid[1][s - k]), best);
    }
    sum[s] = best;
  }
  FloatLanes least = sum[kMost];
#pragma GCC unroll 16
  for (int a = 1; a <= kMost; ++a) {
#pragma GCC unroll 16
    for (int b = 1; b <= kMost; ++b) {
      const float share = static_cast<float>(b) / static_cast<float>(a + b);
      least = Max(sum[kMost - a] * Fill(share) + sum[kMost + b] * Fill(1 - share), least);
    }
  }
  // Balanced on its middle the gear may fall either way: the steeper one counts.
  FloatLanes low = sum[kMost + 1] - least, high = least - sum[kMost - 1];
#pragma GCC unroll 16
  for (int s = 2; s <= kMost; ++s) {
    const FloatLanes per_x = Fill(1 / static_cast<float>(s));
    low = Max((sum[kMost + s] - least) * per_x, low);
    high = Min((least - sum[kMost - s]) * per_x, high);
  }
  const FloatLanes step = Select(Less(Abs(low), Abs(high)), high, low);
  const FloatLanes roll = Support<N>(skid[1], step) - Support<N>(skid[0], step);
  return {step * Fill(1 / gear.spacing_m), roll * Fill(1 / gear.width_m), least * Fill(0.5F)};
}

/// Measures one way to rest against the worst so far.
inline void Compare(const GearShape& gear, const GearHeading& heading, const float* height,
                    const Resting& rest, WorstRest& worst) {
  const FloatLanes n = Fill(heading.north), e = Fill(heading.east);
  const FloatLanes north = rest.pitch * n - rest.roll * e, east = rest.pitch * e + rest.roll * n;
  const FloatLanes a = Fill(gear.up_W[0]), b = Fill(gear.up_W[1]), d = Fill(gear.up_W[2]);
  // |normal x up|^2 over (normal . up)^2 with the normal (-north, -east, -1).
  const FloatLanes x = b - east * d, y = north * d - a, z = east * a - north * b;
  const FloatLanes dot = Fill(0.0F) - (north * a + east * b + d);
  const FloatLanes tan2 = (x * x + y * y + z * z) / (dot * dot);
  worst.tan2 = Max(Select(Less(Fill(1e-3F), dot), tan2, Fill(1e6F)), worst.tan2);
  const FloatLanes step = east * Fill(heading.belly_step_m);
  FloatLanes most = worst.rise_m;
  for (int first = 0; first < heading.most_belly_cells; first += kBellyRun) {
    // How far the plane rises from the first cell of a row, in all rows the same.
    FloatLanes rise[kBellyRun];
    for (int c = 0; c < kBellyRun; ++c) {
      rise[c] = step * Fill(static_cast<float>(first + c));
    }
    for (int k = 0; k < heading.belly_rows; ++k) {
      const BellyRow& row = heading.belly[k];
      const FloatLanes base = rest.middle_m + north * Fill(row.north_m) + east * Fill(row.east_m);
      const int count = row.cells - first < kBellyRun ? row.cells - first : kBellyRun;
      const float* ground = height + row.offset + first * row.stride;
      for (int c = 0; c < count; ++c) {
        most = Max(Load(ground) - AddFused(base, rise[c]), most);
        ground += row.stride;
      }
    }
  }
  worst.rise_m = most;
}

/// The higher diagonal carries; the gear leans on either pad of the other one.
inline void CompareRestsOfPads(const GearShape& gear, const GearHeading& heading,
                               const float* height, WorstRest& worst) {
  const FloatLanes left_aft = HeightAt(height, gear.pitch, heading.point[0][0]);
  const FloatLanes left_fore = HeightAt(height, gear.pitch, heading.point[0][1]);
  const FloatLanes right_aft = HeightAt(height, gear.pitch, heading.point[1][0]);
  const FloatLanes right_fore = HeightAt(height, gear.pitch, heading.point[1][1]);
  const FloatLanes one = left_aft + right_fore, other = left_fore + right_aft;
  const FloatLanes middle = Max(one, other) * Fill(0.5F);
  const FloatLanes per_length = Fill(1 / gear.spacing_m), per_width = Fill(1 / gear.width_m);
  const FloatLanes right = (right_fore - right_aft) * per_length,
                   left = (left_fore - left_aft) * per_length,
                   fore = (right_fore - left_fore) * per_width,
                   aft = (right_aft - left_aft) * per_width;
  const LaneMask carried_by_other = Less(one, other);
  // Three pads share one fore-aft side and one cross side; the missing pad is at their far corner.
  Compare(gear, heading, height, {left, Select(carried_by_other, aft, fore), middle}, worst);
  Compare(gear, heading, height, {right, Select(carried_by_other, fore, aft), middle}, worst);
}

template <int N>
void PutSkidsDownRow(const GearShape& gear, const float* height, int count, float* tan2,
                     float* rise_m) {
  for (int c = 0; c < count; c += FloatLanes::kCount) {
    WorstRest worst{Fill(0.0F), Fill(-1e30F)};
    for (int h = 0; h < gear.headings; ++h) {
      const GearHeading& heading = gear.heading[h];
      Compare(gear, heading, height + c, RestOfSkids<N>(gear, heading, height + c), worst);
    }
    Store(tan2 + c, worst.tan2);
    Store(rise_m + c, worst.rise_m);
  }
}

void PutGearDownRow(const GearShape& gear, const float* height, int count, float* tan2,
                    float* rise_m) {
  static_assert(kMostGearPoints == 13);
  using Row = void (*)(const GearShape&, const float*, int, float*, float*);
  static constexpr Row rows[] = {PutSkidsDownRow<3>, PutSkidsDownRow<5>,  PutSkidsDownRow<7>,
                                 PutSkidsDownRow<9>, PutSkidsDownRow<11>, PutSkidsDownRow<13>};
  if (gear.skids) {
    rows[(gear.points - 3) / 2](gear, height, count, tan2, rise_m);
    return;
  }
  for (int c = 0; c < count; c += FloatLanes::kCount) {
    WorstRest worst{Fill(0.0F), Fill(-1e30F)};
    for (int h = 0; h < gear.headings; ++h) {
      CompareRestsOfPads(gear, gear.heading[h], height + c, worst);
    }
    Store(tan2 + c, worst.tan2);
    Store(rise_m + c, worst.rise_m);
  }
}

}  // namespace
}  // namespace palace
