// Rays and worlds: closed forms for the laser, every shape against its own sampling, the promise of
// a clear disc for every seed.
#include "engine/world/world.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/simulation/laser_sensor.h"
#include "engine/world/scene_library.h"
#include "engine/world/world_mesh.h"

namespace palace {
namespace {

using Eigen::Vector3d;

struct RayCase {
  const char* name;
  Shape shape;
  Vector3d origin;
  Vector3d direction;  ///< not yet unit
  double range;        ///< infinity: a miss
};

TEST(SceneRay, ClosedForms) {
  const double r2 = std::sqrt(2.0);
  const Box box{2, 2, 1};
  const Cylinder cylinder{2, 1};
  const Cone cone{2, 1};
  const RayCase cases[] = {
      {"box from above", box, {10, 0, -10}, {0, 0, 1}, 9},
      {"box from the south", box, {0, 0, -0.5}, {1, 0, 0}, 9},
      {"box missed, ground hit", box, {10, 3, -10}, {0, 0, 1}, 10},
      {"table at 45 degrees on its near edge", Table{2, 2, 1}, {9 - 3, 0, -3.5}, {1, 0, 1}, 3 * r2},
      {"cylinder lid", cylinder, {10, 0.5, -4}, {0, 0, 1}, 3},
      {"cylinder wall", cylinder, {0, 0, -0.5}, {1, 0, 0}, 9},
      {"cone apex", cone, {10, 0, -4}, {0, 0, 1}, 3},
      {"cone halfway up", cone, {0, 0, -0.5}, {1, 0, 0}, 9.5},
      {"cone beside its axis", cone, {10, 0.25, -4}, {0, 0, 1}, 3.25},
      {"up into the sky", box, {0, 0, -1}, {0, 0, -1}, INFINITY},
  };
  for (const RayCase& c : cases) {
    World world;
    world.solids = {StandingOn(world.ground, c.shape, 10, 0)};
    const double range = CastRay(world, c.origin, c.direction.normalized()).s;
    if (std::isinf(c.range)) {
      EXPECT_TRUE(std::isinf(range)) << c.name << " " << range;
    } else {
      EXPECT_NEAR(range, c.range, 1e-9) << c.name;
    }
  }
}

TEST(SceneRay, SlopingGroundAndSurface) {
  const double tan5 = std::tan(Rad(5));
  World world;
  world.ground.rise_north = tan5;
  world.solids = {StandingOn(world.ground, Box{2, 2, 1}, 20, 0)};
  // From height h straight north-down at 45 degrees: h - s = tan5 s along north.
  EXPECT_NEAR(CastRay(world, {0, 0, -10}, Vector3d(1, 0, 1).normalized()).s,
              10 / (1 + tan5) * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(SurfaceHeight(world, 10, 4), 10 * tan5, 1e-12);
  EXPECT_NEAR(SurfaceHeight(world, 20.9, 0), 20 * tan5 + 1, 1e-12);
}

TEST(Laser, MeasuresTheSlantRangeWithItsStatedNoise) {
  const World scene = MakeScene("empty", 1).value();
  const LaserNoise noise{.sigma_m = 0.03, .sigma_per_m = 0.001, .dropout = 0.02};
  LaserSensor laser(noise, 3);
  const RigidTransform X_WC{CameraRotationFromTilt(-Rad(45)), {0, 0, -15}};
  const double truth = 15 * std::sqrt(2.0), sigma = 0.03 + 0.001 * truth;
  double sum = 0, squares = 0;
  int count = 0, lost = 0;
  for (int i = 0; i < 4000; ++i) {
    const double range = laser.Measure({i}, scene, X_WC).range_m;
    if (std::isnan(range)) {
      ++lost;
      continue;
    }
    ++count;
    sum += range - truth;
    squares += (range - truth) * (range - truth);
  }
  EXPECT_NEAR(sum / count, 0, 4 * sigma / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count) / sigma, 1, 0.05);
  EXPECT_NEAR(lost / 4000.0, 0.02, 0.01);
  const RigidTransform too_high{CameraRotationFromTilt(-Rad(90)), {0, 0, -noise.max_range_m - 1}};
  EXPECT_TRUE(std::isnan(laser.Measure({}, scene, too_high).range_m));
}

/// Largest distance to an object over ground points that both cameras see with a 3 m disc around.
double BestVisibleClearance(const World& scene) {
  const StereoRig rig = DefaultRig();
  const RigidTransform X_CW =
      (RigidTransform{Eigen::Matrix3d::Identity(), {0, 0, -15.24}} * rig.X_BC()).Inverse();
  const PinholeCamera& camera = rig.left.pinhole;
  const auto seen = [&](double n, double e) {
    const Vector3d p = X_CW * Vector3d(n, e, -scene.ground.Height(n, e));
    const double x = camera.fx_px * p.x() / p.z() + camera.cx_px;
    const double x_right = x - camera.fx_px * rig.baseline_m / p.z();
    const double y = camera.fy_px * p.y() / p.z() + camera.cy_px;
    return p.z() > 0 && x_right >= 0 && x <= camera.width - 1 && y >= 0 && y <= camera.height - 1;
  };
  double best = 0;
  for (double n = 5; n < 30; n += 0.25) {
    for (double e = -10; e < 10; e += 0.25) {
      bool whole = true;
      for (int i = 0; i < 16 && whole; ++i) {
        const double angle = i * std::numbers::pi / 8;
        whole = seen(n + kClearDiscRadius_m * std::cos(angle),
                     e + kClearDiscRadius_m * std::sin(angle));
      }
      if (whole) {
        best = std::max(best, ObstacleDistance(scene, n, e));
      }
    }
  }
  return best;
}

TEST(SceneLibrary, EverySeedKeepsAClearDiscInView) {
  for (const std::string_view name : PlainSceneNames()) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      const World scene = MakeScene(name, seed).value();
      EXPECT_GE(BestVisibleClearance(scene), kClearDiscRadius_m) << name << " seed " << seed;
    }
  }
}

