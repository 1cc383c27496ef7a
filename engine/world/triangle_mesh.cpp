#include "engine/world/triangle_mesh.h"

#include <cmath>
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
  faces_.reserve(triangles_.size());
  for (const std::uint32_t triangle : tree_.items()) {
    const Corners& corners = triangles_[triangle];
    const Vector3d& a = vertices_[corners[0]];
    faces_.push_back({a, vertices_[corners[1]] - a, vertices_[corners[2]] - a, triangle});
  }
}

/// Where the ray meets it, s >= 0; infinity where it does not.
double TriangleMesh::Face::Meet(const Vector3d& p, const Vector3d& r) const {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  const Vector3d h = r.cross(ac);
  const double volume = ab.dot(h);
  if (volume == 0) {
    return kNowhere;
  }
  const Vector3d ap = p - a;
  const double u = ap.dot(h) / volume;
  if (!(u >= 0 && u <= 1)) {
    return kNowhere;
  }
  const Vector3d q = ap.cross(ab);
  const double v = r.dot(q) / volume;
  if (!(v >= 0 && u + v <= 1)) {
    return kNowhere;
  }
  const double s = ac.dot(q) / volume;
  return s >= 0 ? s : kNowhere;
}

TriangleMesh::Meeting TriangleMesh::Cast(const Vector3d& p_O, const Vector3d& r_O,
                                         double nearest) const {
  return Cast(tree_.Whole(), p_O, r_O, nearest);
}

TriangleMesh::Meeting TriangleMesh::Cast(std::span<const std::uint32_t> within, const Vector3d& p_O,
                                         const Vector3d& r_O, double nearest) const {
  Meeting first{nearest, 0};
  tree_.Walk(within, p_O, r_O, first.s, [&](std::uint32_t place) {
    const Face& face = faces_[place];
    const double s = face.Meet(p_O, r_O);
    if (s < first.s) {
      first = {s, face.triangle};
    }
    return first.s;
  });
  return first.s < nearest ? first : Meeting{};
}

bool TriangleMesh::Meets(const Vector3d& p_O, const Vector3d& r_O) const {
  return tree_.Any(
      p_O, r_O, [&](std::uint32_t place) { return std::isfinite(faces_[place].Meet(p_O, r_O)); });
}

Vector3d TriangleMesh::Normal(std::uint32_t triangle) const {
  const Corners& corners = triangles_[triangle];
  const Vector3d& a = vertices_[corners[0]];
  return (vertices_[corners[1]] - a).cross(vertices_[corners[2]] - a).normalized();
}

}  // namespace palace
