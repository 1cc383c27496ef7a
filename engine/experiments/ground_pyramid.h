// GroundPyramid: level ground of fine detail for a whole film, from tens of metres to a few.
//
// Squares of texels about one place, each twice as wide and as coarse as the one before (Williams
// 1983, pyramidal parametrics; nested as Tanner et al. 1998, The clipmap). Where a finer square
// lies inside a coarser one, the coarser one is its mean: a place looks the same at every level, so
// nothing that a tracker follows jumps as the camera comes nearer. BakedGround (world) serves
// pictures from about one height only.
//
// A pixel is the mean of three rays, one above the other, each read at the two levels whose texels
// are nearest to 0.6 pixels, and spread by the lens (kLensBlur_px). Light is what the material is
// from above: no sun, no shadows.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"

namespace palace {

class GroundPyramid {
 public:
  /// Grey 0..255 at a place, metres north and east.
  using GreyOfPlace = std::function<double(double north_m, double east_m)>;
  struct Extent {
    double finest_m = 0.0035;  ///< texel
    int side = 2560;           ///< texels, a multiple of 4
    int levels = 5;
  };

  /// About the origin of W, at height 0.
  GroundPyramid(const GreyOfPlace& grey, const Extent& extent);

  /// Grey on each pixel without noise. Sky is 200; beyond the coarsest square the ground is 128.
  ImageF Picture(const PinholeCamera& camera, const RigidTransform& X_WC) const;
  /// At a place, of texels about so wide.
  float Grey(float north_m, float east_m, float texel_m) const;

 private:
  struct Level {
    float texel_m = 0;
    ImageF grey;  ///< row r: (r + 0.5) texels north of the square's edge; columns likewise east
  };
  float AtLevel(std::size_t level, float north_m, float east_m) const;
  float Between(float level, float north_m, float east_m) const;

  std::vector<Level> levels_;
};

}  // namespace palace
