// Scene: what the simulated world is made of. The renderer draws it, the laser measures it, tests
// know its truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Dense>

namespace palace {

enum class SceneShape : std::uint8_t { kBox, kCone, kCylinder, kTable };

/// A solid standing on the ground. Heights up-positive above its base.
struct SceneObject {
  SceneShape shape = SceneShape::kBox;
  double north_m = 0;
  double east_m = 0;
  double yaw_rad = 0;
  double size_north_m = 0;  ///< full size along its own x; diameter for cones and cylinders
  double size_east_m = 0;
  double height_m = 0;
  float grey = 0.6f;  ///< albedo 0..1
};

/// Ground: a plane through the origin with a slope, plus named texture.
struct Scene {
  std::string name;
  std::uint64_t texture_seed = 1;
  double slope_north_rad = 0;  ///< positive: ground rises to the north
  double slope_east_rad = 0;
  double sun_azimuth_rad = 2.4;
  double sun_elevation_rad = 0.9;
  bool runway_markings = true;
  std::vector<SceneObject> objects;

  /// Height of the bare ground, metres above the origin of W, up-positive.
  double GroundHeight(double north_m, double east_m) const;
  /// Horizontal distance from the point to the nearest object's edge; infinity without objects.
  double ObstacleDistance(double north_m, double east_m) const;
};

}  // namespace palace
