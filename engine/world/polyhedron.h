// Convex polyhedra as intersections of half-spaces: shapes of any outline.
#pragma once

#include <vector>

#include <Eigen/Dense>

namespace palace {

/// Points p with normal . p <= offset.
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;
};

/// The points inside all faces. Made by MakePolyhedron, which knows its corners.
struct Polyhedron {
  std::vector<HalfSpace> faces;
  std::vector<Eigen::Vector3d> corners{};  ///< empty: unknown, it may be anywhere
};

/// The bounded intersection of half-spaces, with its corners.
Polyhedron MakePolyhedron(std::vector<HalfSpace> faces);
/// The corners on one face, in order around its normal.
std::vector<Eigen::Vector3d> CornersAround(const Polyhedron& polyhedron, const HalfSpace& face);

}  // namespace palace
