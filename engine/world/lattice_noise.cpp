#include "engine/world/lattice_noise.h"

#include <cmath>

namespace palace {
namespace {

/// Standard deviation of SmoothNoise over all places: value noise of uniform values, faded.
constexpr double kSmoothSigma = 0.216;

}  // namespace

double SmoothNoise(double u, double v, std::uint64_t seed) {
  const double fu = FastFloor(u), fv = FastFloor(v);
  const auto i = static_cast<std::int64_t>(fu), j = static_cast<std::int64_t>(fv);
  const auto fade = [](double t) { return t * t * (3 - 2 * t); };
  const double a = fade(u - fu), b = fade(v - fv);
  const double low = (1 - a) * LatticeValue(i, j, seed) + a * LatticeValue(i + 1, j, seed);
  const double high = (1 - a) * LatticeValue(i, j + 1, seed) + a * LatticeValue(i + 1, j + 1, seed);
  return (1 - b) * low + b * high;
}

double FractalNoise(double u, double v, std::uint64_t seed, double longest, double shortest,
                    double hurst) {
  double sum = 0, power = 0, amplitude = 1;
  // Turned from octave to octave, so that the lattices do not line up.
  double x = u / longest, y = v / longest;
  for (double wavelength = longest; wavelength >= shortest; wavelength /= 2) {
    sum += amplitude * SmoothNoise(x, y, seed++);
    power += amplitude * amplitude;
    amplitude *= std::exp2(-hurst);
    const double turned = 2 * (0.8 * x - 0.6 * y);
    y = 2 * (0.6 * x + 0.8 * y) + 17.3;
    x = turned;
  }
  return power > 0 ? sum / (kSmoothSigma * std::sqrt(power)) : 0;
}

}  // namespace palace
