// SeenGround: the ground that was looked at since the vehicle began to hover here.
//
// Squares of 2 m, fixed in W, over kHalfSide_m to every side of where it began. One is looked at
// when kMapsOfALook maps were made with its middle in view, whatever they found: what stays unknown
// after so many is not worth the same look again. Ground beyond the squares is not kept.
#pragma once

#include <cstdint>

#include <Eigen/Dense>

#include "engine/model/grid.h"

namespace palace {

struct SeenGround {
  static constexpr double kSquare_m = 2, kHalfSide_m = 128;
  static constexpr int kMapsOfALook = 20;
  /// The search keeps to so much round the middle, where no area is drawn.
  static constexpr double kSearched_m = 60;

  Eigen::Vector2d middle_W = Eigen::Vector2d::Zero();
  GridGeometry squares;
  Grid<std::uint8_t> maps;  ///< made with it in view; no more than kMapsOfALook
  /// Mean height that the newest map measured, above the origin of W: the ground is taken as level.
  double ground_m = 0;

  bool IsLookedAt(Cell square) const { return maps.at(square) >= kMapsOfALook; }
};

}  // namespace palace
