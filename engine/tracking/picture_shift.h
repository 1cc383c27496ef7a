// Picture shift: how far the whole picture moved from one frame to the next.
//
// The displacement d and the change of brightness c that minimise
//
//   sum over the picture of (I_after(x + d) - I_before(x) - c)^2
//
// by Gauss-Newton on a pyramid of block means, a quarter of the picture's size and two halvings of
// that. It is the motion of the middle where the texture lies on all sides of it: what a turn about
// the optical axis and nearer ground at the lower edge add is then of opposite sign, or slow. Where
// the turn is known it need not (TurnedAroundMiddle). Positive to the right and down, pixels of the
// whole picture.
// Source: B. Lucas, T. Kanade, "An iterative image registration technique", 1981.
#pragma once

#include <array>
#include <optional>

#include <Eigen/Dense>

#include "engine/model/image.h"
#include "engine/model/rig.h"

namespace palace {

/// Block means, finest first; empty where the picture is too small for a level.
struct PicturePyramid {
  static constexpr int kLevels = 3;
  static constexpr int kFinest = 4;  ///< pixels of the picture a side of a block
  std::array<ImageF, kLevels> levels{};
};
PicturePyramid MakePyramid(const ImageU8& picture);

/// The picture after the camera turned by R_now_before, moved so that its middle is where it was:
/// with it the shift to the next picture has only the turn of the middle left in it, wherever the
/// texture lies. What comes into view repeats the edge. Empty levels stay so.
PicturePyramid TurnedAroundMiddle(const PicturePyramid& before, const PinholeCamera& camera,
                                  const Eigen::Matrix3d& R_now_before);

/// Nothing for pictures without texture in both directions, of different sizes, or that are not of
/// one scene: moved on, they correlate by less than 0.8.
std::optional<Eigen::Vector2d> ShiftBetween(const PicturePyramid& before,
                                            const PicturePyramid& after);

}  // namespace palace
