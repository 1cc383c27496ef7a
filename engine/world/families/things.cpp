#include "engine/world/families/things.h"

#include <cmath>
#include <utility>

namespace palace {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr double kMetal = 0.45;
constexpr double kRubber = 0.08;
constexpr double kGlass = 0.12;

Vector3d OnGround(const Ground& ground, const Vector2d& place_m, double up_m) {
  return {place_m.x(), place_m.y(), -ground.Height(place_m.x(), place_m.y()) - up_m};
}

/// A block between two heights whose front, back and sides lean inwards by a share of its height.
Solid MakeCabin(const Vector2d& middle, double length_m, double width_m, double from_m, double to_m,
                const Vector3d& lean, double albedo) {
  const double half = length_m / 2, aside = width_m / 2;
  std::vector<HalfSpace> faces = {{{0, 0, 1}, -from_m}, {{0, 0, -1}, to_m}};
  const auto wall = [&](const Vector2d& out, double reach_m, double leans) {
    // out . p <= reach - leans (up - from), and up = -z.
    faces.push_back({{out.x(), out.y(), -leans}, reach_m + out.dot(middle) + leans * from_m});
  };
  wall({1, 0}, half, lean.x());
  wall({-1, 0}, half, lean.y());
  wall({0, 1}, aside, lean.z());
  wall({0, -1}, aside, lean.z());
  return Painted({MakePolyhedron(std::move(faces))}, albedo);
}

}  // namespace

Solid MakePost(double thick_m, double tall_m, double albedo) {
  return Painted({Cylinder{thick_m, tall_m}}, albedo);
}

void AddFence(World& world, const Vector2d& from_m, const Vector2d& to_m, const Fence& fence) {
  const int spans = std::max(1, static_cast<int>((to_m - from_m).norm() / fence.spacing_m));
  for (int i = 0; i <= spans; ++i) {
    const Vector2d place = from_m + (to_m - from_m) * i / spans;
    world.solids.push_back(
        PutOn(world.ground, MakePost(fence.thick_m, fence.tall_m, fence.albedo), place));
    for (int k = 0; i > 0 && k < fence.wires; ++k) {
      const Vector2d before = from_m + (to_m - from_m) * (i - 1) / spans;
      const double up_m = fence.tall_m * (0.35 + 0.6 * k / std::max(1, fence.wires - 1));
      world.solids.push_back(Painted(MakeRod(OnGround(world.ground, before, up_m),
                                             OnGround(world.ground, place, up_m), fence.wire_m),
                                     kMetal));
    }
  }
}

void AddGuyedMast(World& world, RandomStream& random, const Vector2d& place_m, double tall_m,
                  double thick_m, double guy_m) {
  world.solids.push_back(PutOn(world.ground, MakePost(thick_m, tall_m, kMetal), place_m));
  const double turn = DrawAngle(random), out_m = tall_m * random.Uniform(0.4, 0.8);
  const Vector3d top = OnGround(world.ground, place_m, 0.9 * tall_m);
  for (int i = 0; i < 3; ++i) {
    const double angle = turn + i * 2.0944;
    const Vector2d foot = place_m + out_m * Vector2d(std::cos(angle), std::sin(angle));
    world.solids.push_back(Painted(MakeRod(OnGround(world.ground, foot, 0), top, guy_m), kMetal));
  }
}

std::vector<Solid> MakeCar(RandomStream& random) {
  const double length_m = random.Uniform(3.6, 4.8), width_m = random.Uniform(1.65, 1.85);
  const double paint = random.Uniform(0.06, 0.85), roof_m = random.Uniform(1.4, 1.7);
  const double cabin_m = length_m * random.Uniform(0.55, 0.7);
  std::vector<Solid> car = {
      MakeCabin({0, 0}, length_m, width_m, 0.28, 0.88, {0.25, 0.15, 0.08}, paint),
      MakeCabin({-0.06 * length_m, 0}, cabin_m, width_m - 0.1, 0.88, roof_m - 0.03,
                {0.9, 0.5, 0.25}, kGlass),
      MakeCabin({-0.09 * length_m, 0}, cabin_m - 0.65, width_m - 0.32, roof_m - 0.12, roof_m,
                {0.9, 0.5, 0.25}, paint)};
  for (const double north : {-0.31 * length_m, 0.31 * length_m}) {
    for (const double east : {-0.44 * width_m, 0.44 * width_m}) {
      car.push_back(
          Painted(MakeRod({north, east - 0.1, -0.31}, {north, east + 0.1, -0.31}, 0.62), kRubber));
    }
  }
  return car;
}

std::vector<Solid> MakeVan(RandomStream& random) {
  const double length_m = random.Uniform(5, 7.5), tall_m = random.Uniform(2.3, 3.2);
  const double paint = random.Uniform(0.3, 0.85);
  std::vector<Solid> van = {
      MakeCabin({-0.9, 0}, length_m - 1.8, 2.1, 0.5, tall_m, {0, 0, 0}, paint),
      MakeCabin({length_m / 2 - 0.95, 0}, 1.7, 2.0, 0.4, 2.1, {0.35, 0, 0.05},
                random.Uniform(0.1, 0.8))};
  for (const double north : {-0.3 * length_m, 0.33 * length_m}) {
    for (const double east : {-0.9, 0.9}) {
      van.push_back(
          Painted(MakeRod({north, east - 0.13, -0.4}, {north, east + 0.13, -0.4}, 0.8), kRubber));
    }
  }
  return van;
}

std::vector<Solid> MakeWalker(RandomStream& random) {
  const double tall_m = random.Uniform(1.55, 1.9), coat = random.Uniform(0.08, 0.8);
  const double legs = random.Uniform(0.08, 0.5);
  return {Painted(MakeRod({0.15, -0.1, 0}, {0, -0.08, -0.48 * tall_m}, 0.15), legs),
          Painted(MakeRod({-0.15, 0.1, 0}, {0, 0.08, -0.48 * tall_m}, 0.15), legs),
          Painted(MakeRod({0, 0, -0.46 * tall_m}, {0.02, 0, -0.84 * tall_m}, 0.4), coat),
          Painted(MakeRod({0.03, 0, -0.82 * tall_m}, {0.04, 0, -tall_m}, 0.2), 0.4)};
}

Solid MakeBird(double up_m, double span_m) {
  const double half = span_m / 2, back = -0.3 * span_m, raised = up_m + 0.12 * span_m;
  const double bill = 0.22 * span_m;
  std::vector<Vector3d> vertices = {
      {bill, 0, -up_m}, {back, 0, -up_m}, {-0.05, half, -raised}, {-0.05, -half, -raised}};
  std::vector<TriangleMesh::Corners> triangles = {{0, 1, 2}, {0, 1, 3}};
  return Painted(
      {Mesh{std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles))}},
      0.12);
}

std::vector<Solid> MakeStreetLamp(double tall_m) {
  return {MakePost(0.14, tall_m, kMetal),
          Painted(MakeRod({0, 0, -tall_m + 0.05}, {0, 1.4, -tall_m - 0.1}, 0.08), kMetal),
          Painted(MakeSlab(0, 1.4, 0.25, 0.6, tall_m - 0.05, tall_m + 0.1), kMetal)};
}

void SetVelocity(std::vector<Solid>& solids, const Vector3d& v_W) {
  for (Solid& solid : solids) {
    solid.v_WO = v_W;
  }
}

}  // namespace palace
