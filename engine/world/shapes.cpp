#include "engine/world/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palace {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---- boxes and tables ----

struct Extent {
  double x_m, y_m, height_m;
};

/// Slab method (Kay & Kajiya 1986).
double EnterExtent(const Extent& size, const Vector3d& p, const Vector3d& r) {
  const Vector3d low(-size.x_m / 2, -size.y_m / 2, -size.height_m);
  const Vector3d high(size.x_m / 2, size.y_m / 2, 0);
  double enter = 0, leave = kInfinity;
  for (int i = 0; i < 3; ++i) {
    if (r[i] == 0) {
      if (p[i] < low[i] || p[i] > high[i]) {
        return kInfinity;
      }
      continue;
    }
    const double s1 = (low[i] - p[i]) / r[i], s2 = (high[i] - p[i]) / r[i];
    enter = std::max(enter, std::min(s1, s2));
    leave = std::min(leave, std::max(s1, s2));
  }
  return enter <= leave ? enter : kInfinity;
}

double TopOfExtent(const Extent& size, double x_m, double y_m) {
  return std::abs(x_m) <= size.x_m / 2 && std::abs(y_m) <= size.y_m / 2 ? size.height_m
                                                                        : -kInfinity;
}

double DistanceToExtent(const Extent& size, double x_m, double y_m) {
  const double x = std::abs(x_m) - size.x_m / 2, y = std::abs(y_m) - size.y_m / 2;
  return std::hypot(std::max(x, 0.0), std::max(y, 0.0));
}

std::vector<Vector3d> CornersOfExtent(const Extent& size) {
  std::vector<Vector3d> corners;
  for (const double x : {-size.x_m / 2, size.x_m / 2}) {
    for (const double y : {-size.y_m / 2, size.y_m / 2}) {
      for (const double z : {-size.height_m, 0.0}) {
        corners.emplace_back(x, y, z);
      }
    }
  }
  return corners;
}

Extent ExtentOf(const Box& box) { return {box.size_x_m, box.size_y_m, box.height_m}; }
Extent ExtentOf(const Table& table) { return {table.size_x_m, table.size_y_m, table.height_m}; }

// ---- cones and cylinders: x^2 + y^2 = (reach - narrowing up)^2, up = -z ----

/// Nearest root s >= 0 of a s^2 + 2 b s + c for which the height lies in [0, top].
double FirstRootInside(double a, double b, double c, double up, double climb, double top) {
  const double discriminant = b * b - a * c;
  if (discriminant < 0 || std::abs(a) < 1e-12) {
    return kInfinity;
  }
  const double root = std::sqrt(discriminant);
  double nearest = kInfinity;
  for (const double s : {(-b - root) / a, (-b + root) / a}) {
    const double height = up + s * climb;
    if (s >= 0 && height >= 0 && height <= top) {
      nearest = std::min(nearest, s);
    }
  }
  return nearest;
}

double EnterWall(double radius_m, double narrowing, double height_m, const Vector3d& p,
                 const Vector3d& r) {
  const double up = -p.z(), climb = -r.z();
  const double reach = radius_m - narrowing * up;  // radius at the height of p
  const double slope = -narrowing * climb;         // its change along the ray
  const double a = r.x() * r.x() + r.y() * r.y() - slope * slope;
  const double b = p.x() * r.x() + p.y() * r.y() - reach * slope;
  const double c = p.x() * p.x() + p.y() * p.y() - reach * reach;
  return FirstRootInside(a, b, c, up, climb, height_m);
}

// ---- the five functions, shape by shape ----

