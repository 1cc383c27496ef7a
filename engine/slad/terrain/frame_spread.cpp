#include "engine/slad/terrain/frame_spread.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace palace {
namespace {

/// Chi-square over its degrees of freedom that noise exceeds once in a million (Wilson & Hilferty
/// 1931).
double MostByNoise(int degrees) {
  constexpr double kOneInAMillion = 4.753;  // normal quantile
  const double a = 2.0 / (9.0 * degrees);
  const double root = 1 - a + kOneInAMillion * std::sqrt(a);
  return root * root * root;
}

constexpr double kLeastFrames = 1.5;  // on the upper level: one alone is a false match

/// Of two levels the upper of which this share of the frames sees.
double SkewnessOfFew(double share) { return (1 - 2 * share) / std::sqrt(share * (1 - share)); }

}  // namespace

void FrameSpread::Add(double off_m, double frame_noise_m2, int memory) {
  frames = static_cast<std::uint16_t>(std::min<int>(frames + 1, memory));
  const double w = 1.0 / frames;
  const double d = off_m - static_cast<double>(mean_m);
  const double s = static_cast<double>(square_m2);
  const double c = static_cast<double>(cube_m3);
  const double n = static_cast<double>(noise_m2);
  mean_m += static_cast<float>(w * d);
  square_m2 = static_cast<float>((1 - w) * (s + w * d * d));
  cube_m3 = static_cast<float>((1 - w) * (c - 3 * w * d * s + w * (1 - 2 * w) * d * d * d));
  noise_m2 = static_cast<float>(n + w * (frame_noise_m2 - n));
}

double FrameSpread::Relief_m() const {
  if (frames < 2) {
    return 0;
  }
  const double s = static_cast<double>(square_m2);
  const double free = frames - 1.0;  // degrees of freedom
  const double by_noise = free / frames * MostByNoise(frames - 1) * static_cast<double>(noise_m2);
  if (!(s > by_noise)) {
    return 0;
  }
  const double skewness = static_cast<double>(cube_m3) / (s * std::sqrt(s));
  if (skewness > SkewnessOfFew(kLeastFrames / frames)) {
    return 0;
  }
  const double t = skewness / 2;
  const double upper = std::min(1.0, t + std::sqrt(1 + t * t));
  return std::max(0.0, static_cast<double>(mean_m) + upper * std::sqrt(s - by_noise));
}

void AddReliefBetweenFrames(const Grid<FrameSpread>& spread, ElevationMap& map) {
  for (std::size_t i = 0; i < map.state.cells().size(); ++i) {
    if (map.state.cells()[i] == CellState::kMeasured) {
      map.height_m.cells()[i] += static_cast<float>(spread.cells()[i].Relief_m());
    }
  }
}

}  // namespace palace
