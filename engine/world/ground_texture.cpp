#include "engine/world/ground_texture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/world/lattice_noise.h"

namespace palace {
namespace {

/// Smooth noise of one wavelength, about -0.5 .. 0.5.
double Noise(double u, double v, std::uint64_t seed, NoiseMemory& m) {
  const double fu = FastFloor(u);
  const double fv = FastFloor(v);
  const auto i = static_cast<std::int64_t>(fu);
  const auto j = static_cast<std::int64_t>(fv);
  if (!m.known || i != m.i || j != m.j) {
    const bool next = m.known && i == m.i && j == m.j + 1;
    for (const std::int64_t k : {0, 1}) {
      auto& row = m.grey[static_cast<std::size_t>(k)];
      row[0] = next ? row[1] : LatticeValue(i + k, j, seed);
      row[1] = LatticeValue(i + k, j + 1, seed);
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
  const auto i0 = static_cast<std::int64_t>(FastFloor(u));
  const auto j0 = static_cast<std::int64_t>(FastFloor(v));
  if (!m.known || i0 != m.i || j0 != m.j) {
    const bool next = m.known && i0 == m.i && j0 == m.j + 1;
    for (std::int64_t k = 0; k < 3; ++k) {
      auto& row = m.point[static_cast<std::size_t>(k)];
      for (std::int64_t l = 0; l < 3; ++l) {
        const std::int64_t i = i0 - 1 + k, j = j0 - 1 + l;
        const auto at = static_cast<std::size_t>(l);
        row[at] =
            next && l < 2
                ? row[at + 1]
                : std::array{static_cast<double>(i) + 0.5 + 0.9 * LatticeValue(i, j, seed),
                             static_cast<double>(j) + 0.5 + 0.9 * LatticeValue(i, j, seed + 1)};
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
  near.mark = LatticeValue(i0 - 1 + nearest / 3, j0 - 1 + nearest % 3, seed + 2);
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

/// Clods of some 5 cm between darker gaps, on patches of wet and dry.
double Soil(double u, double v, std::uint64_t seed, TextureMemory& memory) {
  auto& noise = memory.noise;
  const NearestPoints near = FindNearest(u / 0.05, v / 0.05, seed, memory.points);
  const double clod = 26 * near.mark - 40 * std::max(0.0, near.first - 0.45);
  return 100 + clod + 22 * Noise(u / 0.02, v / 0.02, seed + 6, noise[0]) +
         34 * Noise(u / 0.9, v / 0.9, seed + 7, noise[1]) +
         20 * Noise(u / 0.25, v / 0.25, seed + 8, noise[2]);
}

/// Ripples of 12 cm that wander, grain, hardly any tone.
double Sand(double u, double v, std::uint64_t seed, TextureMemory& memory) {
  auto& noise = memory.noise;
  const double wander = 0.35 * Noise(u / 0.8, v / 0.8, seed, noise[0]);
  const double ripple = 7 * std::sin(6.2831853 * (0.83 * u + 0.56 * v + wander) / 0.12);
  return 168 + ripple + 16 * Noise(u / 0.012, v / 0.012, seed + 1, noise[1]) +
         14 * Noise(u / 1.3, v / 1.3, seed + 2, noise[2]);
}

/// Wind-packed: broad tones and a little crust.
double Snow(double u, double v, std::uint64_t seed, TextureMemory& memory) {
  auto& noise = memory.noise;
  return 226 + 10 * Noise(u / 1.7, v / 0.6, seed, noise[0]) +
         8 * Noise(u / 0.09, v / 0.04, seed + 1, noise[1]) +
         5 * Noise(u / 0.015, v / 0.015, seed + 2, noise[2]);
}

/// Slabs of 3 m with dark joints, each of its own tone; pores and stains.
double Concrete(double u, double v, std::uint64_t seed, TextureMemory& memory) {
  constexpr double kSlab_m = 3, kJoint_m = 0.015;
  auto& noise = memory.noise;
  const double a = u / kSlab_m - FastFloor(u / kSlab_m), b = v / kSlab_m - FastFloor(v / kSlab_m);
  const bool joint = std::min({a, b, 1 - a, 1 - b}) * kSlab_m < kJoint_m / 2;
  const double tone = 14 * LatticeValue(static_cast<std::int64_t>(FastFloor(u / kSlab_m)),
                                        static_cast<std::int64_t>(FastFloor(v / kSlab_m)), seed);
  const NearestPoints pore = FindNearest(u / 0.09, v / 0.09, seed + 3, memory.points);
  return 158 + tone + 18 * Noise(u / 0.01, v / 0.01, seed + 1, noise[0]) +
         20 * Noise(u / 0.5, v / 0.5, seed + 2, noise[1]) -
         (pore.mark > 0.2 && pore.first < 0.08 ? 35 : 0) - (joint ? 60 : 0);
}

/// Still water under an even sky.
double Water(double u, double v, std::uint64_t seed, TextureMemory& memory) {
  return 78 + 8 * Noise(u / 2.2, v / 2.2, seed, memory.noise[0]);
}

/// One coat: even, worn through in small places.
double Paint(double u, double v, std::uint64_t seed, TextureMemory& memory) {
  auto& noise = memory.noise;
  const double worn =
      Noise(u / 0.05, v / 0.05, seed, noise[0]) + 0.6 * Noise(u / 0.3, v / 0.3, seed + 1, noise[1]);
  return 205 + 12 * Noise(u / 0.012, v / 0.012, seed + 2, noise[2]) - (worn > 0.42 ? 70 : 0);
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
    case GroundTexture::kSoil:
      return "soil";
    case GroundTexture::kSand:
      return "sand";
    case GroundTexture::kSnow:
      return "snow";
    case GroundTexture::kConcrete:
      return "concrete";
    case GroundTexture::kWater:
      return "water";
    case GroundTexture::kPaint:
      return "paint";
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
    case GroundTexture::kSoil:
      return Soil(u_m, v_m, seed_, memory_);
    case GroundTexture::kSand:
      return Sand(u_m, v_m, seed_, memory_);
    case GroundTexture::kSnow:
      return Snow(u_m, v_m, seed_, memory_);
    case GroundTexture::kConcrete:
      return Concrete(u_m, v_m, seed_, memory_);
    case GroundTexture::kWater:
      return Water(u_m, v_m, seed_, memory_);
    case GroundTexture::kPaint:
      return Paint(u_m, v_m, seed_, memory_);
    case GroundTexture::kCloud:
      break;
  }
  return Cloud(u_m, v_m, seed_, memory_);
}

}  // namespace palace
