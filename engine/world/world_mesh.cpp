#include "engine/world/world_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palace {
namespace {

constexpr int kSegments = 40;
constexpr float kWhiteStripe = 0.92F;

/// Of the box about the shape, from above: a little more than a round shape's radius, so that its
/// foot lies under the ground all round.
double FarthestCorner(const Shape& shape) {
  double farthest_m = 0;
  for (const Eigen::Vector3d& corner : Bounds(shape)) {
    farthest_m = std::max(farthest_m, std::hypot(corner.x(), corner.y()));
  }
  return farthest_m;
}

/// How far the relief about a solid falls below that under its middle.
double ReliefUnder(const Ground& ground, const Solid& solid) {
  if (!ground.relief) {
    return 0;
  }
  const Eigen::Vector3d& p = solid.X_WO.p;
  const double middle_m = ground.relief->Height(p.x(), p.y());
  const double reach_m = FarthestCorner(solid.shape);
  double deepest_m = 0;
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * std::numbers::pi * i / 24;
    const double there_m =
        ground.relief->Height(p.x() + reach_m * std::cos(angle), p.y() + reach_m * std::sin(angle));
    deepest_m = std::max(deepest_m, middle_m - there_m);
  }
  return deepest_m;
}

/// One solid's own frame, but with z up: x, y along its sides, origin in the middle of its foot.
class MeshBuilder {
 public:
  MeshBuilder(const World& world, const Solid& solid, float albedo, std::vector<MeshVertex>& out)
      : out_(out),
        X_WO_(solid.X_WO),
        albedo_(albedo),
        // Each solid shows another part of the grain.
        shift_m_(static_cast<float>(3.7 * solid.X_WO.p.x() + 11.3),
                 static_cast<float>(5.1 * solid.X_WO.p.y() + 7.9)),
        sunk_m_(std::hypot(world.ground.rise_north, world.ground.rise_east) *
                    FarthestCorner(solid.shape) +
                ReliefUnder(world.ground, solid)) {}
  float albedo() const { return albedo_; }
  double sunk_m() const { return sunk_m_; }

  void Box(double size_x, double size_y, double bottom, double top, float top_albedo,
           float side_albedo) {
    const double x = size_x / 2, y = size_y / 2;
    Face({-x, -y, top}, {2 * x, 0, 0}, {0, 2 * y, 0}, {0, 0, 1}, top_albedo);
    Face({x, -y, bottom}, {0, 2 * y, 0}, {0, 0, top - bottom}, {1, 0, 0}, side_albedo);
    Face({-x, -y, bottom}, {0, 2 * y, 0}, {0, 0, top - bottom}, {-1, 0, 0}, side_albedo);
    Face({-x, y, bottom}, {2 * x, 0, 0}, {0, 0, top - bottom}, {0, 1, 0}, side_albedo);
    Face({-x, -y, bottom}, {2 * x, 0, 0}, {0, 0, top - bottom}, {0, -1, 0}, side_albedo);
  }

  /// A band of a round solid between two heights.
  void Band(double radius_low, double radius_high, double low, double high, float albedo) {
    const double rise = radius_low - radius_high, run = high - low;
    const double length = std::max(std::hypot(rise, run), 1e-9);
    for (int i = 0; i < kSegments; ++i) {
      const double a = 2 * std::numbers::pi * i / kSegments;
      const double b = 2 * std::numbers::pi * (i + 1) / kSegments;
      MeshVertex corners[4];
      for (int k = 0; k < 4; ++k) {
        const double angle = (k == 0 || k == 3) ? a : b;
        const bool upper = k >= 2;
        const double radius = upper ? radius_high : radius_low;
        corners[k] =
            Vertex({radius * std::cos(angle), radius * std::sin(angle), upper ? high : low},
                   {run / length * std::cos(angle), run / length * std::sin(angle), rise / length},
                   {angle * std::max(radius_low, radius_high), upper ? high : low}, albedo);
      }
      Quad(corners);
    }
  }

  void Disc(double radius, double height, float albedo) {
    for (int i = 0; i < kSegments; ++i) {
      const double a = 2 * std::numbers::pi * i / kSegments;
      const double b = 2 * std::numbers::pi * (i + 1) / kSegments;
      const Eigen::Vector3d rim_a(radius * std::cos(a), radius * std::sin(a), height);
      const Eigen::Vector3d rim_b(radius * std::cos(b), radius * std::sin(b), height);
      const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
      out_.push_back(Vertex({0, 0, height}, up, {0, 0}, albedo));
      out_.push_back(Vertex(rim_a, up, rim_a.head<2>(), albedo));
      out_.push_back(Vertex(rim_b, up, rim_b.head<2>(), albedo));
    }
  }

  /// A flat face; corners in order around it.
  void Polygon(const std::vector<Eigen::Vector3d>& corners, const Eigen::Vector3d& normal,
               float albedo) {
    const Eigen::Vector3d along = normal.unitOrthogonal(), aside = normal.cross(along);
    const auto vertex = [&](const Eigen::Vector3d& corner) {
      return Vertex(corner, normal, {along.dot(corner), aside.dot(corner)}, albedo);
    };
    for (std::size_t k = 2; k < corners.size(); ++k) {
      out_.push_back(vertex(corners[0]));
      out_.push_back(vertex(corners[k - 1]));
      out_.push_back(vertex(corners[k]));
    }
  }

 private:
  void Face(const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
            const Eigen::Vector3d& normal, float albedo) {
    const double lu = u.norm(), lv = v.norm();
    const MeshVertex corners[4] = {Vertex(corner, normal, {0, 0}, albedo),
                                   Vertex(corner + u, normal, {lu, 0}, albedo),
                                   Vertex(corner + u + v, normal, {lu, lv}, albedo),
                                   Vertex(corner + v, normal, {0, lv}, albedo)};
    Quad(corners);
  }

