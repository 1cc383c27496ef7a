// From a score of a touchdown to the share of such touchdowns that are safe. Included by loops
// only.
//
// The score is a product of Gaussian tails (verdict_loops.h). Largest deviations of many noisy
// cells, ground finer than a cell and rocks too small to be seen make it no probability: among
// simulated touchdowns of one score another share was safe. The table is that share, made monotone
// (pool adjacent violators; Ayer et al. 1955) and drawn through a few knots. Origin: 84,000
// touchdowns of `evaluate probability`, seeds 1 to 14000, 2,000 fields of each of its seven kinds
// of ground, default limits, skids, cells of 0.15 m. What is reported of it must come from other
// seeds.
#pragma once

namespace palace {
namespace {

inline constexpr int kScoreKnots = 25;
inline constexpr float kScoreKnot[kScoreKnots] = {
    0.0F,    0.0956F, 0.2227F, 0.3493F, 0.4459F, 0.5259F, 0.5803F, 0.6204F, 0.6557F,
    0.6852F, 0.7203F, 0.7606F, 0.8008F, 0.8351F, 0.8657F, 0.8934F, 0.9139F, 0.9272F,
    0.9361F, 0.9436F, 0.9502F, 0.9551F, 0.9586F, 0.962F,  1.0F};
inline constexpr float kShareKnot[kScoreKnots] = {
    0.0F,   0.006F, 0.018F,  0.049F, 0.126F,  0.195F, 0.315F, 0.4F,   0.455F,
    0.55F,  0.655F, 0.75F,   0.81F,  0.86F,   0.88F,  0.908F, 0.926F, 0.938F,
    0.956F, 0.969F, 0.9805F, 0.988F, 0.9955F, 0.999F, 1.0F};

/// Scores to shares, linear between knots; a knot at a time, for the compiler to vectorise.
inline void SharesOfSafe(const float* score, int count, float* __restrict__ share) {
  for (int c = 0; c < count; ++c) {
    share[c] = kShareKnot[0];
  }
  for (int k = 1; k < kScoreKnots; ++k) {
    const float low = kScoreKnot[k - 1], width = kScoreKnot[k] - low;
    const float steep = (kShareKnot[k] - kShareKnot[k - 1]) / width;
    for (int c = 0; c < count; ++c) {
      const float above = score[c] - low;
      const float inside = above < 0 ? 0.0F : above;
      share[c] += steep * (inside > width ? width : inside);
    }
  }
}

}  // namespace
}  // namespace palace
