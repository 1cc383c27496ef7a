// Scene mesh: triangles of a scene's objects and of the shadows they throw.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/world/scene.h"

namespace palace {

struct SceneVertex {
  Eigen::Vector3f position_W;
  Eigen::Vector3f normal_W;
  Eigen::Vector2f surface_m;  ///< place on the surface, metres, for its grain
  float grey = 0;
};

/// Unit vector to the sun in W.
Eigen::Vector3d SunDirection(const Scene& scene);
/// Unit normal of the bare ground in W, pointing up.
Eigen::Vector3d GroundNormal(const Scene& scene);

/// Triangles, three vertices each. A solid stands vertical on the ground height at its centre and
/// reaches below it as far as the slope needs. A table is a top on a darker body set in by a tenth.
std::vector<SceneVertex> SceneTriangles(const Scene& scene);
/// The same triangles pushed onto the ground along the sunlight. Empty when the sun is below 3
/// degrees over the ground.
std::vector<Eigen::Vector3f> ShadowTriangles(const Scene& scene,
                                             const std::vector<SceneVertex>& triangles);

}  // namespace palace
