// A straight piece of a thin structure, from the picture into the world.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/slad/pictures/line_pieces.h"
#include "engine/slad/pictures/scene_ground.h"

namespace palace {

/// A thin structure is looked for up to this disparity beyond the ground's.
inline constexpr double kMostAbove_px = 96;

/// Ends in W. Without a known height they lie on the ground seen behind it.
struct ThinPiece {
  Eigen::Vector3d from_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_W = Eigen::Vector3d::Zero();
  bool height_known = true;
};

/// Adds the pieces to `found`, each `above_px` beyond the ground's disparity.
void AddPieces(const SceneView& view, const SceneGround& ground, const MarkStrips& strips,
               const std::vector<LinePiece>& pieces, bool height_known,
               std::vector<ThinPiece>& found);

}  // namespace palace
