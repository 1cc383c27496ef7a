// PictureTile: a camera of any lens family, drawn by one that knows ideal pinholes only.
//
// The picture is cut into tiles. Each is drawn by a pinhole that looks along the tile's middle ray,
// is as fine as the lens at its finest there, and covers the tile; the lens then picks each of its
// pixels from that drawing (cubic). A tile spans at most 70 degrees, so that a fisheye is drawn by
// several. Rows of one tile can be drawn for a moment of their own: a rolling shutter.
//
// Rays are taken to start at the lens's projection centre: where a CAHVORE pupil moves by d, points
// at range r are off by f d / r pixels, as they are in rectification.
#pragma once

#include <vector>

#include "engine/model/image.h"
#include "engine/model/rig.h"

namespace palace {

struct PictureTile {
  int x = 0, y = 0, width = 0, height = 0;             ///< its place in the picture
  PinholeCamera camera;                                ///< that draws it
  Eigen::Matrix3d R_CT = Eigen::Matrix3d::Identity();  ///< its axes in the camera's own
  /// Where each pixel of the tile lies in the drawing; empty: the drawing is the tile.
  ImageF from_x, from_y;
};

/// Tiles of at most 1 / `bands` of the rows each, which cover the picture. Pixels of a lens that no
/// ray reaches come from nowhere: they are 0. A pinhole in one band is one tile, itself.
std::vector<PictureTile> TilesOf(const RigCamera& camera, int bands);

/// What the lens sees of the drawing of its tile.
ImageF ThroughLens(const PictureTile& tile, ImageF drawing);

}  // namespace palace
