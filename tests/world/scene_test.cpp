// Rays and scenes: closed forms for the laser, the promise of a clear disc for every seed.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/simulation/sensors.h"
#include "engine/world/scene_library.h"
#include "engine/world/scene_ray.h"

namespace palace {
namespace {

using Eigen::Vector3d;

SceneObject Object(SceneShape shape, double north, double size_n, double size_e, double height) {
  SceneObject object;
  object.shape = shape;
  object.north_m = north;
  object.size_north_m = size_n;
  object.size_east_m = size_e;
  object.height_m = height;
  return object;
}

struct RayCase {
  const char* name;
  SceneShape shape;
  Vector3d origin;
  Vector3d direction;  ///< not yet unit
  double range;        ///< NaN: a miss
};

TEST(SceneRay, ClosedForms) {
  const double r2 = std::sqrt(2.0);
  const RayCase cases[] = {
      {"box from above", SceneShape::kBox, {10, 0, -10}, {0, 0, 1}, 9},
      {"box from the south", SceneShape::kBox, {0, 0, -0.5}, {1, 0, 0}, 9},
      {"box missed, ground hit", SceneShape::kBox, {10, 3, -10}, {0, 0, 1}, 10},
      {"table at 45 degrees on its near edge",
       SceneShape::kTable,
       {9 - 3, 0, -3.5},
       {1, 0, 1},
       3 * r2},
      {"cylinder lid", SceneShape::kCylinder, {10, 0.5, -4}, {0, 0, 1}, 3},
      {"cylinder wall", SceneShape::kCylinder, {0, 0, -0.5}, {1, 0, 0}, 9},
      {"cone apex", SceneShape::kCone, {10, 0, -4}, {0, 0, 1}, 3},
      {"cone halfway up", SceneShape::kCone, {0, 0, -0.5}, {1, 0, 0}, 9.5},
      {"cone beside its axis", SceneShape::kCone, {10, 0.25, -4}, {0, 0, 1}, 3.25},
      {"up into the sky", SceneShape::kBox, {0, 0, -1}, {0, 0, -1}, NAN},
      {"too far", SceneShape::kBox, {0, 0, -70}, {0, 0, 1}, NAN},
  };
  for (const RayCase& c : cases) {
    Scene scene;
    scene.objects = {Object(c.shape, 10, 2, 2, 1)};
    const double range = CastRay(scene, c.origin, c.direction.normalized(), 60);
    if (std::isnan(c.range)) {
      EXPECT_TRUE(std::isnan(range)) << c.name << " " << range;
    } else {
      EXPECT_NEAR(range, c.range, 1e-9) << c.name;
    }
  }
}

TEST(SceneRay, SlopingGroundAndSurface) {
  Scene scene;
  scene.slope_north_rad = Rad(5);
  scene.objects = {Object(SceneShape::kBox, 20, 2, 2, 1)};
  const double tan5 = std::tan(Rad(5));
  // From height h straight north-down at 45 degrees: h - s = tan5 s along north.
  EXPECT_NEAR(CastRay(scene, {0, 0, -10}, Vector3d(1, 0, 1).normalized(), 60),
              10 / (1 + tan5) * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(SurfaceHeight(scene, 10, 4), 10 * tan5, 1e-12);
  EXPECT_NEAR(SurfaceHeight(scene, 20.9, 0), 20 * tan5 + 1, 1e-12);
}

TEST(Laser, MeasuresTheSlantRangeWithItsStatedNoise) {
  const Scene scene = MakeScene("empty", 1).value();
  LaserSensor laser(LaserNoise{}, 3);
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
}

/// Largest distance to an object over ground points that both cameras see with a 3 m disc around.
double BestVisibleClearance(const Scene& scene) {
  const StereoRig rig = DefaultRig();
  const RigidTransform X_CW =
      (RigidTransform{Eigen::Matrix3d::Identity(), {0, 0, -15.24}} * rig.X_BC()).Inverse();
  const PinholeCamera& camera = rig.left.pinhole;
  const auto seen = [&](double n, double e) {
    const Vector3d p = X_CW * Vector3d(n, e, -scene.GroundHeight(n, e));
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
        best = std::max(best, scene.ObstacleDistance(n, e));
      }
    }
  }
  return best;
}

TEST(SceneLibrary, EverySeedKeepsAClearDiscInView) {
  for (const std::string_view name : SceneNames()) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      const Scene scene = MakeScene(name, seed).value();
      EXPECT_GE(BestVisibleClearance(scene), kClearDiscRadius_m) << name << " seed " << seed;
    }
  }
}

TEST(SceneLibrary, RunwayHoldsTablesAndConesApart) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Scene scene = MakeScene("runway", seed).value();
    EXPECT_GE(scene.objects.size(), 12u);
    EXPECT_LE(scene.objects.size(), 18u);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      Scene others = scene;
      others.objects.erase(others.objects.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_GT(others.ObstacleDistance(scene.objects[i].north_m, scene.objects[i].east_m), 0.5)
          << "seed " << seed << " object " << i;
    }
  }
}

TEST(SceneLibrary, UnknownNameListsTheNames) {
  const Result<Scene> scene = MakeScene("moon", 1);
  ASSERT_FALSE(scene.ok());
  EXPECT_EQ(scene.error().code, ErrorCode::kUsage);
  for (const std::string_view name : SceneNames()) {
    EXPECT_NE(scene.error().message.find(name), std::string::npos) << name;
  }
}

TEST(Scene, ObstacleDistanceAgainstSampledEdges) {
  Scene scene;
  SceneObject box;
  box.north_m = 1;
  box.east_m = 2;
  box.yaw_rad = Rad(30);
  box.size_north_m = 2;
  box.size_east_m = 1;
  scene.objects.push_back(box);
  constexpr std::uint64_t kSeed = 3;
  SCOPED_TRACE("seed 3");
  RandomStream random(kSeed);
  for (int i = 0; i < 200; ++i) {
    const double n = random.Uniform(-6, 8), e = random.Uniform(-6, 8);
    double nearest = INFINITY;
    for (double u = -1; u <= 1.0001; u += 0.01) {
      for (double v = -0.5; v <= 0.5001; v += 0.01) {
        const double c = std::cos(box.yaw_rad), s = std::sin(box.yaw_rad);
        nearest = std::min(
            nearest, std::hypot(box.north_m + c * u - s * v - n, box.east_m + s * u + c * v - e));
      }
    }
    EXPECT_NEAR(scene.ObstacleDistance(n, e), nearest, 0.02);
  }
}

}  // namespace
}  // namespace palace