double EnterShape(const Box& box, const Vector3d& p, const Vector3d& r) {
  return EnterExtent(ExtentOf(box), p, r);
}
double EnterShape(const Table& table, const Vector3d& p, const Vector3d& r) {
  return EnterExtent(ExtentOf(table), p, r);
}
double EnterShape(const Cone& cone, const Vector3d& p, const Vector3d& r) {
  const double radius_m = cone.diameter_m / 2;
  return EnterWall(radius_m, radius_m / cone.height_m, cone.height_m, p, r);
}
double EnterShape(const Cylinder& cylinder, const Vector3d& p, const Vector3d& r) {
  const double radius_m = cylinder.diameter_m / 2;
  double nearest = EnterWall(radius_m, 0, cylinder.height_m, p, r);
  if (r.z() > 0) {  // the lid
    const double s = (-cylinder.height_m - p.z()) / r.z();
    if (s >= 0 && (p + s * r).head<2>().norm() <= radius_m) {
      nearest = std::min(nearest, s);
    }
  }
  return nearest;
}
/// Cyrus & Beck 1978.
double EnterShape(const Polyhedron& polyhedron, const Vector3d& p, const Vector3d& r) {
  double enter = 0;
  double leave = kInfinity;
  for (const HalfSpace& face : polyhedron.faces) {
    const double outside = face.normal.dot(p) - face.offset;
    const double rate = face.normal.dot(r);
    if (rate < 0) {
      enter = std::max(enter, -outside / rate);
    } else if (rate > 0) {
      leave = std::min(leave, -outside / rate);
    } else if (outside > 0) {
      return kInfinity;
    }
    if (enter >= leave) {
      return kInfinity;
    }
  }
  return enter;
}

double EnterShape(const Mesh& mesh, const Vector3d& p, const Vector3d& r) {
  return mesh.triangles->Cast(p, r).s;
}

double TopOf(const Box& box, double x_m, double y_m) {
  return TopOfExtent(ExtentOf(box), x_m, y_m);
}
double TopOf(const Table& table, double x_m, double y_m) {
  return TopOfExtent(ExtentOf(table), x_m, y_m);
}
double TopOf(const Cone& cone, double x_m, double y_m) {
  const double share = std::hypot(x_m, y_m) / (cone.diameter_m / 2);
  return share <= 1 ? cone.height_m * (1 - share) : -kInfinity;
}
double TopOf(const Cylinder& cylinder, double x_m, double y_m) {
  return std::hypot(x_m, y_m) <= cylinder.diameter_m / 2 ? cylinder.height_m : -kInfinity;
}
double TopOf(const Polyhedron& polyhedron, double x_m, double y_m) {
  constexpr double kAbove_m = 1000;
  return kAbove_m - EnterShape(polyhedron, {x_m, y_m, -kAbove_m}, Vector3d::UnitZ());
}

double TopOf(const Mesh& mesh, double x_m, double y_m) {
  constexpr double kAbove_m = 1000;
  return kAbove_m - EnterShape(mesh, {x_m, y_m, -kAbove_m}, Vector3d::UnitZ());
}

double DistanceTo(const Box& box, double x_m, double y_m) {
  return DistanceToExtent(ExtentOf(box), x_m, y_m);
}
double DistanceTo(const Table& table, double x_m, double y_m) {
  return DistanceToExtent(ExtentOf(table), x_m, y_m);
}
double DistanceTo(const Cone& cone, double x_m, double y_m) {
  return std::max(0.0, std::hypot(x_m, y_m) - cone.diameter_m / 2);
}
double DistanceTo(const Cylinder& cylinder, double x_m, double y_m) {
  return std::max(0.0, std::hypot(x_m, y_m) - cylinder.diameter_m / 2);
}

/// Corners seen from above, around their convex hull (Andrew 1979).
std::vector<Vector2d> OutlineFromAbove(const Polyhedron& polyhedron) {
  std::vector<std::pair<double, double>> points;
  for (const Vector3d& corner : polyhedron.corners) {
    points.emplace_back(corner.x(), corner.y());
  }
  std::sort(points.begin(), points.end());
  std::vector<Vector2d> outline;
  const auto turns_left = [&](const Vector2d& p) {
    const Vector2d along = outline.back() - outline[outline.size() - 2];
    const Vector2d on = p - outline.back();
    return along.x() * on.y() - along.y() * on.x() > 0;
  };
  for (const bool back : {false, true}) {
    const std::size_t kept = outline.size();
    for (const auto& [x, y] : points) {
      const Vector2d p(x, y);
      while (outline.size() >= kept + 2 && !turns_left(p)) {
        outline.pop_back();
      }
      outline.push_back(p);
    }
    outline.pop_back();
    if (!back) {
      std::reverse(points.begin(), points.end());
    }
  }
  return outline;
}

