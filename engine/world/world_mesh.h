// World mesh: triangles of a world's solids and of the shadows they throw, for renderers that draw
// triangles.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/world/world.h"

namespace palace {

struct MeshVertex {
  Eigen::Vector3f position_W;
  Eigen::Vector3f normal_W;
  Eigen::Vector2f surface_m;  ///< place on the surface, metres, for its grain
  float albedo = 0;
};

/// Of solids without paint, in renderers of material ground.
inline constexpr float kGroundAlbedo = 0.42F;

/// Triangles, three vertices each. A solid reaches below its foot as far as the slope of the ground
/// needs; a polyhedron does not, it has no foot. A table is a top on a darker body set in by a
/// tenth. Solids without paint have the albedo given.
std::vector<MeshVertex> SolidTriangles(const World& world, float ground_albedo);
/// The same triangles pushed onto the ground along the sunlight. Empty when the sun is below 3
/// degrees over the ground.
std::vector<Eigen::Vector3f> ShadowTriangles(const World& world,
                                             const std::vector<MeshVertex>& triangles);

}  // namespace palace
