#include "gui/render/vehicle_model.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "shader_text.h"

namespace palace {
namespace {

constexpr int kRound = 20;
constexpr double kTurn = 2 * std::numbers::pi;

class ModelBuilder {
 public:
  std::vector<VehicleVertex> Take() { return std::move(out_); }

  void Ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii, float grey,
                 float nose_grey) {
    const auto point = [&](int i, int j) -> VehicleVertex {
      const double along = std::numbers::pi * i / kRound, round = kTurn * j / kRound;
      const Eigen::Vector3d unit(std::cos(along), std::sin(along) * std::cos(round),
                                 std::sin(along) * std::sin(round));
      const Eigen::Vector3d normal = unit.cwiseQuotient(radii).normalized();
      // The glass lies in front and above.
      const bool glass = unit.x() > 0.45 && unit.z() < 0.15;
      return {(centre + unit.cwiseProduct(radii)).cast<float>(), normal.cast<float>(),
              glass ? nose_grey : grey};
    };
    for (int i = 0; i < kRound; ++i) {
      for (int j = 0; j < kRound; ++j) {
        Quad(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
      }
    }
  }

  /// A tapered tube between two points.
  void Tube(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_from,
            double radius_to, float grey) {
    const Eigen::Vector3d axis = (to - from).normalized();
    const Eigen::Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
    const auto point = [&](const Eigen::Vector3d& centre, double radius, int j) -> VehicleVertex {
      const double round = kTurn * j / kRound;
      const Eigen::Vector3d out = std::cos(round) * u + std::sin(round) * v;
      return {(centre + radius * out).cast<float>(), out.cast<float>(), grey};
    };
    for (int j = 0; j < kRound; ++j) {
      Quad(point(from, radius_from, j), point(to, radius_to, j), point(to, radius_to, j + 1),
           point(from, radius_from, j + 1));
    }
  }

  /// A thin upright plate, seen from both sides.
  void Fin(const Eigen::Vector3d (&corners)[4], float grey) {
    const Eigen::Vector3d normal =
        (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    for (const double side : {1.0, -1.0}) {
      VehicleVertex quad[4];
      for (int k = 0; k < 4; ++k) {
        quad[k] = {(corners[k] + 0.012 * side * normal).cast<float>(),
                   Eigen::Vector3d(side * normal).cast<float>(), grey};
      }
      Quad(quad[0], quad[1], quad[2], quad[3]);
    }
  }

 private:
  void Quad(const VehicleVertex& a, const VehicleVertex& b, const VehicleVertex& c,
            const VehicleVertex& d) {
    for (const VehicleVertex& vertex : {a, b, c, a, c, d}) {
      out_.push_back(vertex);
    }
  }
  std::vector<VehicleVertex> out_;
};

constexpr float kPaint = 0.92F, kGlass = 0.30F, kMetal = 0.62F, kDark = 0.42F;

// In shares of the 1.3 m that a quadrotor with 0.9 m between opposite 15-inch propellers is wide.
constexpr double kArm = kRotorRadius_m * 0.45 / 0.65, kPropeller = kRotorRadius_m * 0.19 / 0.65;

/// Of a propeller, front right first, clockwise.
Eigen::Vector3d PropellerHub(int i) {
  const double angle = kTurn * (i + 0.5) / 4;
  return {kArm * std::cos(angle), kArm * std::sin(angle), -0.16};
}

std::vector<VehicleVertex> MultirotorTriangles() {
  ModelBuilder model;
  model.Ellipsoid({0, 0, 0}, {0.44, 0.30, 0.16}, kPaint, kGlass);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d hub = PropellerHub(i), foot(hub.x(), hub.y(), 0);
    model.Tube({0, 0, 0}, foot, 0.07, 0.05, kMetal);
    model.Tube(foot + Eigen::Vector3d(0, 0, 0.05), hub, 0.09, 0.07, kDark);
  }
  for (const double side : {-1.0, 1.0}) {
    const double y = 0.55 * side;
    model.Tube({-0.60, y, 0.62}, {0.60, y, 0.62}, 0.032, 0.032, kMetal);
    for (const double x : {-0.25, 0.25}) {
      model.Tube({x, 0.20 * side, 0.08}, {x, y, 0.62}, 0.026, 0.026, kMetal);
    }
  }
  // The camera bar under the nose.
  model.Tube({0.42, -0.7, 0.20}, {0.42, 0.7, 0.20}, 0.035, 0.035, kDark);
  return model.Take();
}

std::vector<VehicleVertex> HelicopterTriangles() {
  ModelBuilder model;
  model.Ellipsoid({0.25, 0, 0}, {0.82, 0.34, 0.38}, kPaint, kGlass);
  model.Ellipsoid({0.0, 0, -0.28}, {0.50, 0.22, 0.20}, kMetal, kMetal);
  model.Tube({-0.35, 0, -0.10}, {-1.95, 0, -0.22}, 0.15, 0.05, kPaint);
  model.Tube({0.12, 0, -0.35}, kRotorHub_B, 0.05, 0.04, kDark);
  model.Fin({{-1.72, 0, -0.20}, {-2.02, 0, -0.20}, {-2.14, 0, -0.62}, {-1.96, 0, -0.62}}, kPaint);
  model.Fin({{-1.78, 0, -0.20}, {-2.00, 0, -0.20}, {-2.02, 0, 0.06}, {-1.92, 0, 0.06}}, kPaint);
  model.Fin(
      {{-1.50, -0.32, -0.19}, {-1.68, -0.32, -0.19}, {-1.68, 0.32, -0.19}, {-1.50, 0.32, -0.19}},
      kMetal);
  for (const double side : {-1.0, 1.0}) {
    const double y = 0.42 * side;
    model.Tube({-0.62, y, 0.62}, {0.80, y, 0.62}, 0.032, 0.032, kMetal);
    model.Tube({0.80, y, 0.62}, {0.96, y, 0.52}, 0.032, 0.026, kMetal);
    for (const double x : {-0.25, 0.50}) {
      model.Tube({x, 0.20 * side, 0.26}, {x, y, 0.62}, 0.026, 0.026, kMetal);
    }
  }
  // The camera bar under the nose.
  model.Tube({0.62, -0.5, 0.34}, {0.62, 0.5, 0.34}, 0.035, 0.035, kDark);
  return model.Take();
}

}  // namespace

std::vector<VehicleVertex> VehicleTriangles(VehicleBody body) {
  return body == VehicleBody::kMultirotor ? MultirotorTriangles() : HelicopterTriangles();
}

Status VehiclePainter::Start() {
  Result<ShaderProgram> built = ShaderProgram::Build("vehicle", {shader_text::vehicle_vertex},
                                                     {shader_text::vehicle_fragment});
  if (!built) {
    return built.error();
  }
  shader_ = std::move(built).value();
  std::vector<VehicleVertex> model;
  for (const VehicleBody body : {VehicleBody::kHelicopter, VehicleBody::kMultirotor}) {
    const std::vector<VehicleVertex> triangles = VehicleTriangles(body);
    const auto i = static_cast<std::size_t>(body);
    first_[i] = static_cast<GLint>(model.size());
    count_[i] = static_cast<GLsizei>(triangles.size());
    model.insert(model.end(), triangles.begin(), triangles.end());
  }
  array_ = GlVertexArray::Create();
  buffer_ = GlBuffer::Create();
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(model.size() * sizeof(VehicleVertex)),
               model.data(), GL_STATIC_DRAW);
  const std::pair<GLint, std::size_t> attributes[] = {{3, offsetof(VehicleVertex, position_B)},
                                                      {3, offsetof(VehicleVertex, normal_B)},
                                                      {1, offsetof(VehicleVertex, grey)}};
  for (GLuint i = 0; i < 3; ++i) {
    glEnableVertexAttribArray(i);
    glVertexAttribPointer(i, attributes[i].first, GL_FLOAT, GL_FALSE, sizeof(VehicleVertex),
                          reinterpret_cast<const void*>(attributes[i].second));
  }
  return Ok();
}

