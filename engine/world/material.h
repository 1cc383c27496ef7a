// Materials of the simulated ground, and where they lie.
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "engine/world/ground_texture.h"

namespace palace {

/// What a surface looks like from above, before light falls on it.
struct Material {
  GroundTexture texture = GroundTexture::kCloud;
  std::uint64_t seed = 7;
  double albedo = std::numeric_limits<double>::quiet_NaN();  ///< mean, 0..1; NaN: the texture's own
  double contrast = 1;                                       ///< of the texture about its mean
  double scale = 1;                                          ///< a texture twice as coarse: 2
  double turn_rad = 0;                                       ///< of the texture, north towards east
};

/// A part of the ground of another material: inside a polygon seen from above, flat on the ground.
/// Later ones cover earlier ones.
struct GroundPatch {
  std::vector<Eigen::Vector2d> outline_m;  ///< (north, east), at least three corners, either way
  Material material;
  bool Contains(double north_m, double east_m) const;
};
GroundPatch DiscPatch(double north_m, double east_m, double radius_m, const Material& material);
/// A strip between two places, as lines are painted.
GroundPatch StripPatch(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, double width_m,
                       const Material& material);

/// Albedo of materials by place; as GroundPainter quick where each place lies close to the last.
class MaterialPainter {
 public:
  explicit MaterialPainter(const Material& material);
  double Albedo(double north_m, double east_m);

 private:
  Material material_;
  GroundPainter painter_;
  double cos_, sin_;
};

/// Mean grey of the texture as it comes.
double MeanGrey(GroundTexture texture);

}  // namespace palace