/// To a convex outline, corners in order; 0 inside.
double DistanceToOutline(const std::vector<Vector2d>& outline, const Vector2d& p) {
  double nearest = kInfinity;
  bool inside = true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d along = outline[(i + 1) % outline.size()] - a;
    const Vector2d off = p - a;
    inside = inside && along.x() * off.y() - along.y() * off.x() >= 0;
    const double length2 = std::max(along.squaredNorm(), 1e-18);
    const double s = std::clamp(off.dot(along) / length2, 0.0, 1.0);
    nearest = std::min(nearest, (off - s * along).norm());
  }
  return inside && outline.size() > 2 ? 0 : nearest;
}

double DistanceTo(const Polyhedron& polyhedron, double x_m, double y_m) {
  return DistanceToOutline(OutlineFromAbove(polyhedron), {x_m, y_m});
}
double DistanceTo(const Mesh& mesh, double x_m, double y_m) {
  const std::vector<Vector3d>& vertices = mesh.triangles->vertices();
  double nearest = kInfinity;
  for (const TriangleMesh::Corners& corners : mesh.triangles->triangles()) {
    std::vector<Vector2d> outline;
    for (const std::uint32_t corner : corners) {
      outline.emplace_back(vertices[corner].head<2>());
    }
    const Vector2d ab = outline[1] - outline[0], ac = outline[2] - outline[0];
    if (ab.x() * ac.y() - ab.y() * ac.x() < 0) {
      std::swap(outline[1], outline[2]);
    }
    nearest = std::min(nearest, DistanceToOutline(outline, {x_m, y_m}));
  }
  return nearest;
}

double RadiusOf(const Box& box) { return std::hypot(box.size_x_m, box.size_y_m) / 2; }
double RadiusOf(const Table& table) { return std::hypot(table.size_x_m, table.size_y_m) / 2; }
double RadiusOf(const Cone& cone) { return cone.diameter_m / 2; }
double RadiusOf(const Cylinder& cylinder) { return cylinder.diameter_m / 2; }
double RadiusOf(const Polyhedron& polyhedron) {
  double radius_m = polyhedron.corners.empty() ? kInfinity : 0;
  for (const Vector3d& corner : polyhedron.corners) {
    radius_m = std::max(radius_m, corner.head<2>().norm());
  }
  return radius_m;
}
double RadiusOf(const Mesh& mesh) {
  double radius_m = 0;
  for (const Vector3d& vertex : mesh.triangles->vertices()) {
    radius_m = std::max(radius_m, vertex.head<2>().norm());
  }
  return radius_m;
}

std::vector<Vector3d> BoundsOf(const Box& box) { return CornersOfExtent(ExtentOf(box)); }
std::vector<Vector3d> BoundsOf(const Table& table) { return CornersOfExtent(ExtentOf(table)); }
std::vector<Vector3d> BoundsOf(const Cone& cone) {
  return CornersOfExtent({cone.diameter_m, cone.diameter_m, cone.height_m});
}
std::vector<Vector3d> BoundsOf(const Cylinder& cylinder) {
  return CornersOfExtent({cylinder.diameter_m, cylinder.diameter_m, cylinder.height_m});
}
std::vector<Vector3d> BoundsOf(const Polyhedron& polyhedron) { return polyhedron.corners; }
std::vector<Vector3d> BoundsOf(const Mesh& mesh) { return mesh.triangles->vertices(); }

}  // namespace

double Enter(const Shape& shape, const Vector3d& p_O, const Vector3d& r_O) {
  return std::visit([&](const auto& one) { return EnterShape(one, p_O, r_O); }, shape);
}

double TopHeight(const Shape& shape, double x_m, double y_m) {
  return std::visit([&](const auto& one) { return TopOf(one, x_m, y_m); }, shape);
}

double DistanceFromAbove(const Shape& shape, double x_m, double y_m) {
  return std::visit([&](const auto& one) { return DistanceTo(one, x_m, y_m); }, shape);
}

double FootRadius(const Shape& shape) {
  return std::visit([](const auto& one) { return RadiusOf(one); }, shape);
}

std::vector<Vector3d> Bounds(const Shape& shape) {
  return std::visit([](const auto& one) { return BoundsOf(one); }, shape);
}

}  // namespace palace
