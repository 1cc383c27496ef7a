// GroundPicture: the lit ground seen from straight above, the same for both renderers.
//
//   grey = 255 * albedo(place) * (diffuse + direct * max(0, n . s) * [s not hidden])
//
// with the normal n of the ground there and the direction s to the sun. What stands still throws
// its shadow here; what moves throws its own when a picture is drawn. Beyond its square the picture
// goes on mirrored, as the relief does.
//
// Texels are worked out where they are asked for, a tile at a time, each once: a camera near the
// ground sees a small part of the square. Any number of threads may ask at once.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

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
  /// `lit`: whether the sun reaches a point a little above the ground; points of W. It is asked as
  /// long as the picture lives, by several threads. The world's ground has a material.
  GroundPicture(const World& world, double texel_m,
                std::function<bool(const Eigen::Vector3d& p_W)> lit);
  ~GroundPicture();
  GroundPicture(const GroundPicture&) = delete;
  GroundPicture& operator=(const GroundPicture&) = delete;

  /// Level 0..255 at a place, bilinear between texels.
  double Grey(double north_m, double east_m) const;
  /// The share of that level which the sky alone would give: what is left in a shadow.
  double ShareInShadow(double north_m, double east_m) const;

  const GroundSquare& square() const { return square_; }
  /// Texel (x, y): y * texel to the north, x * texel to the east. What is missing is worked out on
  /// several threads: seconds for large grounds.
  ImageU8 Texels() const;

 private:
  static constexpr int kTile = 32;  ///< texels a side
  using Tile = std::array<std::uint8_t, std::size_t{kTile} * kTile>;
  static std::size_t Within(int x, int y) {
    return static_cast<std::size_t>(y % kTile * kTile + x % kTile);
  }
  int TileOf(int x, int y) const { return y / kTile * tiles_a_side_ + x / kTile; }
  const Tile& TileAt(int index) const;
  std::uint8_t Texel(int x, int y) const { return TileAt(TileOf(x, y))[Within(x, y)]; }
  Tile Draw(int index) const;

  Ground ground_;
  Sun sun_;
  Eigen::Vector3d sun_W_;  ///< towards it
  std::function<bool(const Eigen::Vector3d&)> lit_;
  GroundSquare square_;
  int side_;  ///< texels
  int tiles_a_side_;
  double per_texel_;  ///< texels a metre
  /// Null until asked for. Two threads may draw one at once: the same, and the first one's is kept.
  mutable std::vector<std::atomic<const Tile*>> tiles_;
};

/// Light on a surface, of what makes grey 255 of albedo 1: diffuse + direct * max(0, n . s), with
/// n . s = 0 in a shadow.
double LightOn(const Sun& sun, double normal_dot_sun);
double LightOn(const Sun& sun, const Eigen::Vector3d& normal_W, bool lit);

}  // namespace palace
