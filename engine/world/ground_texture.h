// Ground seen from above: grey as an exact function of place, for pictures made by ray casting.
//
// Nothing here is made for a matcher: edges are sharp (the pictures are smoothed by super-sampling,
// as an eye and a lens do) and the kinds of ground differ in what they offer.
#pragma once

#include <array>
#include <cstdint>

namespace palace {

enum class GroundTexture {
  kCloud,     ///< smooth noise in five octaves from 0.8 m to 5 cm
  kGravel,    ///< stones of some 3 cm, each of its own grey, dark gaps
  kGrass,     ///< streaks 1 cm wide and 10 cm long in patches of two directions
  kAsphalt,   ///< nearly even, with fine grain, a chip in every second 6 cm cell, stains, a few
              ///< cracks
  kSoil,      ///< clods of some 5 cm, dark gaps, patches of wet and dry
  kSand,      ///< ripples, grain, hardly any tone
  kSnow,      ///< bright, with broad weak tones
  kConcrete,  ///< slabs of 3 m with joints, pores, stains
  kWater,     ///< dark and even
  kPaint,     ///< bright and even, worn through in small places
};

/// All of them, in order.
inline constexpr int kGroundTextures = 10;
/// Lower-case English: "gravel".
const char* NameOf(GroundTexture texture);

/// Lattice values of the last place, one wavelength.
struct NoiseMemory {
  bool known = false;
  std::int64_t i = 0, j = 0;
  std::array<std::array<double, 2>, 2> grey;
};
/// Random points around the last place.
struct PointsMemory {
  bool known = false;
  std::int64_t i = 0, j = 0;
  std::array<std::array<std::array<double, 2>, 3>, 3> point;
};
struct TextureMemory {
  std::array<NoiseMemory, 5> noise;
  PointsMemory points;
};

/// Grey about 0..255 at a place in metres, the same in any order of places; several times faster
/// where each lies close to the last, best a little farther along v.
class GroundPainter {
 public:
  GroundPainter(GroundTexture texture, std::uint64_t seed) : texture_(texture), seed_(seed) {}
  double Grey(double u_m, double v_m);

 private:
  GroundTexture texture_;
  std::uint64_t seed_;
  TextureMemory memory_;
};

}  // namespace palace