  void Quad(const MeshVertex (&corners)[4]) {
    for (const int k : {0, 1, 2, 0, 2, 3}) {
      out_.push_back(corners[k]);
    }
  }

  MeshVertex Vertex(const Eigen::Vector3d& local, const Eigen::Vector3d& normal,
                    const Eigen::Vector2d& surface_m, float albedo) const {
    const Eigen::Vector3d p = X_WO_.p + ToWorld(local);
    return {p.cast<float>(), ToWorld(normal).cast<float>(), surface_m.cast<float>() + shift_m_,
            albedo};
  }
  Eigen::Vector3d ToWorld(const Eigen::Vector3d& v) const {
    return X_WO_.R * Eigen::Vector3d(v.x(), v.y(), -v.z());
  }

  std::vector<MeshVertex>& out_;
  RigidTransform X_WO_;
  float albedo_;
  Eigen::Vector2f shift_m_;
  double sunk_m_;
};

void AddShape(const Box& box, MeshBuilder& builder) {
  builder.Box(box.size_x_m, box.size_y_m, -builder.sunk_m(), box.height_m, builder.albedo(),
              0.85F * builder.albedo());
}

void AddShape(const Table& table, MeshBuilder& builder) {
  const double slab_m = std::min(0.05, table.height_m / 2);
  const double under_m = table.height_m - slab_m;
  builder.Box(table.size_x_m, table.size_y_m, under_m, table.height_m, builder.albedo(),
              0.8F * builder.albedo());
  builder.Box(0.9 * table.size_x_m, 0.9 * table.size_y_m, -builder.sunk_m(), under_m,
              builder.albedo(), 0.42F * builder.albedo());
}

/// Striped as road cones are.
void AddShape(const Cone& cone, MeshBuilder& builder) {
  const double radius = cone.diameter_m / 2, height = cone.height_m;
  if (builder.sunk_m() > 0) {
    builder.Band(radius, radius, -builder.sunk_m(), 0, builder.albedo());
  }
  constexpr int kBands = 5;
  for (int i = 0; i < kBands; ++i) {
    const double low = static_cast<double>(i) / kBands, high = static_cast<double>(i + 1) / kBands;
    builder.Band(radius * (1 - low), radius * (1 - high), height * low, height * high,
                 i % 2 == 1 ? kWhiteStripe : builder.albedo());
  }
}

void AddShape(const Cylinder& cylinder, MeshBuilder& builder) {
  const double radius = cylinder.diameter_m / 2;
  builder.Band(radius, radius, -builder.sunk_m(), cylinder.height_m, 0.85F * builder.albedo());
  builder.Disc(radius, cylinder.height_m, builder.albedo());
}

/// Tops in full light's albedo, walls darker, as of boxes.
void AddShape(const Polyhedron& polyhedron, MeshBuilder& builder) {
  const auto up = [](const Eigen::Vector3d& v) { return Eigen::Vector3d(v.x(), v.y(), -v.z()); };
  for (const HalfSpace& face : polyhedron.faces) {
    std::vector<Eigen::Vector3d> corners = CornersAround(polyhedron, face);
    std::transform(corners.begin(), corners.end(), corners.begin(), up);
    const Eigen::Vector3d normal = up(face.normal.normalized());
    builder.Polygon(corners, normal, (normal.z() > 0.5 ? 1.0F : 0.85F) * builder.albedo());
  }
}

void AddShape(const Mesh& mesh, MeshBuilder& builder) {
  const auto up = [](const Eigen::Vector3d& v) { return Eigen::Vector3d(v.x(), v.y(), -v.z()); };
  const TriangleMesh& triangles = *mesh.triangles;
  for (std::uint32_t i = 0; i < triangles.triangles().size(); ++i) {
    std::vector<Eigen::Vector3d> corners;
    for (const std::uint32_t corner : triangles.triangles()[i]) {
      corners.push_back(up(triangles.vertices()[corner]));
    }
    builder.Polygon(corners, up(triangles.Normal(i)), builder.albedo());
  }
}

}  // namespace

std::vector<MeshVertex> SolidTriangles(const World& world, float ground_albedo) {
  std::vector<MeshVertex> triangles;
  for (const Solid& solid : world.solids) {
    const bool painted = !std::isnan(solid.albedo);
    MeshBuilder builder(world, solid, painted ? static_cast<float>(solid.albedo) : ground_albedo,
                        triangles);
    std::visit([&](const auto& shape) { AddShape(shape, builder); }, solid.shape);
  }
  return triangles;
}

std::vector<Eigen::Vector3f> ShadowTriangles(const World& world,
                                             const std::vector<MeshVertex>& triangles) {
  const Eigen::Vector3d normal = world.ground.Normal();
  const Eigen::Vector3d sun = world.sun.Direction();
  const double sine = normal.dot(sun);
  std::vector<Eigen::Vector3f> shadow;
  if (sine < 0.05) {
    return shadow;
  }
  shadow.reserve(triangles.size());
  for (const MeshVertex& vertex : triangles) {
    const Eigen::Vector3d p = vertex.position_W.cast<double>();
    const double height = normal.dot(p);
    // What is sunk into the ground throws no shadow: it goes straight up to the plane.
    const Eigen::Vector3d foot = height > 0 ? p - sun * (height / sine) : p - normal * height;
    shadow.push_back(foot.cast<float>());
  }
  return shadow;
}

}  // namespace palace
