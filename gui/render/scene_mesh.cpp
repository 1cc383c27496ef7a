#include "gui/render/scene_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palace {
namespace {

constexpr int kSegments = 40;
constexpr float kWhiteStripe = 0.92F;

/// One object's own frame: x, y along its sides, z up, origin on the ground at its centre.
class SolidBuilder {
 public:
  SolidBuilder(const Scene& scene, const SceneObject& object, std::vector<SceneVertex>& out)
      : out_(out),
        base_W_(object.north_m, object.east_m, -scene.GroundHeight(object.north_m, object.east_m)),
        cos_(std::cos(object.yaw_rad)),
        sin_(std::sin(object.yaw_rad)),
        // Each solid shows another part of the grain.
        shift_m_(static_cast<float>(3.7 * object.north_m + 11.3),
                 static_cast<float>(5.1 * object.east_m + 7.9)) {
    const double steepest =
        std::hypot(std::tan(scene.slope_north_rad), std::tan(scene.slope_east_rad));
    sunk_m_ = steepest * std::hypot(object.size_north_m, object.size_east_m) / 2;
  }
  double sunk_m() const { return sunk_m_; }

  void Box(double size_x, double size_y, double bottom, double top, float top_grey,
           float side_grey) {
    const double x = size_x / 2, y = size_y / 2;
    Face({-x, -y, top}, {2 * x, 0, 0}, {0, 2 * y, 0}, {0, 0, 1}, top_grey);
    Face({x, -y, bottom}, {0, 2 * y, 0}, {0, 0, top - bottom}, {1, 0, 0}, side_grey);
    Face({-x, -y, bottom}, {0, 2 * y, 0}, {0, 0, top - bottom}, {-1, 0, 0}, side_grey);
    Face({-x, y, bottom}, {2 * x, 0, 0}, {0, 0, top - bottom}, {0, 1, 0}, side_grey);
    Face({-x, -y, bottom}, {2 * x, 0, 0}, {0, 0, top - bottom}, {0, -1, 0}, side_grey);
  }

  /// A band of a round solid between two heights.
  void Band(double radius_low, double radius_high, double low, double high, float grey) {
    const double rise = radius_low - radius_high, run = high - low;
    const double length = std::max(std::hypot(rise, run), 1e-9);
    for (int i = 0; i < kSegments; ++i) {
      const double a = 2 * std::numbers::pi * i / kSegments;
      const double b = 2 * std::numbers::pi * (i + 1) / kSegments;
      SceneVertex corners[4];
      for (int k = 0; k < 4; ++k) {
        const double angle = (k == 0 || k == 3) ? a : b;
        const bool upper = k >= 2;
        const double radius = upper ? radius_high : radius_low;
        corners[k] =
            Vertex({radius * std::cos(angle), radius * std::sin(angle), upper ? high : low},
                   {run / length * std::cos(angle), run / length * std::sin(angle), rise / length},
                   {angle * std::max(radius_low, radius_high), upper ? high : low}, grey);
      }
      Quad(corners);
    }
  }

  void Disc(double radius, double height, float grey) {
    for (int i = 0; i < kSegments; ++i) {
      const double a = 2 * std::numbers::pi * i / kSegments;
      const double b = 2 * std::numbers::pi * (i + 1) / kSegments;
      const Eigen::Vector3d rim_a(radius * std::cos(a), radius * std::sin(a), height);
      const Eigen::Vector3d rim_b(radius * std::cos(b), radius * std::sin(b), height);
      const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
      out_.push_back(Vertex({0, 0, height}, up, {0, 0}, grey));
      out_.push_back(Vertex(rim_a, up, rim_a.head<2>(), grey));
      out_.push_back(Vertex(rim_b, up, rim_b.head<2>(), grey));
    }
  }

 private:
  void Face(const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
            const Eigen::Vector3d& normal, float grey) {
    const double lu = u.norm(), lv = v.norm();
    const SceneVertex corners[4] = {
        Vertex(corner, normal, {0, 0}, grey), Vertex(corner + u, normal, {lu, 0}, grey),
        Vertex(corner + u + v, normal, {lu, lv}, grey), Vertex(corner + v, normal, {0, lv}, grey)};
    Quad(corners);
  }

  void Quad(const SceneVertex (&corners)[4]) {
    for (const int k : {0, 1, 2, 0, 2, 3}) {
      out_.push_back(corners[k]);
    }
  }

