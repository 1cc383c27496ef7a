// Sideways registration: how far the pose of a frame lays its points aside of those before, told by
// the picture. Internal to the SLAD room.
//
// Position noise of 5 cm and 0.2 degrees at 15 m lay a rock of 20 cm in another cell each frame,
// and its height drowns in the mean. Texture tells the shift to two centimetres, where heights
// alone are flat and tell nothing. Steps, on a mosaic of the ground seen from above in a third of a
// map cell:
//
//   1  every pixel with a range falls into the mosaic's cell under it: mean grey of the frame F
//   2  F and the mosaic M lose their local means, so that exposure and shading say nothing
//   3  s = argmax of their normalised correlation, over whole cells up to 0.4 m, coarse then fine;
//      between cells the vertex of a parabola
//   4  F, shifted, joins the mean M of the last frames
//
// The map must follow navigation, not its own first frame: of the shift found all but
// g = 1 / (1 + frames_fused) is taken, and the map is held to lie that much nearer to the frame.
//
// Frames: W, metres, (north, east). Arithmetic in whole order on one thread: same input, same bits.
#pragma once

#include <cstdint>

#include <Eigen/Dense>

#include "engine/model/grid.h"
#include "engine/model/image.h"
#include "engine/model/range_map.h"

namespace palace {

class SidewaysRegistration {
 public:
  void Reset() { *this = {}; }

  struct Shift {
    Eigen::Vector2d by_m = Eigen::Vector2d::Zero();  ///< to add to the frame's points
    bool told = false;                               ///< false: the pictures do not say; by_m is 0
  };
  /// Registers a frame, which has a pose, to those before and adds it. `left`: of the range map's
  /// size. `geometry`: of the map. Nothing is told by the first frame, where too little is seen of
  /// both, or where no shift correlates by 0.3: no texture, light that moved.
  Shift Add(const RangeMap& range, const ImageU8& left, const GridGeometry& geometry,
            int frames_fused);

 private:
  void MoveTo(const GridGeometry& fine);
  void Follow(const Eigen::Vector2d& by_m);

  GridGeometry geometry_;  ///< of the mosaic
  GridF grey_;             ///< mean of the frames remembered; NaN where never seen
  Grid<std::uint16_t> frames_;
  /// What lies at the mosaic's origin lies there on the map: less than a mosaic's cell.
  Eigen::Vector2d followed_m_ = Eigen::Vector2d::Zero();
};

}  // namespace palace
