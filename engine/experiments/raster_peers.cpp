#include "engine/experiments/raster_peers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palace {
namespace {

/// figure(nine heights, row by row) at every known cell.
template <typename Figure>
GridF Over3x3(const GridF& height_m, Figure figure) {
  GridF out(height_m.rows(), height_m.cols(), kUnknownValue);
  for (int r = 0; r < out.rows(); ++r) {
    for (int c = 0; c < out.cols(); ++c) {
      const float own = height_m.at(r, c);
      if (std::isnan(own)) {
        continue;
      }
      std::array<float, 9> nine;
      for (int k = 0; k < 9; ++k) {
        const int rr = r + k / 3 - 1, cc = c + k % 3 - 1;
        const bool inside = rr >= 0 && cc >= 0 && rr < out.rows() && cc < out.cols();
        const float near = inside ? height_m.at(rr, cc) : own;
        nine[static_cast<std::size_t>(k)] = std::isnan(near) ? own : near;
      }
      out.at(r, c) = figure(nine);
    }
  }
  return out;
}

}  // namespace

GridF PlainSlopeRad(const GridF& height_m, double cell_m) {
  const float scale = static_cast<float>(1 / (8 * cell_m));
  return Over3x3(height_m, [=](const std::array<float, 9>& z) {
    const float east = (z[2] + 2 * z[5] + z[8]) - (z[0] + 2 * z[3] + z[6]);
    const float south = (z[6] + 2 * z[7] + z[8]) - (z[0] + 2 * z[1] + z[2]);
    return std::atan(scale * std::sqrt(east * east + south * south));
  });
}

GridF PlainRoughnessM(const GridF& height_m) {
  return Over3x3(height_m, [](const std::array<float, 9>& z) {
    const auto [low, high] = std::minmax_element(z.begin(), z.end());
    return *high - *low;
  });
}

}  // namespace palace
