// GroundPicture: the lit ground seen from straight above, the same for both renderers.
//
//   grey = 255 * albedo(place) * (diffuse + direct * max(0, n . s) * [s not hidden])
//
// with the normal n of the ground there and the direction s to the sun. What stands still throws
// its shadow here; what moves throws its own when a picture is drawn. Beyond its square the picture
// goes on mirrored, as the relief does.
#pragma once

#include <cstdint>
#include <functional>

#include <Eigen/Dense>

#include "engine/model/image.h"
#include "engine/world/world.h"

namespace palace {

/// Where a ground's picture, and its relief, repeat mirrored.
struct GroundSquare {
  double north_m = 0, east_m = 0;  ///< south-west corner
  double size_m = 0;
};
/// The relief's; without relief one as large as pictures from 30 m need.
GroundSquare SquareOf(const Ground& ground);

class GroundPicture {
 public:
  /// `lit`: whether the sun reaches a point a little above the ground; points of W. Rows at once on
  /// several threads. The world's ground has a material.
  GroundPicture(const World& world, double texel_m,
                const std::function<bool(const Eigen::Vector3d& p_W)>& lit);

  /// Level 0..255 at a place, bilinear between texels.
  double Grey(double north_m, double east_m) const;
  /// The share of that level which the sky alone would give: what is left in a shadow.
  double ShareInShadow(double north_m, double east_m) const;

  const GroundSquare& square() const { return square_; }
  /// Texel (x, y): y * texel to the north, x * texel to the east.
  const ImageU8& texels() const { return texels_; }

 private:
  Ground ground_;
  Sun sun_;
  GroundSquare square_;
  double per_texel_;  ///< texels a metre
  ImageU8 texels_;
};

/// Light on a surface of that unit normal, of what makes grey 255 of albedo 1.
double LightOn(const Sun& sun, const Eigen::Vector3d& normal_W, bool lit);

}  // namespace palace
