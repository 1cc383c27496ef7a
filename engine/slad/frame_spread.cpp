#include "engine/slad/frame_spread.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace palace {
namespace {

/// Chi-square over its degrees of freedom that noise exceeds once in ten thousand (Wilson &
/// Hilferty 1931).
double MostByNoise(int degrees) {
  constexpr double kOneInTenThousand = 3.72;  // normal quantile
  const double a = 2.0 / (9.0 * degrees);
  const double root = 1 - a + kOneInTenThousand * std::sqrt(a);
  return root * root * root;
}

}  // namespace

void FrameSpread::Add(double square_m2, double frame_noise_m2, int memory) {
  frames = static_cast<std::uint16_t>(std::min<int>(frames + 1, memory));
  const double share = 1.0 / frames;
  const double s = static_cast<double>(seen_m2);
  const double n = static_cast<double>(noise_m2);
  seen_m2 = static_cast<float>(s + share * ((1 - share) * square_m2 - s));
  noise_m2 = static_cast<float>(n + share * (frame_noise_m2 - n));
}

double FrameSpread::Relief_m() const {
  if (frames < 2) {
    return 0;
  }
  const double free = frames - 1.0;  // degrees of freedom
  const double by_noise = free / frames * MostByNoise(frames - 1) * static_cast<double>(noise_m2);
  return std::sqrt(std::max(0.0, static_cast<double>(seen_m2) - by_noise));
}

void AddReliefBetweenFrames(const Grid<FrameSpread>& spread, ElevationMap& map) {
  for (std::size_t i = 0; i < map.state.cells().size(); ++i) {
    if (map.state.cells()[i] == CellState::kMeasured) {
      map.height_m.cells()[i] += static_cast<float>(spread.cells()[i].Relief_m());
    }
  }
}

}  // namespace palace
