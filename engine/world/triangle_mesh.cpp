#include "engine/world/triangle_mesh.h"

#include <utility>

#include "engine/core/check.h"

namespace palace {

using Eigen::Vector3d;

TriangleMesh::TriangleMesh(std::vector<Vector3d> vertices, std::vector<Corners> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(triangles_.size());
  for (const Corners& corners : triangles_) {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t corner : corners) {
      PALACE_CHECK(corner < vertices_.size(), corner, vertices_.size());
      box.extend(vertices_[corner]);
    }
    boxes.push_back(box);
  }
  tree_ = BoxTree(boxes);
}

TriangleMesh::Meeting TriangleMesh::Cast(const Vector3d& p_O, const Vector3d& r_O,
                                         double nearest) const {
  Meeting first{nearest, 0};
  tree_.Walk(p_O, r_O, first.s, [&](std::uint32_t triangle) {
    const Corners& corners = triangles_[triangle];
    const Vector3d& a = vertices_[corners[0]];
    const Vector3d ab = vertices_[corners[1]] - a, ac = vertices_[corners[2]] - a;
    const Vector3d h = r_O.cross(ac);
    const double volume = ab.dot(h);
    if (volume == 0) {
      return first.s;
    }
    const Vector3d ap = p_O - a;
    const double u = ap.dot(h) / volume;
    const Vector3d q = ap.cross(ab);
    const double v = r_O.dot(q) / volume;
    const double s = ac.dot(q) / volume;
    if (u >= 0 && v >= 0 && u + v <= 1 && s >= 0 && s < first.s) {
      first = {s, triangle};
    }
    return first.s;
  });
  return first.s < nearest ? first : Meeting{};
}

Vector3d TriangleMesh::Normal(std::uint32_t triangle) const {
  const Corners& corners = triangles_[triangle];
  const Vector3d& a = vertices_[corners[0]];
  return (vertices_[corners[1]] - a).cross(vertices_[corners[2]] - a).normalized();
}

}  // namespace palace
