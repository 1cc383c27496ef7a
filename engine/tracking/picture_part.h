// Parts cut from a picture, each way once: windows that are searched, templates that are sought,
// patches seen from another view.
#pragma once

#include <Eigen/Dense>

#include "engine/model/image.h"

namespace palace {

/// Whole pixels from a picture; `corner` is its top-left in it.
struct PictureWindow {
  ImageU8 picture;
  Eigen::Vector2i corner = Eigen::Vector2i::Zero();
};

/// All that lies within `reach` pixels of the pixel nearest to `middle`, by row and by column; it
/// ends at the picture's edge, and is empty where it lies outside.
PictureWindow CutWindow(const ImageU8& picture, const Eigen::Vector2d& middle, int reach);

/// Square of `side` around a place between pixels; beyond the picture the edge is repeated.
ImageU8 CutSquare(const ImageU8& picture, const Eigen::Vector2d& centre, int side);

/// What a view, of which the source is known under a homography, shows in a square of `side` around
/// its pixel `centre`; bilinear, beyond the source the edge is repeated.
ImageU8 WarpedSquare(const ImageU8& source, const Eigen::Matrix3d& source_from_view,
                     const Eigen::Vector2d& centre, int side);

}  // namespace palace
