// TriangleMesh: a shape of any form, as triangles; what cannot be said by the simple shapes.
//
// In the frame O of a shape (shapes.h): z down. Open meshes are met from both sides; what stands on
// the ground should reach a little below its foot.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
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
  /// The same for a ray of a beam, that asks only what the beam may meet: Within(beam).
  Meeting Cast(std::span<const std::uint32_t> within, const Eigen::Vector3d& p_O,
               const Eigen::Vector3d& r_O,
               double nearest = std::numeric_limits<double>::infinity()) const;
  BoxTree::Branches Within(const Beam& beam_O) const { return tree_.Within(beam_O); }
  std::span<const std::uint32_t> Whole() const { return tree_.Whole(); }
  /// Whether the ray meets any triangle, s >= 0.
  bool Meets(const Eigen::Vector3d& p_O, const Eigen::Vector3d& r_O) const;
  /// Unit normal of a triangle, by the right-hand rule of its corners.
  Eigen::Vector3d Normal(std::uint32_t triangle) const;

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<Corners>& triangles() const { return triangles_; }

 private:
  /// A triangle as rays meet it: a corner and the edges from there.
  struct Face {
    Eigen::Vector3d a, ab, ac;
    std::uint32_t triangle;
    double Meet(const Eigen::Vector3d& p, const Eigen::Vector3d& r) const;
  };

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Corners> triangles_;
  BoxTree tree_;
  std::vector<Face> faces_;  ///< in the tree's order
};

}  // namespace palace
