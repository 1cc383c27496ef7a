// Smooth random functions of place: the same number at the same place, in any order of places.
#pragma once

#include <cstdint>

namespace palace {

/// std::floor of moderate values, without a call into the library.
inline double FastFloor(double x) {
  const auto whole = static_cast<double>(static_cast<std::int64_t>(x));
  return whole - (x < whole ? 1.0 : 0.0);
}

/// Independent uniform values at integer places, -0.5 .. 0.5.
inline double LatticeValue(std::int64_t i, std::int64_t j, std::uint64_t seed) {
  std::uint64_t h = seed * 0x9E3779B97F4A7C15ULL +
                    static_cast<std::uint64_t>(i) * 0xBF58476D1CE4E5B9ULL +
                    static_cast<std::uint64_t>(j) * 0x94D049BB133111EBULL;
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
  return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1.0p-53 - 0.5;
}

/// Value noise of one wavelength (1), -0.5 .. 0.5, with a continuous slope.
double SmoothNoise(double u, double v, std::uint64_t seed);
/// Sum of octaves from wavelength `longest` down to `shortest`, amplitude falling as
/// wavelength^`hurst` (0.5 rugged .. 1 smooth); scaled to a standard deviation of about 1.
double FractalNoise(double u, double v, std::uint64_t seed, double longest, double shortest,
                    double hurst);

}  // namespace palace
