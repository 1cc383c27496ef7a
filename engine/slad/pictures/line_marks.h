// Marks from which lines are summed (line_sums.h): pixels that stand out, 0 .. kLargestMark,
// against the mean of their tile of 32 x 32 pixels, so that rough ground asks for more than smooth
// ground.
#pragma once

#include "engine/slad/pictures/scene_ground.h"

namespace palace {

/// |left - right laid over left| beyond the tile's mean difference. 0 where the ground is not
/// usable.
ImageU8 MarkDifferences(const ImageU8& left, const SceneGround& ground);
/// Half width of a ridge: what a thin line is darker, or brighter, than.
inline constexpr int kRidge_px = 3;
/// Thin lines along the rows: how much a pixel is darker, or brighter, than those kRidge_px rows
/// above and below.
ImageU8 MarkRidges(const ImageU8& left);
/// Rows become columns.
ImageU8 Transposed(const ImageU8& picture);

}  // namespace palace