void VehiclePainter::Draw(VehicleBody body, const Eigen::Matrix4d& clip_from_world,
                          const RigidTransform& X_WB, double size,
                          const Eigen::Vector3d& eye_W) const {
  Eigen::Matrix4d world_from_body = Eigen::Matrix4d::Identity();
  world_from_body.topLeftCorner<3, 3>() = size * X_WB.R;
  world_from_body.topRightCorner<3, 1>() = X_WB.p;
  shader_.Use();
  shader_.Set("clip_from_body", Eigen::Matrix4f((clip_from_world * world_from_body).cast<float>()));
  shader_.Set("world_from_body", Eigen::Matrix3f(X_WB.R.cast<float>()));
  shader_.Set("eye_direction_W", Eigen::Vector3f((eye_W - X_WB.p).normalized().cast<float>()));
  glEnable(GL_DEPTH_TEST);
  glBindVertexArray(array_.name());
  const auto i = static_cast<std::size_t>(body);
  glDrawArrays(GL_TRIANGLES, first_[i], count_[i]);
}

namespace {

constexpr int kRim = 48;

/// From the body's axes at the model's own size.
struct Placed {
  RigidTransform X_WB;
  double size;
  Eigen::Vector3d operator()(const Eigen::Vector3d& p_B) const { return X_WB * (size * p_B); }
};

void AddRotor(LineBatch& batch, const Placed& at, const Eigen::Vector3d& hub_B, double radius,
              double ui_scale) {
  const Rgba8 disc = RgbaFromHex(0xE8ECF1, 34), rim = RgbaFromHex(0xE8ECF1, 215);
  const auto on_disc = [&](double r, double angle) {
    return at(hub_B + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0));
  };
  std::vector<Eigen::Vector3d> circle;
  for (int i = 0; i <= kRim; ++i) {
    circle.push_back(on_disc(radius, kTurn * i / kRim));
  }
  const Eigen::Vector3d hub = at(hub_B);
  for (int i = 0; i < kRim; ++i) {
    batch.Triangle(hub, circle[static_cast<std::size_t>(i)],
                   circle[static_cast<std::size_t>(i) + 1], disc);
  }
  batch.Polyline(circle, {rim, 1.3 * ui_scale});
  constexpr double kBladeAngle = 0.5;
  batch.Line(on_disc(radius, kBladeAngle), on_disc(-radius, kBladeAngle),
             {RgbaFromHex(0xD5DBE2, 235), 1.8 * ui_scale});
}

/// It stands upright on the left of the fin.
void AddTailRotor(LineBatch& batch, const Placed& at, double ui_scale) {
  std::vector<Eigen::Vector3d> tail;
  for (int i = 0; i <= kRim / 2; ++i) {
    const double angle = kTurn * i / (kRim / 2);
    tail.push_back(
        at(Eigen::Vector3d(-2.0 + 0.26 * std::cos(angle), -0.06, -0.34 + 0.26 * std::sin(angle))));
  }
  batch.Polyline(tail, {RgbaFromHex(0xE8ECF1, 215), 1.0 * ui_scale});
}

}  // namespace

void AddRotors(LineBatch& batch, VehicleBody body, const RigidTransform& X_WB, double size,
               double ui_scale) {
  const Placed at{X_WB, size};
  if (body == VehicleBody::kMultirotor) {
    for (int i = 0; i < 4; ++i) {
      AddRotor(batch, at, PropellerHub(i), kPropeller, ui_scale);
    }
    return;
  }
  AddRotor(batch, at, kRotorHub_B, kRotorRadius_m, ui_scale);
  AddTailRotor(batch, at, ui_scale);
}

}  // namespace palace
