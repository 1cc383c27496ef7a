// Thin structures above the ground, seen in a stereo pair: wires, ropes, poles, masts.
//
// The right picture is laid over the left one with the ground's disparity (scene_ground.h). Ground
// cancels, with everything painted on it; a line above it stays. Differences beyond the local mean
// are marked, straight lines with many marks are found in strips of 32 pixels (line_sums.h), and
// each piece is matched by itself: its own pixels must be found again at one nearer disparity,
// clearly better than on the ground and than at other disparities. Three pieces in a row, which may
// bend a little, are a thin structure.
//
// A line within some 3 degrees of the baseline shows no disparity: moved along itself it looks the
// same. Such a line is taken from the left picture alone, and only when it is thin, spans most of
// the picture and stands out clearly from the ground; its height is unknown.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/slad/pictures/scene_ground.h"

namespace palace {

/// A straight piece of one, ends in W. Without a known height the ends lie on the ground seen
/// behind it.
struct ThinPiece {
  Eigen::Vector3d from_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_W = Eigen::Vector3d::Zero();
  bool height_known = true;
};

/// Nearer than this the ground's disparity changes too much within a block for paint to cancel, and
/// lines above it leave the right picture: what was found from farther away stands (flag_memory.h).
inline constexpr double kNearestThin_m = 7;

/// Whether thin structures can be told at the range most of the ground is at.
bool CanTellThinStructures(const SceneView& view, const SceneGround& ground);

/// Nothing without a ground or where they cannot be told. Pieces in a fixed order.
std::vector<ThinPiece> FindThinStructures(const SceneView& view, const SceneGround& ground);

}  // namespace palace
