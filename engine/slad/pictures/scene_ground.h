// The ground behind thin things: disparity of the surface without what is narrow, a value a block
// of 4 x 4 pixels, and the right picture laid over the left one with it.
//
// Where the two pictures then agree is ground, painted lines and cracks included; what stands above
// it differs. Raw block disparities are means of what stereo measured; a grey-scale opening 5
// blocks wide (erosion, then dilation) drops narrow things that are nearer; the disparity is the
// mean of the raw values within a pixel of it.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/model/image.h"
#include "engine/model/range_map.h"

namespace palace {

/// One rectified pair and the range map made of it, with its pose. All pictures have one size.
struct SceneView {
  std::shared_ptr<const ImageU8> left;
  std::shared_ptr<const ImageU8> right;
  std::shared_ptr<const RangeMap> range;
  /// From where navigation says the camera was to where the map's registration laid it, in W:
  /// views are compared with each other, and what their poses err by is told from what moved.
  RigidTransform registered{};

  RigidTransform X_WC() const { return registered * range->pose->X_WC; }
};

inline constexpr int kBlock_px = 4;
/// Blocks at the picture's rim of which nothing is said: the windows of five blocks, and stereo's,
/// are cut there.
inline constexpr int kRim_blocks = 2;

/// Block (i, j) covers pixels 4i..4i+3, 4j..4j+3; pixels beyond the last whole block have none.
struct SceneGround {
  ImageF measured_px;   ///< mean disparity of what stereo measured in the block; NaN when nothing
  ImageF known_share;   ///< of the block's sampled pixels with a disparity, 0..1
  ImageF disparity_px;  ///< of the surface behind thin things; filled from the nearest known block
  ImageU8 usable;       ///< 1: seen by both cameras, and no depth edge beside it
  ImageU8 right;        ///< the right picture over the left one, size of the left picture

  int cols() const { return disparity_px.width(); }
  int rows() const { return disparity_px.height(); }
  bool empty() const { return disparity_px.empty(); }
};

/// Empty when pictures, ranges or their pose are missing, differ in size, are too small or nothing
/// is known.
SceneGround FindSceneGround(const SceneView& view);

/// The point at a pixel of the rectified left picture with this disparity, in W.
Eigen::Vector3d PointAt(const SceneView& view, double x_px, double y_px, double disparity_px);

}  // namespace palace
