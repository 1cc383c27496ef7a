#include "engine/world/ground_texture.h"

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
double Noise(double u, double v, std::uint64_t seed, NoiseMemory& m) {
  const double fu = Floor(u);
  const double fv = Floor(v);
  const auto i = static_cast<std::int64_t>(fu);
  const auto j = static_cast<std::int64_t>(fv);
  if (!m.known || i != m.i || j != m.j) {
    const bool next = m.known && i == m.i && j == m.j + 1;
    for (const std::int64_t k : {0, 1}) {
      auto& row = m.grey[static_cast<std::size_t>(k)];
      row[0] = next ? row[1] : Lattice(i + k, j, seed);
      row[1] = Lattice(i + k, j + 1, seed);
    }
    m.known = true;
    m.i = i;
    m.j = j;
  }
  const auto fade = [](double t) { return t * t * (3 - 2 * t); };
  const double a = fade(u - fu);
  const double b = fade(v - fv);
  return (1 - b) * ((1 - a) * m.grey[0][0] + a * m.grey[1][0]) +
         b * ((1 - a) * m.grey[0][1] + a * m.grey[1][1]);
}

double Cloud(double u, double v, std::uint64_t seed, TextureMemory& memory) {
  double grey = 0;
  double wavelength_m = 0.8;
  for (std::uint64_t octave = 0; octave < 5; ++octave) {
    grey += Noise(u / wavelength_m, v / wavelength_m, seed + octave, memory.noise[octave]) *
            (octave < 3 ? 60 : 45);
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

NearestPoints FindNearest(double u, double v, std::uint64_t seed, PointsMemory& m) {
  const auto i0 = static_cast<std::int64_t>(Floor(u));
  const auto j0 = static_cast<std::int64_t>(Floor(v));
  if (!m.known || i0 != m.i || j0 != m.j) {
    const bool next = m.known && i0 == m.i && j0 == m.j + 1;
    for (std::int64_t k = 0; k < 3; ++k) {
      auto& row = m.point[static_cast<std::size_t>(k)];
      for (std::int64_t l = 0; l < 3; ++l) {
        const std::int64_t i = i0 - 1 + k, j = j0 - 1 + l;
        const auto at = static_cast<std::size_t>(l);
        row[at] = next && l < 2
                      ? row[at + 1]
                      : std::array{static_cast<double>(i) + 0.5 + 0.9 * Lattice(i, j, seed),
                                   static_cast<double>(j) + 0.5 + 0.9 * Lattice(i, j, seed + 1)};
      }
    }
    m.known = true;
    m.i = i0;
    m.j = j0;
  }
  NearestPoints near;
  std::int64_t nearest = 4;
  for (std::int64_t k = 0; k < 9; ++k) {
    const auto& [point_u, point_v] =
        m.point[static_cast<std::size_t>(k / 3)][static_cast<std::size_t>(k % 3)];
    const double du = point_u - u;
    const double dv = point_v - v;
    const double square = du * du + dv * dv;
    if (square < near.first) {
      near.second = near.first;
      near.first = square;
      nearest = k;
    } else {
      near.second = std::min(near.second, square);
    }
  }
  near.first = std::sqrt(near.first);
  near.second = std::sqrt(near.second);
  near.mark = Lattice(i0 - 1 + nearest / 3, j0 - 1 + nearest % 3, seed + 2);
  return near;
}

double Gravel(double u, double v, std::uint64_t seed, TextureMemory& memory) {
  constexpr double kStone_m = 0.035;
  constexpr double kGap = 0.12;  // cells
  const NearestPoints near = FindNearest(u / kStone_m, v / kStone_m, seed, memory.points);
  const double slow = 30 * Noise(u / 0.5, v / 0.5, seed + 9, memory.noise[0]);
  if (near.second - near.first < kGap) {
    return 55 + slow;
  }
  return (145 + 110 * near.mark) * (1 - 0.35 * near.first * near.first) + slow;
}

double Streaks(double u, double v, double direction_rad, std::uint64_t seed, NoiseMemory& memory) {
  const double c = std::cos(direction_rad), s = std::sin(direction_rad);
  return Noise((c * u + s * v) / 0.10, (c * v - s * u) / 0.010, seed, memory);
}

double Grass(double u, double v, std::uint64_t seed, TextureMemory& memory) {
  auto& noise = memory.noise;
  const double share = std::clamp(0.5 + 2 * Noise(u / 0.4, v / 0.4, seed + 3, noise[0]), 0.0, 1.0);
  const double blades = share * Streaks(u, v, 0.8, seed, noise[1]) +
                        (1 - share) * Streaks(u, v, -0.4, seed + 1, noise[2]);
  return 100 + 130 * blades + 45 * Noise(u / 0.07, v / 0.07, seed + 4, noise[3]) +
         30 * Noise(u / 0.7, v / 0.7, seed + 5, noise[4]);
}

double Asphalt(double u, double v, std::uint64_t seed, TextureMemory& memory) {
  constexpr double kCell_m = 0.06;
  auto& noise = memory.noise;
  const double grain = 22 * Noise(u / 0.008, v / 0.008, seed, noise[0]) +
                       20 * Noise(u / 0.025, v / 0.025, seed + 1, noise[1]);
  const double stains = 24 * Noise(u / 0.7, v / 0.7, seed + 2, noise[2]);
  const bool crack = std::abs(Noise(u / 1.1, v / 1.1, seed + 3, noise[3])) < 0.004;
  const NearestPoints near = FindNearest(u / kCell_m, v / kCell_m, seed + 4, memory.points);
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

double GroundPainter::Grey(double u_m, double v_m) {
  switch (texture_) {
    case GroundTexture::kGravel:
      return Gravel(u_m, v_m, seed_, memory_);
    case GroundTexture::kGrass:
      return Grass(u_m, v_m, seed_, memory_);
    case GroundTexture::kAsphalt:
      return Asphalt(u_m, v_m, seed_, memory_);
    case GroundTexture::kCloud:
      break;
  }
  return Cloud(u_m, v_m, seed_, memory_);
}

}  // namespace palace
