// Films of a few pictures over coarse ground, for the tests of the experiments that fly them.
#pragma once

#include "engine/experiments/film_ground.h"

namespace palace {

/// Coarse and quick; of the width of the real one.
inline constexpr GroundPyramid::Extent kCoarse{0.04, 640, 4};

inline FilmGroundOptions Short(int pictures) {
  FilmGroundOptions options;
  options.materials = {"gravel", "soil"};
  options.film.pictures = pictures;
  options.extent = kCoarse;
  return options;
}

/// Small pictures, too.
inline FilmGroundOptions ShortAndSmall(int pictures) {
  FilmGroundOptions options = Short(pictures);
  options.film.width_px = 192;
  options.film.height_px = 144;
  return options;
}

}  // namespace palace
