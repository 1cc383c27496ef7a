// Ground seen from above: grey as an exact function of place, for pictures made by ray casting.
//
// Nothing here is made for a matcher: edges are sharp (the pictures are smoothed by super-sampling,
// as an eye and a lens do) and the three kinds of ground differ in what they offer.
#pragma once

#include <cstdint>

namespace palace {

enum class GroundTexture {
  kCloud,    ///< smooth noise in five octaves from 0.8 m to 5 cm
  kGravel,   ///< stones of some 3 cm, each of its own grey, dark gaps
  kGrass,    ///< streaks 1 cm wide and 10 cm long in patches of two directions
  kAsphalt,  ///< nearly even, with fine grain, a chip in every second 6 cm cell, stains, a few
             ///< cracks
};

/// Lower-case English: "gravel".
const char* NameOf(GroundTexture texture);

/// Grey about 0..255 at a place in metres.
double GroundGrey(GroundTexture texture, double u_m, double v_m, std::uint64_t seed);

}  // namespace palace
