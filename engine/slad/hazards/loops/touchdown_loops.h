// Puts the gear down around each cell of a row, heading after heading (touchdown.h says how it
// rests). Included by slad_loops_table.h only.
#pragma once

#include "engine/core/lanes/float_lanes.h"
#include "engine/slad/hazards/loops/slad_loops.h"

namespace palace {
namespace {

/// Groups of columns that stand on the ground together: the rows of cells under a belly are loops
/// too short for one.
constexpr int kGroups = 4;

/// How the gear rests: gradients forward and to the right, and the height of its middle.
struct Resting {
  FloatLanes pitch, roll, middle_m;
};

/// What the headings tried so far have come to.
struct WorstRest {
  FloatLanes tan2 = Fill(0.0F), rise_m = Fill(-1e30F);
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
/// time. On its own it has the registers for itself.
template <int N>
__attribute__((noinline)) Resting RestOfSkids(const GearShape& gear, const GearHeading& heading,
                                              const float* height) {
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
    FloatLanes of_a = sum[kMost];  // on its own: one chain of maxima would wait for itself
#pragma GCC unroll 16
    for (int b = 1; b <= kMost; ++b) {
      const float share = static_cast<float>(b) / static_cast<float>(a + b);
      of_a = Max(sum[kMost - a] * Fill(share) + sum[kMost + b] * Fill(1 - share), of_a);
    }
    least = Max(of_a, least);
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

/// Measures one way to rest of each group, `column[g]` floats from the first, against the worst so
/// far.
inline void CompareRests(const GearShape& gear, const GearHeading& heading, const float* height,
                         const int* column, const Resting* rest, WorstRest* worst) {
  const FloatLanes n = Fill(heading.north), e = Fill(heading.east);
  const FloatLanes a = Fill(gear.up_W[0]), b = Fill(gear.up_W[1]), d = Fill(gear.up_W[2]);
  FloatLanes north[kGroups], east[kGroups], step[kGroups], most[kGroups];
  for (int g = 0; g < kGroups; ++g) {
    north[g] = rest[g].pitch * n - rest[g].roll * e;
    east[g] = rest[g].pitch * e + rest[g].roll * n;
    // |normal x up|^2 over (normal . up)^2 with the normal (-north, -east, -1).
    const FloatLanes x = b - east[g] * d, y = north[g] * d - a, z = east[g] * a - north[g] * b;
    const FloatLanes dot = Fill(0.0F) - (north[g] * a + east[g] * b + d);
    const FloatLanes tan2 = (x * x + y * y + z * z) / (dot * dot);
    worst[g].tan2 = Max(Select(Less(Fill(1e-3F), dot), tan2, Fill(1e6F)), worst[g].tan2);
    step[g] = east[g] * Fill(heading.belly_step_m);
    most[g] = worst[g].rise_m;
  }
  for (int k = 0; k < heading.belly_rows; ++k) {
    const BellyRow& row = heading.belly[k];
    FloatLanes base[kGroups];
    for (int g = 0; g < kGroups; ++g) {
      base[g] = rest[g].middle_m + north[g] * Fill(row.north_m) + east[g] * Fill(row.east_m);
    }
    const float* ground = height + row.offset;
    float steps = 0;
    for (int c = 0; c < row.cells; ++c) {
#pragma GCC unroll 4
      for (int g = 0; g < kGroups; ++g) {
        const FloatLanes plane_m = AddFused(base[g], step[g] * Fill(steps));
        most[g] = Max(Load(ground + column[g]) - plane_m, most[g]);
      }
      ground += row.stride;
      steps += 1;
    }
  }
  for (int g = 0; g < kGroups; ++g) {
    worst[g].rise_m = most[g];
  }
}

/// The higher diagonal carries; the gear leans on either pad of the other one.
struct RestsOfPads {
  Resting left, right;
};
inline RestsOfPads RestOfPads(const GearShape& gear, const GearHeading& heading,
                              const float* height) {
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
  return {{left, Select(carried_by_other, aft, fore), middle},
          {right, Select(carried_by_other, fore, aft), middle}};
}

struct Pads {
  static void Compare(const GearShape& gear, const GearHeading& heading, const float* height,
                      const int* column, WorstRest* worst) {
    Resting left[kGroups], right[kGroups];
    for (int g = 0; g < kGroups; ++g) {
      const RestsOfPads rests = RestOfPads(gear, heading, height + column[g]);
      left[g] = rests.left;
      right[g] = rests.right;
    }
    CompareRests(gear, heading, height, column, left, worst);
    CompareRests(gear, heading, height, column, right, worst);
  }
};

template <int N>
struct Skids {
  static void Compare(const GearShape& gear, const GearHeading& heading, const float* height,
                      const int* column, WorstRest* worst) {
    Resting rest[kGroups];
    for (int g = 0; g < kGroups; ++g) {
      const bool again = g > 0 && column[g] == 0;
      rest[g] = again ? rest[0] : RestOfSkids<N>(gear, heading, height + column[g]);
    }
    CompareRests(gear, heading, height, column, rest, worst);
  }
};

template <typename Gear>
void PutDownRow(const GearShape& gear, const float* height, int count, float* tan2, float* rise_m) {
  constexpr int kCount = FloatLanes::kCount;
  for (int c = 0; c < count; c += kGroups * kCount) {
    // A group beyond the row's end is the first once more.
    int column[kGroups];
    for (int g = 0; g < kGroups; ++g) {
      column[g] = c + g * kCount < count ? g * kCount : 0;
    }
    WorstRest worst[kGroups];
    for (int h = 0; h < gear.headings; ++h) {
      Gear::Compare(gear, gear.heading[h], height + c, column, worst);
    }
    for (int g = 0; g < kGroups; ++g) {
      Store(tan2 + c + column[g], worst[g].tan2);
      Store(rise_m + c + column[g], worst[g].rise_m);
    }
  }
}

void PutGearDownRow(const GearShape& gear, const float* height, int count, float* tan2,
                    float* rise_m) {
  static_assert(kMostGearPoints == 13);
  using Row = void (*)(const GearShape&, const float*, int, float*, float*);
  static constexpr Row rows[] = {PutDownRow<Skids<3>>,  PutDownRow<Skids<5>>,
                                 PutDownRow<Skids<7>>,  PutDownRow<Skids<9>>,
                                 PutDownRow<Skids<11>>, PutDownRow<Skids<13>>};
  const Row row = gear.skids ? rows[(gear.points - 3) / 2] : PutDownRow<Pads>;
  row(gear, height, count, tan2, rise_m);
}

}  // namespace
}  // namespace palace
