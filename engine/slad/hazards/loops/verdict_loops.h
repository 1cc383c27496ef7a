// From figures and limits to slope, cost and reasons, a row at a time. Included by
// slad_loops_table.h only. Plain loops without branches, for the compiler to vectorise.
#pragma once

#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/hazards/touchdown_calibration.h"

namespace palace {
namespace {

/// atan over [0, 1], through nine Chebyshev points of atan(t)/t in t^2; within 1e-7.
inline float ArcTangent(float t) {
  const float s = t * t;
  float p = 2.766283501e-03F;
  p = p * s + -1.573124912e-02F;
  p = p * s + 4.213762359e-02F;
  p = p * s + -7.456854826e-02F;
  p = p * s + 1.061837064e-01F;
  p = p * s + -1.419779779e-01F;
  p = p * s + 1.999187203e-01F;
  p = p * s + -3.333303671e-01F;
  p = p * s + 9.999999818e-01F;
  return p * t;
}

/// Standard normal distribution function within 2e-7 (Abramowitz & Stegun 1964, 7.1.28).
inline float NormalBelow(float x) {
  const float y = (x < 0 ? -x : x) * 0.70710678F;
  float q = 0.0000430638F;
  q = q * y + 0.0002765672F;
  q = q * y + 0.0001520143F;
  q = q * y + 0.0092705272F;
  q = q * y + 0.0422820123F;
  q = q * y + 0.0705230784F;
  q = q * y + 1.0F;
  // Far out the power would overflow; the tail is 0 there.
  q = q > 100.0F ? 100.0F : q;
  const float q2 = q * q, q4 = q2 * q2, q8 = q4 * q4;
  const float tail = 0.5F / q8 / q8;
  return x > 0 ? 1.0F - tail : tail;
}

constexpr int kVerdictRun = 128;  // columns

inline float Least(float a, float b) { return a < b ? a : b; }
inline float Largest(float a, float b) { return a > b ? a : b; }

/// atan2(|n x u|, n . u) of the normal n = (-north, -east, -1): small angles stay exact, where
/// acos(n . u) rounds them away.
void SlopeRow(const float* north, const float* east, const float* up_W, int count, float* slope) {
  constexpr float kPi = 3.14159265F;
  const float a = up_W[0], b = up_W[1], d = up_W[2];
  for (int c = 0; c < count; ++c) {
    const float x = b - east[c] * d, y = north[c] * d - a, z = east[c] * a - north[c] * b;
    const float dot = -(north[c] * a + east[c] * b + d);
    const float cross = __builtin_sqrtf(x * x + y * y + z * z);
    const float length = dot < 0 ? -dot : dot;
    const float t = ArcTangent(Least(cross, length) / Largest(cross, length));
    const float acute = cross > length ? 0.5F * kPi - t : t;
    const float angle = dot < 0 ? kPi - acute : acute;
    slope[c] = north[c] == north[c] ? angle : north[c];
  }
}

void ThesisVerdictRow(const ThesisLimits& limits, const float* slope, const float* roughness,
                      int count, float* cost, unsigned char* reasons) {
  const float most_a = limits.max_slope_rad, most_r = limits.max_roughness_m;
  const float scale = most_r * most_a;
  for (int c = 0; c < count; ++c) {
    const float a = slope[c], r = roughness[c];
    const float known_cost = a > most_a ? 1.0F : r > most_r ? 1.0F : r * a / scale;
    cost[c] = a + r == a + r ? known_cost : a + r;
  }
  for (int c = 0; c < count; ++c) {
    const float a = slope[c], r = roughness[c];
    const int steep = a > most_a ? kSteep : 0;
    const int rough = r > most_r ? kRough : 0;
    reasons[c] = static_cast<unsigned char>(a + r == a + r ? steep | rough : kNotKnown);
  }
}

/// What the figures of a footprint do not show whatever the noise: ground finer than a cell.
/// Heights as shares of their limits, so that a smaller lander on smaller rocks is judged alike.
/// Chosen, like the score, for the sharpest verdicts on the ground of `evaluate probability`, which
/// has no pictures: where these measured what is finer, no height is presumed besides.
constexpr float kFinerPlane_rad = 0.0031F, kFinerTilt_rad = 0.0052F;
constexpr float kFinerDeviation = 0.4F, kFinerStep = 0.53F, kFinerBelly = 0.12F;
/// Share of a cell's noise left in the difference of two supports.
constexpr float kSupportNoise = 0.33F;

inline float Hypotenuse(float a, float b) { return __builtin_sqrtf(a * a + b * b); }

/// Product of the chances that each figure of the touchdown keeps its limit.
inline float TouchdownScore(const ModernLimits& most, float slope, float slope_sigma,
                            float deviation, float step, float sigma, float tilt, float rise) {
  const float finer = most.finer_relief;
  return NormalBelow((most.max_slope_rad - slope) / Hypotenuse(slope_sigma, kFinerPlane_rad)) *
         NormalBelow((most.max_deviation_m - deviation) /
                     Hypotenuse(sigma, finer * kFinerDeviation * most.max_deviation_m)) *
         NormalBelow((most.max_step_m - step) /
                     Hypotenuse(sigma, finer * kFinerStep * most.max_step_m)) *
         NormalBelow((most.max_slope_rad - tilt) /
                     Hypotenuse(kSupportNoise * sigma / most.gear_width_m, kFinerTilt_rad)) *
         NormalBelow((most.belly_clearance_m - rise) /
                     Hypotenuse(sigma, finer * kFinerBelly * most.belly_clearance_m));
}

/// Some columns of ModernVerdictRow: one loop for each width of number, or none is vectorised.
inline void ModernVerdictRun(const ModernLimits& limits, const ModernRow& row, int first, int count,
                             const ModernVerdict& out) {
  constexpr float kPerRoot2 = 0.70710678F;
  constexpr float kFloor2 = kHeightSigmaFloor_m * kHeightSigmaFloor_m;
  const ModernLimits most = limits;
  float cell_safe[kVerdictRun];
  int reasons[kVerdictRun];
  const float* slope = row.slope + first;
  const float* deviation = row.footprint_deviation_m + first;
  const float* step = row.footprint_step_m + first;
  const float* sigma = row.footprint_sigma_m + first;
  const float* slope_sigma = row.slope_sigma + first;
  const float* cell_deviation = row.cell_deviation_m + first;
  const float* cell_step = row.cell_step_m + first;
  const float* cell_sigma = row.cell_sigma_m + first;
  const float* denoised = row.denoised_deviation_m + first;
  const float* tilt = row.gear_tilt + first;
  const float* rise = row.belly_rise_m + first;
  float enough[kVerdictRun];
  float score[kVerdictRun], safe_share[kVerdictRun];
  for (int c = 0; c < count; ++c) {
    score[c] = TouchdownScore(most, slope[c], slope_sigma[c], denoised[c], step[c], sigma[c],
                              tilt[c], rise[c]);
  }
  SharesOfSafe(score, count, safe_share);
  float* __restrict__ safe_probability = out.safe_probability + first;
  for (int c = 0; c < count; ++c) {
    const float known = tilt[c] == tilt[c] ? safe_share[c] : 0.0F;
    safe_probability[c] = slope[c] == slope[c] ? known : slope[c];
  }
  for (int c = 0; c < count; ++c) {
    const float flat = NormalBelow((most.max_slope_rad - slope[c]) / slope_sigma[c]);
    // A step is a difference of two heights.
    const float cell_margin = Least(most.max_deviation_m - cell_deviation[c],
                                    (most.max_step_m - cell_step[c]) * kPerRoot2);
    const float cell_s = __builtin_sqrtf(cell_sigma[c] * cell_sigma[c] + kFloor2);
    cell_safe[c] = flat * NormalBelow(cell_margin / cell_s);
    // RequiredSafeProbability (cell_explanation.h) at the noise of the ground around: a cell that
    // is less sure than its neighbours is where something stands.
    const float noise = sigma[c] / most.provisional_sigma_m;
    enough[c] = Least(most.min_safe_probability, 1 - noise * noise);
  }
  for (int c = 0; c < count; ++c) {
    reasons[c] = row.measured[first + c] != 0 ? 0 : kNotKnown;
  }
  for (int c = 0; c < count; ++c) {
    const int steep = slope[c] > most.max_slope_rad ? kSteep : 0;
    const int rough = cell_deviation[c] > most.max_deviation_m ? kRough : 0;
    const int stepped = cell_step[c] > most.max_step_m ? kStepped : 0;
    const int unlikely = cell_safe[c] >= enough[c] ? 0 : kUnlikely;  // also of an unknown noise
    const int verdict = steep | rough | stepped | unlikely;
    reasons[c] |= slope[c] == slope[c] ? verdict : kNotKnown;
  }
  for (int c = 0; c < count; ++c) {
    const float share =
        Largest(Largest(slope[c] / most.max_slope_rad, deviation[c] / most.max_deviation_m),
                step[c] / most.max_step_m);
    const float cost = reasons[c] != 0 ? 1.0F : Least(share, 1.0F);
    out.cost[first + c] = slope[c] == slope[c] ? cost : slope[c];
  }
  for (int c = 0; c < count; ++c) {
    out.reasons[first + c] = static_cast<unsigned char>(reasons[c]);
  }
}

void ModernVerdictRow(const ModernLimits& limits, const ModernRow& row, int count,
                      const ModernVerdict& out) {
  for (int c = 0; c < count; c += kVerdictRun) {
    ModernVerdictRun(limits, row, c, count - c < kVerdictRun ? count - c : kVerdictRun, out);
  }
}

}  // namespace
}  // namespace palace
