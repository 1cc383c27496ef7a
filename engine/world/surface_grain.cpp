#include "engine/world/surface_grain.h"

#include <algorithm>
#include <cmath>

#include "engine/world/lattice_noise.h"

namespace palace {
namespace {

constexpr int kMask = SurfaceGrain::kTexels - 1;

/// Value noise that repeats after `period` lattice points.
double Repeating(double u, double v, int period, std::uint64_t seed) {
  const auto wrap = [period](std::int64_t i) { return ((i % period) + period) % period; };
  const double fu = FastFloor(u), fv = FastFloor(v);
  const auto i = static_cast<std::int64_t>(fu), j = static_cast<std::int64_t>(fv);
  const double a = u - fu, b = v - fv;
  const auto at = [&](std::int64_t k, std::int64_t l) {
    return LatticeValue(wrap(i + k), wrap(j + l), seed);
  };
  return (1 - b) * ((1 - a) * at(0, 0) + a * at(1, 0)) + b * ((1 - a) * at(0, 1) + a * at(1, 1));
}

}  // namespace

SurfaceGrain::SurfaceGrain(std::uint64_t seed) {
  texels_.reserve(kTexels * kTexels);
  for (int v = 0; v < kTexels; ++v) {
    for (int u = 0; u < kTexels; ++u) {
      double grain = 0;
      for (const int texels : {16, 6, 2}) {
        const double share = texels == 6 ? 1.0 : 0.8;
        grain += share * Repeating(static_cast<double>(u) / texels, static_cast<double>(v) / texels,
                                   kTexels / texels, seed + static_cast<std::uint64_t>(texels));
      }
      texels_.push_back(
          static_cast<std::uint8_t>(std::clamp(std::lround(128 + 127 * grain), 1L, 255L)));
    }
  }
}

double SurfaceGrain::At(double u_m, double v_m) const {
  const double u = u_m / kTexel_m - 0.5, v = v_m / kTexel_m - 0.5;
  const double fu = FastFloor(u), fv = FastFloor(v);
  const auto i = static_cast<std::int64_t>(fu), j = static_cast<std::int64_t>(fv);
  const double a = u - fu, b = v - fv;
  const auto at = [&](std::int64_t k, std::int64_t l) {
    return static_cast<double>(
        texels_[static_cast<std::size_t>(((j + l) & kMask) * kTexels + ((i + k) & kMask))]);
  };
  const double level =
      (1 - b) * ((1 - a) * at(0, 0) + a * at(1, 0)) + b * ((1 - a) * at(0, 1) + a * at(1, 1));
  return (level - 128) / 127;
}

}  // namespace palace
