// A straight piece of a thin structure, from the picture into the world.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/slad/pictures/line_pieces.h"
#include "engine/slad/pictures/scene_ground.h"

namespace palace {

/// A thin structure is looked for up to this disparity beyond the ground's.
inline constexpr double kMostAbove_px = 96;

/// A line nearer to the ground than this is no thin structure.
inline constexpr double kLeastAbove_px = 1.5;

/// A line along the baseline is looked for up to so many rows aside of itself.
inline constexpr int kMostAside_px = 40;
/// … and at least.
inline constexpr double kLeastAside_px = 1;

enum class ThinHeight { kKnown, kUnknown, kOnGround };

/// Ends in W. Without a known height they lie on the ground seen behind it.
struct ThinPiece {
  Eigen::Vector3d from_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_W = Eigen::Vector3d::Zero();
  ThinHeight height = ThinHeight::kKnown;
};

/// Adds the pieces to `found`, each `above_px` beyond the ground's disparity.
void AddPieces(const SceneView& view, const SceneGround& ground, const MarkStrips& strips,
               const std::vector<LinePiece>& pieces, ThinHeight height,
               std::vector<ThinPiece>& found);

}  // namespace palace
