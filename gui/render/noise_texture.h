// Tileable noise: the grain of ground and objects.
#pragma once

#include <vector>

#include "engine/core/random.h"
#include "engine/model/image.h"

namespace palace {

/// Self-similar noise that repeats seamlessly, made from coarse to fine: the field is doubled in
/// size by cubic B-spline subdivision, then fresh white noise is added (P. Burt and E. Adelson
/// 1983, the pyramid run backwards). `octave_weights` are the amplitudes from the coarsest grid
/// (size / 2^(n-1) cells a side) to the finest (`size`). Mean 0, standard deviation 1.
/// size must be a power of two with at least 4 cells on the coarsest grid.
ImageF TileableNoise(int size, const std::vector<float>& octave_weights, RandomStream& random);

/// Cracks and repair patches of old asphalt, as a change of brightness that repeats seamlessly;
/// 0 is untouched, -1 the bottom of a crack. `texel_m` is the side of one cell.
ImageF AsphaltMarks(int size, double texel_m, RandomStream& random);

}  // namespace palace
