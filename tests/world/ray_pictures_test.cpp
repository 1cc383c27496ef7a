#include "engine/world/ray_pictures.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/core/random.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kNadir_rad = -std::numbers::pi / 2;

RigidTransform Above(double height_m, const EulerAngles& attitude = {}) {
  return {RotationFromEuler(attitude) * CameraRotationFromTilt(kNadir_rad), {0, 0, -height_m}};
}

struct Difference {
  double rms = 0;
  double mean = 0;
  double spread = 0;  ///< of the exact picture: what there is to get wrong
};

Difference Compare(const ImageF& fast, const ImageF& exact) {
  double square = 0, sum = 0, grey = 0, grey2 = 0;
  const auto count = static_cast<double>(exact.pixels().size());
  for (std::size_t i = 0; i < exact.pixels().size(); ++i) {
    const double off = double(fast.pixels()[i]) - double(exact.pixels()[i]);
    square += off * off;
    sum += off;
    grey += double(exact.pixels()[i]);
    grey2 += double(exact.pixels()[i]) * double(exact.pixels()[i]);
  }
  return {std::sqrt(square / count), sum / count,
          std::sqrt(grey2 / count - grey / count * (grey / count))};
}

class DrawnGround : public ::testing::TestWithParam<GroundTexture> {};

// Fine grain is sampled 9 times a pixel by the bake and 16 times by the slow picture, so both stand
// off a picture of 64 samples by their aliasing.
TEST_P(DrawnGround, IsTheSlowPicture) {
  World world;
  world.ground.texture = GetParam();
  world.ground.rise_north = 0.04;
  // A quarter of the rig's picture from a quarter of its height: the same ground a pixel.
  const PinholeCamera camera = PinholeFromFov(160, 120, Rad(60));
  for (const double height_m : {3.05, 7.0, 15.24, 30.5}) {
    const RigidTransform X_WC = Above(height_m / 4, {0.03, -0.02, 1.1});
    const ImageF exact = RenderGrey(world, camera, X_WC, 8);
    const Difference slow = Compare(RenderGrey(world, camera, X_WC, 4), exact);
    const Difference fast =
        Compare(DrawGrey(world, camera, X_WC, BakeFor(world, camera, {X_WC})), exact);
    EXPECT_LT(fast.rms, 1.9 * slow.rms + 0.015 * fast.spread) << NameOf(GetParam()) << height_m;
    EXPECT_LT(std::abs(fast.mean), 0.1) << NameOf(GetParam()) << height_m;
  }
}

INSTANTIATE_TEST_SUITE_P(Textures, DrawnGround,
                         ::testing::Values(GroundTexture::kCloud, GroundTexture::kGravel,
                                           GroundTexture::kGrass, GroundTexture::kAsphalt),
                         [](const auto& row) { return std::string(NameOf(row.param)); });

std::vector<Solid> SomeSolids() {
  std::vector<Solid> solids = MakeTrafficCone(0.4, -0.5, 0.711);
  solids.push_back(MakeBox(-0.8, 0.6, 0.3, 0.2, 0.15));
  solids.push_back(MakeCone(0.9, 1.1, 0.2, 0.2, 0.6));
  solids.push_back(MakeRod({-1, -1.2, -0.4}, {0.2, 1.4, -0.6}, 0.015));
  solids.push_back(Moved(MakeWedge(0, 0, 0.6, 0.4, 0.3), 0.7, {-0.9, -0.6, 0.03}));
  return solids;
}

TEST(DrawnSolids, AreTheSlowPicture) {
  World world;
  world.ground.texture = GroundTexture::kGrass;
  world.solids = SomeSolids();
  const PinholeCamera camera = PinholeFromFov(320, 240, Rad(45));
  const RigidTransform X_WC = Above(4, {0.02, 0.03, -0.4});
  const ImageF exact = RenderGrey(world, camera, X_WC, 4);
  const Difference drawn =
      Compare(DrawGrey(world, camera, X_WC, BakeFor(world, camera, {X_WC})), exact);
  world.solids.clear();
  const Difference bare =
      Compare(DrawGrey(world, camera, X_WC, BakeFor(world, camera, {X_WC})), exact);
  EXPECT_LT(drawn.rms, 1.0);
  EXPECT_GT(bare.rms, 5.0);  // they are in the picture
}

