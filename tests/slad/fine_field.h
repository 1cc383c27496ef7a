// What pictures would tell of ground in closed form: places with heights, noise and information.
#pragma once

#include "engine/core/random.h"
#include "engine/slad/terrain/fine_relief.h"
#include "tests/slad/worlds.h"

namespace palace::testing {

/// Of each place of the map its height off `ground` by noise of `sigma_m`, known that well, from
/// pixels that were laid on `laid`.
inline FineSums FineField(const GridGeometry& map, const Height& ground, double sigma_m,
                          std::uint64_t seed = 1, const Height& laid = Flat()) {
  const GridGeometry places = FineRelief::PlacesOf(map);
  Grid<FineKnown> known(places.rows, places.cols);
  RandomStream random(seed, "pictures");
  for (int r = 0; r < places.rows; ++r) {
    for (int c = 0; c < places.cols; ++c) {
      FineKnown& place = known.at(r, c);
      const double height_m =
          ground(places.NorthOfRow(r), places.EastOfCol(c)) + sigma_m * random.Normal();
      place.net = place.gross = static_cast<float>(1 / (sigma_m * sigma_m));
      place.height = place.net * static_cast<float>(height_m);
      place.off = place.net *
                  static_cast<float>(height_m - laid(places.NorthOfRow(r), places.EastOfCol(c)));
    }
  }
  return {known, places, 0};
}

}  // namespace palace::testing