  SceneVertex Vertex(const Eigen::Vector3d& local, const Eigen::Vector3d& normal,
                     const Eigen::Vector2d& surface_m, float grey) const {
    const Eigen::Vector3d p = base_W_ + ToWorld(local);
    return {p.cast<float>(), ToWorld(normal).cast<float>(), surface_m.cast<float>() + shift_m_,
            grey};
  }
  Eigen::Vector3d ToWorld(const Eigen::Vector3d& v) const {
    return {cos_ * v.x() - sin_ * v.y(), sin_ * v.x() + cos_ * v.y(), -v.z()};
  }

  std::vector<SceneVertex>& out_;
  Eigen::Vector3d base_W_;
  double cos_, sin_;
  double sunk_m_ = 0;
  Eigen::Vector2f shift_m_;
};

void AddCone(SolidBuilder& builder, const SceneObject& object) {
  const double radius = object.size_north_m / 2, height = object.height_m;
  if (builder.sunk_m() > 0) {
    builder.Band(radius, radius, -builder.sunk_m(), 0, object.grey);
  }
  constexpr int kBands = 5;
  for (int i = 0; i < kBands; ++i) {
    const double low = static_cast<double>(i) / kBands, high = static_cast<double>(i + 1) / kBands;
    builder.Band(radius * (1 - low), radius * (1 - high), height * low, height * high,
                 i % 2 == 1 ? kWhiteStripe : object.grey);
  }
}

void AddObject(SolidBuilder& builder, const SceneObject& object) {
  const double bottom = -builder.sunk_m();
  switch (object.shape) {
    case SceneShape::kBox:
      builder.Box(object.size_north_m, object.size_east_m, bottom, object.height_m, object.grey,
                  0.85F * object.grey);
      break;
    case SceneShape::kTable: {
      const double slab_m = std::min(0.05, object.height_m / 2);
      builder.Box(object.size_north_m, object.size_east_m, object.height_m - slab_m,
                  object.height_m, object.grey, 0.8F * object.grey);
      builder.Box(0.9 * object.size_north_m, 0.9 * object.size_east_m, bottom,
                  object.height_m - slab_m, object.grey, 0.42F * object.grey);
      break;
    }
    case SceneShape::kCone:
      AddCone(builder, object);
      break;
    case SceneShape::kCylinder:
      builder.Band(object.size_north_m / 2, object.size_north_m / 2, bottom, object.height_m,
                   0.85F * object.grey);
      builder.Disc(object.size_north_m / 2, object.height_m, object.grey);
      break;
  }
}

}  // namespace

Eigen::Vector3d SunDirection(const Scene& scene) {
  return {std::cos(scene.sun_elevation_rad) * std::cos(scene.sun_azimuth_rad),
          std::cos(scene.sun_elevation_rad) * std::sin(scene.sun_azimuth_rad),
          -std::sin(scene.sun_elevation_rad)};
}

Eigen::Vector3d GroundNormal(const Scene& scene) {
  return Eigen::Vector3d(-std::tan(scene.slope_north_rad), -std::tan(scene.slope_east_rad), -1)
      .normalized();
}

std::vector<SceneVertex> SceneTriangles(const Scene& scene) {
  std::vector<SceneVertex> triangles;
  for (const SceneObject& object : scene.objects) {
    SolidBuilder builder(scene, object, triangles);
    AddObject(builder, object);
  }
  return triangles;
}

std::vector<Eigen::Vector3f> ShadowTriangles(const Scene& scene,
                                             const std::vector<SceneVertex>& triangles) {
  const Eigen::Vector3d normal = GroundNormal(scene);
  const Eigen::Vector3d sun = SunDirection(scene);
  const double sine = normal.dot(sun);
  std::vector<Eigen::Vector3f> shadow;
  if (sine < 0.05) {
    return shadow;
  }
  shadow.reserve(triangles.size());
  for (const SceneVertex& vertex : triangles) {
    const Eigen::Vector3d p = vertex.position_W.cast<double>();
    const double height = normal.dot(p);
    // What is sunk into the ground throws no shadow: it goes straight up to the plane.
    const Eigen::Vector3d foot = height > 0 ? p - sun * (height / sine) : p - normal * height;
    shadow.push_back(foot.cast<float>());
  }
  return shadow;
}

}  // namespace palace