// Bounds in the picture may leave nothing out: every solid cast against every ray is the reference.
TEST(DrawnSolids, BoundsLeaveNothingOut) {
  World world;
  world.solids = SomeSolids();
  const PinholeCamera camera = PinholeFromFov(160, 120, Rad(50));
  for (const double tilt_rad : {kNadir_rad, -0.7}) {
    const RigidTransform X_WC{CameraRotationFromTilt(tilt_rad),
                              {tilt_rad < -1 ? 0.0 : -4.0, 0, -3}};
    World unbounded = world;
    for (Solid& solid : unbounded.solids) {
      std::get<Polyhedron>(solid.shape).corners.clear();
    }
    EXPECT_EQ(RenderGrey(world, camera, X_WC, 2).pixels(),
              RenderGrey(unbounded, camera, X_WC, 2).pixels());
  }
}

double HeightAt(const Solid& solid, double north_m, double east_m) {
  World world;
  world.solids = {solid};
  EXPECT_NEAR(100 - CastRay(world, {north_m, east_m, -100}, Eigen::Vector3d::UnitZ()).s,
              SurfaceHeight(world, north_m, east_m), 1e-9);
  return SurfaceHeight(world, north_m, east_m);
}

TEST(Solids, ConesAndCylindersAreRoundWithinOnePercent) {
  RandomStream random(5, "cone");
  const Solid cone = MakeCone(2, -1, 0.5, 0.1, 0.8);
  const Solid cylinder = MakeCone(0, 0, 0.5, 0.5, 0.8);
  for (int i = 0; i < 200; ++i) {
    const double azimuth = random.Uniform(0, 2 * std::numbers::pi);
    const double r = random.Uniform(0.11, 0.48);
    EXPECT_NEAR(HeightAt(cone, 2 + r * std::cos(azimuth), -1 + r * std::sin(azimuth)),
                0.8 * (0.5 - r) / 0.4, 0.01);
    for (const double off : {0.99, 1.01}) {
      const double at =
          HeightAt(cylinder, 0.5 * off * std::cos(azimuth), 0.5 * off * std::sin(azimuth));
      EXPECT_NEAR(at, off < 1 ? 0.8 : 0.0, 1e-9) << azimuth;
    }
  }
}

TEST(Solids, RodsRunBetweenTheirEndsInAnyDirection) {
  RandomStream random(6, "rod");
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d from(random.Uniform(-2, 2), random.Uniform(-2, 2),
                               random.Uniform(-3, -1));
    const Eigen::Vector3d to(random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(-3, -1));
    const Solid rod = MakeRod(from, to, 0.05);
    const Eigen::Vector3d middle = 0.3 * from + 0.7 * to;
    const Eigen::Vector3d across = (to - from).unitOrthogonal();
    // From 1 m to the side it is met 2.5 cm before its middle, give or take its flat sides.
    EXPECT_NEAR(Enter(rod, middle + across, -across), 1 - 0.025, 0.0025);
    EXPECT_TRUE(std::isinf(Enter(rod, 1.2 * to - 0.2 * from + across, -across)));
  }
}

TEST(Solids, DistanceFromAboveIsToTheEdge) {
  const Solid box = MakeBox(1, 2, 0.4, 0.6, 0.3);
  struct Row {
    double north_m, east_m, distance_m;
  };
  for (const Row& row : {Row{1, 2, 0}, Row{1.19, 2.29, 0}, Row{1.5, 2, 0.3}, Row{1, 1, 0.7},
                         Row{0.5, 2.7, 0.5}, Row{-2, 2, 2.8}}) {
    EXPECT_NEAR(DistanceFromAbove(box, row.north_m, row.east_m), row.distance_m, 1e-9);
  }
  const Solid moved = Moved(box, std::numbers::pi / 2, {3, 0, 0});  // centre (1, 2) -> (1, 1)
  EXPECT_NEAR(DistanceFromAbove(moved, 1.5, 1), 0.2, 1e-9);
  EXPECT_NEAR(HeightAt(moved, 1.29, 1.19), 0.3, 1e-9);
}

}  // namespace
}  // namespace palace
