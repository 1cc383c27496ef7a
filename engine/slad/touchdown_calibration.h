// From a score of a touchdown to the share of such touchdowns that are safe. Included by loops
// only.
//
// The score is a product of Gaussian tails (verdict_loops.h). Largest deviations of many noisy
// cells, ground finer than a cell and rocks too small to be seen make it no probability: among
// simulated touchdowns of one score another share was safe. The table is that share, made monotone
// (pool adjacent violators; Ayer et al. 1955) and drawn through a few knots. Origin: 28,000
// touchdowns on the ground of `evaluate probability`, 1,000 fields of each of its seven kinds,
// seeds 1000000 to 1006999, default limits, skids, cells of 0.15 m.
#pragma once

namespace palace {
namespace {

inline constexpr int kScoreKnots = 21;
inline constexpr float kScoreKnot[kScoreKnots] = {
    0.0F,    0.1F,    0.25F,   0.35F,   0.45F,   0.525F,  0.625F,
    0.68F,   0.73F,   0.7755F, 0.8213F, 0.8554F, 0.8863F, 0.9106F,
    0.9251F, 0.9352F, 0.9454F, 0.9527F, 0.9578F, 0.9615F, 1.0F};
inline constexpr float kShareKnot[kScoreKnots] = {
    0.0F,   0.008F, 0.02F,  0.04F, 0.115F, 0.23F,   0.43F,   0.59F,   0.68F,   0.795F, 0.852F,
    0.893F, 0.915F, 0.932F, 0.94F, 0.955F, 0.9765F, 0.9895F, 0.9945F, 0.9995F, 1.0F};

/// Between knots the share is linear.
inline float ShareOfSafe(float score) {
  float share = kShareKnot[0];
  for (int k = 1; k < kScoreKnots; ++k) {
    const float width = kScoreKnot[k] - kScoreKnot[k - 1];
    const float steep = (kShareKnot[k] - kShareKnot[k - 1]) / width;
    const float above = score - kScoreKnot[k - 1];
    const float inside = above < 0 ? 0.0F : above > width ? width : above;
    share += steep * inside;
  }
  return share;
}

}  // namespace
}  // namespace palace
