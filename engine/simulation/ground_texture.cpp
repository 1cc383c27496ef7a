#include "engine/simulation/ground_texture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palace {
namespace {

/// std::floor of moderate values, without a call into the library.
double Floor(double x) {
  const auto whole = static_cast<double>(static_cast<std::int64_t>(x));
  return whole - (x < whole ? 1.0 : 0.0);
}

/// -0.5 .. 0.5 at a lattice point.
double Lattice(std::int64_t i, std::int64_t j, std::uint64_t seed) {
  std::uint64_t h = seed * 0x9E3779B97F4A7C15ULL +
                    static_cast<std::uint64_t>(i) * 0xBF58476D1CE4E5B9ULL +
                    static_cast<std::uint64_t>(j) * 0x94D049BB133111EBULL;
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
  return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1.0p-53 - 0.5;
}

/// Smooth noise of one wavelength, about -0.5 .. 0.5.
double Noise(double u, double v, std::uint64_t seed) {
  const double fu = Floor(u);
  const double fv = Floor(v);
  const auto i = static_cast<std::int64_t>(fu);
  const auto j = static_cast<std::int64_t>(fv);
  const auto fade = [](double t) { return t * t * (3 - 2 * t); };
  const double a = fade(u - fu);
  const double b = fade(v - fv);
  return (1 - b) * ((1 - a) * Lattice(i, j, seed) + a * Lattice(i + 1, j, seed)) +
         b * ((1 - a) * Lattice(i, j + 1, seed) + a * Lattice(i + 1, j + 1, seed));
}

double Cloud(double u, double v, std::uint64_t seed) {
  double grey = 0;
  double wavelength_m = 0.8;
  for (std::uint64_t octave = 0; octave < 5; ++octave) {
    grey += Noise(u / wavelength_m, v / wavelength_m, seed + octave) * (octave < 3 ? 60 : 45);
    wavelength_m /= 2;
  }
  return 128 + grey;
}

/// The nearest and second nearest of one random point in each cell (Worley 1996).
struct NearestPoints {
  double first = std::numeric_limits<double>::infinity();  ///< distances, cells
  double second = std::numeric_limits<double>::infinity();
  double mark = 0;  ///< -0.5 .. 0.5, of the nearest
};

NearestPoints FindNearest(double u, double v, std::uint64_t seed) {
  NearestPoints near;
  const auto i0 = static_cast<std::int64_t>(Floor(u));
  const auto j0 = static_cast<std::int64_t>(Floor(v));
  std::int64_t nearest_i = i0, nearest_j = j0;
  for (std::int64_t i = i0 - 1; i <= i0 + 1; ++i) {
    for (std::int64_t j = j0 - 1; j <= j0 + 1; ++j) {
      const double du = static_cast<double>(i) + 0.5 + 0.9 * Lattice(i, j, seed) - u;
      const double dv = static_cast<double>(j) + 0.5 + 0.9 * Lattice(i, j, seed + 1) - v;
      const double square = du * du + dv * dv;
      if (square < near.first) {
        near.second = near.first;
        near.first = square;
        nearest_i = i;
        nearest_j = j;
      } else {
        near.second = std::min(near.second, square);
      }
    }
  }
  near.first = std::sqrt(near.first);
  near.second = std::sqrt(near.second);
  near.mark = Lattice(nearest_i, nearest_j, seed + 2);
  return near;
}

double Gravel(double u, double v, std::uint64_t seed) {
  constexpr double kStone_m = 0.035;
  constexpr double kGap = 0.12;  // cells
  const NearestPoints near = FindNearest(u / kStone_m, v / kStone_m, seed);
  const double slow = 30 * Noise(u / 0.5, v / 0.5, seed + 9);
  if (near.second - near.first < kGap) {
    return 55 + slow;
  }
  return (145 + 110 * near.mark) * (1 - 0.35 * near.first * near.first) + slow;
}

double Streaks(double u, double v, double direction_rad, std::uint64_t seed) {
  const double c = std::cos(direction_rad), s = std::sin(direction_rad);
  return Noise((c * u + s * v) / 0.10, (c * v - s * u) / 0.010, seed);
}

double Grass(double u, double v, std::uint64_t seed) {
  const double share = std::clamp(0.5 + 2 * Noise(u / 0.4, v / 0.4, seed + 3), 0.0, 1.0);
  const double blades =
      share * Streaks(u, v, 0.8, seed) + (1 - share) * Streaks(u, v, -0.4, seed + 1);
  return 100 + 130 * blades + 45 * Noise(u / 0.07, v / 0.07, seed + 4) +
         30 * Noise(u / 0.7, v / 0.7, seed + 5);
}

double Asphalt(double u, double v, std::uint64_t seed) {
  constexpr double kCell_m = 0.06;
  const double grain =
      22 * Noise(u / 0.008, v / 0.008, seed) + 20 * Noise(u / 0.025, v / 0.025, seed + 1);
  const double stains = 24 * Noise(u / 0.7, v / 0.7, seed + 2);
  const bool crack = std::abs(Noise(u / 1.1, v / 1.1, seed + 3)) < 0.004;
  const NearestPoints near = FindNearest(u / kCell_m, v / kCell_m, seed + 4);
  const bool chip = near.mark > 0 && near.first < 0.10 + 0.08 * near.mark;
  return 105 + grain + stains + (chip ? 60 : 0) - (crack ? 45 : 0);
}

}  // namespace

const char* NameOf(GroundTexture texture) {
  switch (texture) {
    case GroundTexture::kCloud:
      return "cloud";
    case GroundTexture::kGravel:
      return "gravel";
    case GroundTexture::kGrass:
      return "grass";
    case GroundTexture::kAsphalt:
      return "asphalt";
  }
  return "";
}

double GroundGrey(GroundTexture texture, double u_m, double v_m, std::uint64_t seed) {
  switch (texture) {
    case GroundTexture::kGravel:
      return Gravel(u_m, v_m, seed);
    case GroundTexture::kGrass:
      return Grass(u_m, v_m, seed);
    case GroundTexture::kAsphalt:
      return Asphalt(u_m, v_m, seed);
    case GroundTexture::kCloud:
      break;
  }
  return Cloud(u_m, v_m, seed);
}

}  // namespace palace