TEST(SceneLibrary, RunwayHoldsTablesAndConesApart) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const World scene = MakeScene("runway", seed).value();
    EXPECT_GE(scene.solids.size(), 12u);
    EXPECT_LE(scene.solids.size(), 18u);
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
      World others = scene;
      others.solids.erase(others.solids.begin() + static_cast<std::ptrdiff_t>(i));
      const Vector3d& p = scene.solids[i].X_WO.p;
      EXPECT_GT(ObstacleDistance(others, p.x(), p.y()), 0.5) << "seed " << seed << " object " << i;
    }
  }
}

TEST(SceneLibrary, UnknownNameListsTheNames) {
  const Result<World> scene = MakeScene("moon", 1);
  ASSERT_FALSE(scene.ok());
  EXPECT_EQ(scene.error().code, ErrorCode::kUsage);
  for (const std::string_view name : SceneNames()) {
    EXPECT_NE(scene.error().message.find(name), std::string::npos) << name;
  }
}

/// One of each shape, upright and turned; polyhedra alike and unlike them.
struct ShapeRow {
  const char* name;
  Shape shape;
};
std::vector<ShapeRow> ShapesOfEveryKind() {
  return {{"box", Box{2, 1, 0.8}},
          {"table", Table{1.6, 0.8, 0.75}},
          {"cone", Cone{0.9, 1.2}},
          {"cylinder", Cylinder{0.7, 1.1}},
          {"polyhedral box", MakeBox(0.1, -0.2, 0.9, 0.5, 0.7).shape},
          {"wedge", MakeWedge(0, 0, 1, 0.8, 0.4).shape},
          {"frustum", MakeCone(0, 0, 0.6, 0.2, 0.9).shape}};
}
constexpr double kYaw_rad = 0.5;
constexpr double kNorth_m = 1, kEast_m = 2;

World WorldOf(const Shape& shape) {
  World world;
  world.ground.rise_north = 0.06;
  world.ground.rise_east = -0.03;
  world.solids = {StandingOn(world.ground, shape, kNorth_m, kEast_m, kYaw_rad)};
  return world;
}

// The height query and the ray caster are two answers to one question.
TEST(World, TopsAreWhereRaysFromAboveMeetThem) {
  constexpr std::uint64_t kSeed = 4;
  SCOPED_TRACE("seed 4");
  for (const ShapeRow& row : ShapesOfEveryKind()) {
    const World world = WorldOf(row.shape);
    RandomStream random(kSeed);
    int on_it = 0;
    for (int i = 0; i < 300; ++i) {
      const double n = kNorth_m + random.Uniform(-1, 1), e = kEast_m + random.Uniform(-1, 1);
      const Hit hit = CastRay(world, {n, e, -20}, Vector3d::UnitZ());
      EXPECT_NEAR(SurfaceHeight(world, n, e), 20 - hit.s, 1e-9) << row.name;
      const bool beside = ObstacleDistance(world, n, e) > 0;
      const bool ground = std::abs(20 - hit.s - world.ground.Height(n, e)) < 1e-9;
      EXPECT_TRUE(!beside || ground) << row.name << " is hit beside itself";
      on_it += beside ? 0 : 1;
    }
    EXPECT_GT(on_it, 10) << row.name;
  }
}

