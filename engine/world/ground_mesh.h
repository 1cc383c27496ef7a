// GroundMesh: the relief as few triangles, for renderers that draw triangles.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/world/world.h"

namespace palace {

/// Triangles of the relief's square, three corners each: (north, east, height of the relief), the
/// plane of the ground not added. Blocks of the grid whose corners lie within `tolerance_m` of the
/// block's own two triangles are drawn as these; neighbours of other size leave gaps of as much at
/// most. Without relief two triangles of the square that its GroundPicture covers.
std::vector<Eigen::Vector3f> GroundTriangles(const Ground& ground, double tolerance_m);

}  // namespace palace
