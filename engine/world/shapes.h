// Shapes of the simulated world. Each lies in a frame O of its own: the origin in the middle of its
// foot, x and y along its sides, z DOWN as in W, so that tops have negative z. Metres.
//
// A shape is a struct and the five functions below. A new one is one more in `Shape`, and the
// compiler names the functions that it lacks: no other file asks which shape it has.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include <Eigen/Dense>

#include "engine/world/polyhedron.h"
#include "engine/world/triangle_mesh.h"

namespace palace {

struct Box {
  double size_x_m = 0;
  double size_y_m = 0;
  double height_m = 0;
};
/// A box to rays and skids; pictures show a top on a darker body.
struct Table {
  double size_x_m = 0;
  double size_y_m = 0;
  double height_m = 0;
};
struct Cone {
  double diameter_m = 0;  ///< of the foot; it ends in a point
  double height_m = 0;
};
struct Cylinder {
  double diameter_m = 0;
  double height_m = 0;
};
struct Mesh {
  std::shared_ptr<const TriangleMesh> triangles;
};
using Shape = std::variant<Box, Table, Cone, Cylinder, Polyhedron, Mesh>;

/// Where the ray p + s r enters the shape, the least s >= 0; infinity when it misses.
/// From inside: 0, but of cones, cylinders and meshes, which have no inside, the wall ahead.
double Enter(const Shape& shape, const Eigen::Vector3d& p_O, const Eigen::Vector3d& r_O);
/// Height of the top over a place, up-positive above the foot; -infinity beside the shape.
double TopHeight(const Shape& shape, double x_m, double y_m);
/// Horizontal distance from a place to the shape seen from above; 0 under or on it.
double DistanceFromAbove(const Shape& shape, double x_m, double y_m);
/// Radius about the origin that the shape seen from above stays within.
double FootRadius(const Shape& shape);
/// Points whose convex hull holds the shape; none when that is unknown.
std::vector<Eigen::Vector3d> Bounds(const Shape& shape);

}  // namespace palace