TEST(World, EveryShapeStaysWithinItsBoundsAndItsFoot) {
  constexpr std::uint64_t kSeed = 5;
  SCOPED_TRACE("seed 5");
  for (const ShapeRow& row : ShapesOfEveryKind()) {
    Eigen::AlignedBox3d bounds;
    for (const Vector3d& corner : Bounds(row.shape)) {
      bounds.extend(corner);
    }
    RandomStream random(kSeed);
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
      const Vector3d from(random.Uniform(-4, 4), random.Uniform(-4, 4), random.Uniform(-4, -2));
      const Vector3d to(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 0));
      const double s = Enter(row.shape, from, to - from);
      if (std::isinf(s)) {
        continue;
      }
      ++hits;
      const Vector3d p = from + s * (to - from);
      EXPECT_LT(bounds.exteriorDistance(p), 1e-6) << row.name;
      EXPECT_LT(p.head<2>().norm(), FootRadius(row.shape) + 1e-6) << row.name;
      EXPECT_LT(DistanceFromAbove(row.shape, p.x(), p.y()), 1e-6) << row.name;
    }
    EXPECT_GT(hits, 50) << row.name;
  }
}

// A box cut out of half-spaces is the box.
TEST(World, APolyhedralBoxIsTheBoxToRaysAndDistances) {
  const World exact = WorldOf(Box{0.9, 0.5, 0.7});
  const World cut = WorldOf(MakeBox(0, 0, 0.9, 0.5, 0.7).shape);
  constexpr std::uint64_t kSeed = 6;
  SCOPED_TRACE("seed 6");
  RandomStream random(kSeed);
  for (int i = 0; i < 300; ++i) {
    const double n = random.Uniform(-1, 3), e = random.Uniform(0, 4);
    EXPECT_NEAR(ObstacleDistance(exact, n, e), ObstacleDistance(cut, n, e), 1e-9);
    const Vector3d from(n, e, -random.Uniform(1, 5));
    const Vector3d to(random.Uniform(0.5, 1.5), random.Uniform(1.5, 2.5), 0);
    EXPECT_NEAR(CastRay(exact, from, to - from).s, CastRay(cut, from, to - from).s, 1e-9);
  }
}

TEST(World, SolidsMoveAsTheyAreSaidTo) {
  World world = WorldOf(Box{1, 1, 1});
  world.solids[0].v_WO = {0.5, -0.25, 0};
  const World later = WorldAt(world, 4);
  EXPECT_TRUE(later.solids[0].X_WO.p.isApprox(world.solids[0].X_WO.p + Vector3d(2, -1, 0)));
  EXPECT_EQ(WorldAt(world, 0).solids[0].X_WO.p, world.solids[0].X_WO.p);
}

// What triangles show is what rays meet.
TEST(WorldMesh, EveryVertexAboveTheGroundLiesOnTheSolid) {
  for (const ShapeRow& row : ShapesOfEveryKind()) {
    const World world = WorldOf(row.shape);
    const std::vector<MeshVertex> triangles = SolidTriangles(world, 0.4F);
    ASSERT_EQ(triangles.size() % 3, 0U) << row.name;
    ASSERT_GE(triangles.size(), 18U) << row.name;
    double lowest = 1, highest = -1;
    for (const MeshVertex& vertex : triangles) {
      const Vector3d p = vertex.position_W.cast<double>();
      EXPECT_LT(ObstacleDistance(world, p.x(), p.y()), 1e-3) << row.name;
      // A hair inside, as corners are rounded to single precision.
      const Vector3d inside = p + 1e-3 * (world.solids[0].X_WO.p - p);
      EXPECT_LE(-p.z(), SurfaceHeight(world, inside.x(), inside.y()) + 5e-3) << row.name;
      EXPECT_NEAR(vertex.normal_W.norm(), 1, 1e-5) << row.name;
      lowest = std::min(lowest, -p.z());
      highest = std::max(highest, -p.z());
    }
    const double foot = world.ground.Height(kNorth_m, kEast_m);
    EXPECT_LT(lowest, foot + 1e-6) << row.name;
    EXPECT_GT(highest, foot + 0.3) << row.name;
  }
}

TEST(World, ObstacleDistanceAgainstSampledEdges) {
  World world;
  world.solids = {StandingOn(world.ground, Box{2, 1, 1}, 1, 2, Rad(30))};
  const RigidTransform& X_WO = world.solids[0].X_WO;
  constexpr std::uint64_t kSeed = 3;
  SCOPED_TRACE("seed 3");
  RandomStream random(kSeed);
  for (int i = 0; i < 200; ++i) {
    const double n = random.Uniform(-6, 8), e = random.Uniform(-6, 8);
    double nearest = INFINITY;
    for (double u = -1; u <= 1.0001; u += 0.01) {
      for (double v = -0.5; v <= 0.5001; v += 0.01) {
        nearest = std::min(nearest, (X_WO * Vector3d(u, v, 0) - Vector3d(n, e, 0)).norm());
      }
    }
    EXPECT_NEAR(ObstacleDistance(world, n, e), nearest, 0.02);
  }
}

}  // namespace
}  // namespace palace
