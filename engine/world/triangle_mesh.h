// TriangleMesh: a shape of any form, as triangles; what cannot be said by the simple shapes.
//
// In the frame O of a shape (shapes.h): z down. Open meshes are met from both sides; what stands on
// the ground should reach a little below its foot.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "engine/world/box_tree.h"

namespace palace {

class TriangleMesh {
 public:
  using Corners = std::array<std::uint32_t, 3>;
  /// Every index names a vertex; PALACE_CHECK.
  TriangleMesh(std::vector<Eigen::Vector3d> vertices, std::vector<Corners> triangles);

  struct Meeting {
    double s = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;
  };
  /// The first triangle on the ray p + s r, 0 <= s < nearest (Moeller and Trumbore 1997).
  Meeting Cast(const Eigen::Vector3d& p_O, const Eigen::Vector3d& r_O,
               double nearest = std::numeric_limits<double>::infinity()) const;
  /// Unit normal of a triangle, by the right-hand rule of its corners.
  Eigen::Vector3d Normal(std::uint32_t triangle) const;

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<Corners>& triangles() const { return triangles_; }

 private:
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Corners> triangles_;
  BoxTree tree_;
};

}  // namespace palace
