#include "engine/world/polyhedron.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/check.h"

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr double kOnFace_m = 1e-7;

/// Points where three faces meet inside all others.
std::vector<Vector3d> CornersOf(const std::vector<HalfSpace>& faces) {
  std::vector<Vector3d> corners;
  for (std::size_t a = 0; a < faces.size(); ++a) {
    for (std::size_t b = a + 1; b < faces.size(); ++b) {
      const Vector3d edge = faces[a].normal.cross(faces[b].normal);
      for (std::size_t c = b + 1; c < faces.size(); ++c) {
        const double volume = edge.dot(faces[c].normal);
        if (std::abs(volume) < 1e-9) {
          continue;
        }
        const Vector3d corner =
            (faces[a].offset * faces[b].normal.cross(faces[c].normal) +
             faces[b].offset * faces[c].normal.cross(faces[a].normal) + faces[c].offset * edge) /
            volume;
        const bool known = std::any_of(corners.begin(), corners.end(), [&](const Vector3d& other) {
          return (other - corner).squaredNorm() < kOnFace_m * kOnFace_m;
        });
        if (!known && std::all_of(faces.begin(), faces.end(), [&](const HalfSpace& face) {
              return face.normal.dot(corner) <= face.offset + kOnFace_m * face.normal.norm();
            })) {
          corners.push_back(corner);
        }
      }
    }
  }
  return corners;
}

}  // namespace

Polyhedron MakePolyhedron(std::vector<HalfSpace> faces) {
  Polyhedron polyhedron{std::move(faces)};
  polyhedron.corners = CornersOf(polyhedron.faces);
  PALACE_CHECK(!polyhedron.corners.empty(), polyhedron.faces.size());
  return polyhedron;
}

std::vector<Vector3d> CornersAround(const Polyhedron& polyhedron, const HalfSpace& face) {
  const double length = face.normal.norm();
  std::vector<Vector3d> corners;
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& corner : polyhedron.corners) {
    if (std::abs(face.normal.dot(corner) - face.offset) <= 2 * kOnFace_m * length) {
      corners.push_back(corner);
      middle += corner;
    }
  }
  if (corners.size() < 3) {
    return {};
  }
  middle /= static_cast<double>(corners.size());
  const Vector3d normal = face.normal / length;
  const Vector3d first = normal.unitOrthogonal(), second = normal.cross(first);
  const auto angle = [&](const Vector3d& corner) {
    return std::atan2((corner - middle).dot(second), (corner - middle).dot(first));
  };
  std::sort(corners.begin(), corners.end(),
            [&](const Vector3d& a, const Vector3d& b) { return angle(a) < angle(b); });
  return corners;
}

}  // namespace palace
