// Puts the gear down around each cell of a row, heading after heading (touchdown.h says how it
// rests). Included by slad_loops.cpp and slad_loops_avx2.cpp only.
#pragma once

#include "engine/slad/float_lanes.h"
#include "engine/slad/slad_loops.h"

namespace palace {
namespace {

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

/// Highest of the skid's points above a line of this pitch through its middle.
inline FloatLanes Support(const FloatLanes* skid, int points, float spacing_m, FloatLanes pitch) {
  FloatLanes most = Fill(-1e30F);
  for (int k = 0; k < points; ++k) {
    const float x = spacing_m * (static_cast<float>(k) - 0.5F * static_cast<float>(points - 1));
    most = Max(skid[k] - pitch * Fill(x), most);
  }
  return most;
}

/// The two skids' supports add up to max over s of G(s) - pitch x(s), where G(s) is the highest sum
/// of one point of each that lie together at x(s): their least is the height at 0 of the concave
/// hull of G, and its pitch is the hull's there.
inline Resting RestOfSkids(const GearShape& gear, const GearHeading& heading, const float* height) {
  FloatLanes skid[2][kMostGearPoints];
  FloatLanes sum[2 * kMostGearPoints] = {};
  const int n = gear.points, most = n - 1;  // sums run from -most to most, in spacings
  for (int k = 0; k < n; ++k) {
    skid[0][k] = HeightAt(height, gear.pitch, heading.point[0][k]);
    skid[1][k] = HeightAt(height, gear.pitch, heading.point[1][k]);
  }
  for (int s = 0; s <= 2 * most; ++s) {
    const int first = s > most ? s - most : 0, last = s < most ? s : most;
    FloatLanes best = skid[0][first] + skid[1][s - first];
    for (int k = first + 1; k <= last; ++k) {
      best = Max(skid[0][k] + skid[1][s - k], best);
    }
    sum[s] = best;
  }
  FloatLanes least = sum[most];
  for (int a = 1; a <= most; ++a) {
    for (int b = 1; b <= most; ++b) {
      const float share = static_cast<float>(b) / static_cast<float>(a + b);
      least = Max(sum[most - a] * Fill(share) + sum[most + b] * Fill(1 - share), least);
    }
  }
  // Balanced on its middle the gear may fall either way: the steeper one counts.
  FloatLanes low = Fill(-1e30F), high = Fill(1e30F);
  for (int s = 1; s <= most; ++s) {
    const FloatLanes per_x = Fill(1 / (static_cast<float>(s) * gear.spacing_m));
    low = Max((sum[most + s] - least) * per_x, low);
    high = Min((least - sum[most - s]) * per_x, high);
  }
  const FloatLanes pitch = Select(Less(Abs(low), Abs(high)), high, low);
  const FloatLanes left = Support(skid[0], n, gear.spacing_m, pitch);
  const FloatLanes right = Support(skid[1], n, gear.spacing_m, pitch);
  return {pitch, (right - left) * Fill(1 / gear.width_m), least * Fill(0.5F)};
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
  for (int k = 0; k < heading.belly_cells; ++k) {
    const BellyCell& cell = heading.belly[k];
    const FloatLanes above = Load(height + cell.offset) - rest.middle_m -
                             north * Fill(cell.north_m) - east * Fill(cell.east_m);
    worst.rise_m = Max(above, worst.rise_m);
  }
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

void PutGearDownRow(const GearShape& gear, const float* height, int count, float* tan2,
                    float* rise_m) {
  for (int c = 0; c < count; c += FloatLanes::kCount) {
    WorstRest worst{Fill(0.0F), Fill(-1e30F)};
    for (int h = 0; h < gear.headings; ++h) {
      const GearHeading& heading = gear.heading[h];
      if (gear.skids) {
        Compare(gear, heading, height + c, RestOfSkids(gear, heading, height + c), worst);
      } else {
        CompareRestsOfPads(gear, heading, height + c, worst);
      }
    }
    Store(tan2 + c, worst.tan2);
    Store(rise_m + c, worst.rise_m);
  }
}

}  // namespace
}  // namespace palace
