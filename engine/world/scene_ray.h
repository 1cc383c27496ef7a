// Rays and heights in a scene: what the laser hits and what the skids touch.
// Objects are solids that stand on the ground at their centre: boxes and tables are oriented
// prisms, cones and cylinders are upright.
#pragma once

#include "engine/world/scene.h"

namespace palace {

/// Distance from origin_W along the unit direction to the first surface, metres; NaN when nothing
/// is hit within max_range_m.
double CastRay(const Scene& scene, const Eigen::Vector3d& origin_W,
               const Eigen::Vector3d& direction_W, double max_range_m);

/// Height of whatever is on top at that place, metres above the origin of W, up-positive.
double SurfaceHeight(const Scene& scene, double north_m, double east_m);

}  // namespace palace
