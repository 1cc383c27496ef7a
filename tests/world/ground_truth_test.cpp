// The truth of known surfaces in closed form, and that nothing thin escapes it. It does not prove
// that the families are drawn well.
#include "engine/world/ground_truth.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/units.h"

namespace palace {
namespace {

using Eigen::Vector2d;

constexpr TruthArea kSmall{-5, 5, -5, 5, 0.05};
const Vector2d kMiddle(0, 0);

World Plane(double slope_deg, double aspect_deg) {
  World world;
  world.ground.rise_north = std::tan(Rad(slope_deg)) * std::cos(Rad(aspect_deg));
  world.ground.rise_east = std::tan(Rad(slope_deg)) * std::sin(Rad(aspect_deg));
  return world;
}

World Relief(const std::function<double(double, double)>& height, int levels = 8) {
  World world;
  world.ground.relief =
      std::make_shared<const HeightField>(HeightField::Place{-6.4, -6.4, 12.8, levels}, height);
  return world;
}

TEST(GroundTruth, APlaneHasItsSlopeAndNothingElse) {
  for (const double slope_deg : {0.0, 3.0, 10.0, 20.0}) {
    for (const double aspect_deg : {0.0, 50.0, 200.0}) {
      const GroundTruth truth = TruthOf(Plane(slope_deg, aspect_deg), kSmall);
      const DiscTruth disc = TruthOfDisc(truth, {0.3, -0.7}, 2.3);
      ASSERT_TRUE(disc.known);
      EXPECT_NEAR(disc.slope_deg, slope_deg, 1e-4);
      EXPECT_NEAR(disc.deviation_m, 0, 1e-6);
      // Cells 3 apart along rows or columns, or 2 and 2 along a diagonal.
      EXPECT_LE(disc.step_m, 0.15 * std::tan(Rad(slope_deg)) + 1e-6);
      EXPECT_NEAR(static_cast<double>(truth.slope_deg.at(100, 90)), slope_deg, 1e-4);
      EXPECT_EQ(SafeDisc(truth, kMiddle, 2.3, {.slope_deg = 10.001}), slope_deg <= 10);
    }
  }
}

TEST(GroundTruth, ABoxIsAStepOfItsHeight) {
  for (const double height_m : {0.05, 0.12, 0.3, 1.5}) {
    World world;
    world.solids = {MakeBox(0.4, 0.2, 0.5, 0.7, height_m)};
    const GroundTruth truth = TruthOf(world, kSmall);
    const DiscTruth disc = TruthOfDisc(truth, kMiddle, 2.3);
    EXPECT_NEAR(disc.step_m, height_m, 1e-6);
    const auto cell = truth.geometry.CellFromPoint(0.4, 0.2);
    EXPECT_NEAR(static_cast<double>(truth.height_m.at(*cell)), height_m, 1e-6);
    EXPECT_EQ(truth.flags.at(*cell), kThingThere);
    // Its cells are those it lies on; the plane rises by its share of the disc's volume.
    const double share = 0.5 * 0.7 / (M_PI * 2.3 * 2.3);
    EXPECT_NEAR(disc.deviation_m, height_m * (1 - share), 0.15 * height_m);
    EXPECT_EQ(SafeDisc(truth, kMiddle, 2.3, {}), height_m <= 0.1);
    EXPECT_TRUE(SafeDisc(truth, {-2.2, -2.2}, 2.3, {}));
    const auto hazard = NearestHazard(truth, {-2, 0.2}, {.slope_deg = 89});
    ASSERT_EQ(hazard.has_value(), height_m > 0.15);
    if (hazard) {
      EXPECT_STREQ(hazard->what, "step");
      // The southern side of the box lies at 0.15 m; a cell a foot's length before it steps up.
      EXPECT_NEAR(hazard->place_m.x(), 0.15 - 0.15, 0.06);
    }
  }
}

TEST(GroundTruth, AConeHasItsHeightAndItsSlope) {
  const auto cone = [](double n, double e) {
    return std::max(0.0, 0.8 * (1 - std::hypot(n, e) / 4));
  };
  const GroundTruth truth = TruthOf(Relief(cone), kSmall);
  // About the top the plane is level by symmetry; h = 0.8 - 0.2 r has the mean 0.8 - 0.2 * 2 R / 3.
  const DiscTruth top = TruthOfDisc(truth, kMiddle, 1.5);
  EXPECT_NEAR(top.slope_deg, 0, 0.05);
  EXPECT_NEAR(top.deviation_m, 0.2 * 2 * 1.5 / 3, 0.01);
  // Far out on its side it is nearly a plane of atan(0.2).
  const DiscTruth side = TruthOfDisc(truth, {2.5, 0}, 0.5);
  EXPECT_NEAR(side.slope_deg, Deg(std::atan(0.2)), 0.1);
  EXPECT_NEAR(side.step_m, 0.2 * 0.15, 0.004);
}

TEST(GroundTruth, AHoleHasItsDepth) {
  for (const double depth_m : {0.2, 0.35, 0.5}) {
    const World world =
        Relief([&](double n, double e) { return std::hypot(n - 0.5, e) < 0.25 ? -depth_m : 0.0; });
    const GroundTruth truth = TruthOf(world, kSmall);
    const DiscTruth disc = TruthOfDisc(truth, kMiddle, 2.3);
    EXPECT_NEAR(disc.step_m, depth_m, 1e-3);
    EXPECT_NEAR(disc.deviation_m, depth_m, 0.1 * depth_m);
    EXPECT_FALSE(SafeDisc(truth, kMiddle, 2.3, {}));
    EXPECT_NEAR(NearestHazard(truth, kMiddle, {})->distance_m, 0.5 - 0.25 - 0.15, 0.08);
  }
}

TEST(GroundTruth, AKerbIsAStepAndAPaintedLineIsNone) {
  World world;
  world.ground.material = Material{};
  world.ground.patches = {StripPatch({-5, 0}, {5, 0}, 0.15, {.texture = GroundTexture::kPaint})};
  EXPECT_EQ(TruthOfDisc(TruthOf(world, kSmall), kMiddle, 2.3).step_m, 0);
  world.solids = {MakeSlab(0, 3, 10, 4, -0.2, 0.14)};
  const GroundTruth truth = TruthOf(world, kSmall);
  EXPECT_NEAR(TruthOfDisc(truth, kMiddle, 2.3).step_m, 0.14, 1e-6);
  EXPECT_EQ(TruthOfDisc(truth, {0, -2}, 2.3).step_m, 0);
  EXPECT_NEAR(TruthOfDisc(truth, {0, 3}, 1.5).step_m, 0, 1e-6) << "on the pavement it is flat";
}

TEST(GroundTruth, WhatIsThinnerThanACellIsThere) {
  World world;
  world.solids = {MakeRod({-3, -3, -0.8}, {3, 2, -0.6}, 0.004),
                  StandingOn(world.ground, Cylinder{0.02, 0.3}, -1.513, 2.487)};
  const GroundTruth truth = TruthOf(world, kSmall);
  for (int i = 0; i <= 100; ++i) {
    const double s = i / 100.0;
    const auto cell = truth.geometry.CellFromPoint(-3 + 6 * s, -3 + 5 * s);
    EXPECT_NEAR(static_cast<double>(truth.height_m.at(*cell)), 0.8 - 0.2 * s, 0.01) << i;
  }
  EXPECT_NEAR(static_cast<double>(truth.height_m.at(*truth.geometry.CellFromPoint(-1.513, 2.487))),
              0.3, 1e-6);
  EXPECT_FALSE(SafeDisc(truth, kMiddle, 2.3, {}));
}

TEST(GroundTruth, WaterAndWhatMovesAreNeverSafe) {
  World world;
  world.ground.material = Material{};
  world.ground.patches = {DiscPatch(1, 1, 0.5, {.texture = GroundTexture::kWater})};
  GroundTruth truth = TruthOf(world, kSmall);
  const DiscTruth disc = TruthOfDisc(truth, kMiddle, 2.3);
  EXPECT_NEAR(disc.water_share, 0.25 / (2.3 * 2.3), 0.002);
  EXPECT_FALSE(SafeDisc(truth, kMiddle, 2.3, {}));
  EXPECT_STREQ(NearestHazard(truth, kMiddle, {})->what, "water");
  EXPECT_NEAR(NearestHazard(truth, kMiddle, {})->distance_m, std::sqrt(2) - 0.5, 0.05);
  // A later patch covers the water.
  world.ground.patches.push_back(DiscPatch(1, 1, 0.6, Material{}));
  EXPECT_TRUE(SafeDisc(TruthOf(world, kSmall), kMiddle, 2.3, {}));

  world.solids = {MakeBox(0, 0, 0.3, 0.3, 0.05)};
  EXPECT_TRUE(SafeDisc(TruthOf(world, kSmall), kMiddle, 2.3, {}));
  world.solids[0].v_WO = {1, 0, 0};
  EXPECT_FALSE(SafeDisc(TruthOf(world, kSmall), kMiddle, 2.3, {}));
  EXPECT_TRUE(SafeDisc(TruthOf(world, kSmall, 4.0), kMiddle, 2.3, {})) << "it has gone by then";
}

TEST(GroundTruth, LeavesAreSoftAndCount) {
  World world;
  Solid bush = MakeBox(0, 0, 0.4, 0.4, 0.5);
  bush.soft = true;
  world.solids = {bush};
  const GroundTruth truth = TruthOf(world, kSmall);
  const auto& flags = truth.flags.cells();
  const auto soft = std::count_if(flags.begin(), flags.end(),
                                  [](unsigned flag) { return (flag & kSoftThere) != 0; });
  EXPECT_NEAR(static_cast<double>(soft) * kSmall.cell_m * kSmall.cell_m, 0.16, 0.1);
  EXPECT_FALSE(SafeDisc(truth, kMiddle, 2, {}));
}

TEST(GroundTruth, BeyondTheGridNothingIsKnown) {
  const GroundTruth truth = TruthOf(World{}, kSmall);
  EXPECT_TRUE(SafeDisc(truth, {2.6, 2.6}, 2.3, {}));
  EXPECT_FALSE(TruthOfDisc(truth, {2.8, 0}, 2.3).known);
  EXPECT_TRUE(std::isnan(TruthOfDisc(truth, {2.8, 0}, 2.3).slope_deg));
  EXPECT_FALSE(SafeDisc(truth, {2.8, 0}, 2.3, {}));
  EXPECT_FALSE(SafeDisc(truth, {100, 0}, 2.3, {}));
}

/// The quick search against the plain question at every place.
TEST(GroundTruth, SafePlacesAreThosePlacesThatAreSafe) {
  World world = Plane(4, 30);
  for (int i = 0; i < 5; ++i) {
    world.solids.push_back(MakeBox(-4 + 2.3 * i, 3.5 - 1.7 * i, 0.3, 0.2, 0.4));
  }
  const GroundTruth truth = TruthOf(world, kSmall);
  const SafePlaces places = FindSafePlaces(truth, 1.2, {}, 0.5);
  int safe = 0;
  for (int row = 0; row < places.geometry.rows; ++row) {
    for (int col = 0; col < places.geometry.cols; ++col) {
      const Vector2d place(places.geometry.NorthOfRow(row), places.geometry.EastOfCol(col));
      EXPECT_EQ(places.safe.at(row, col) == 1, SafeDisc(truth, place, 1.2, {})) << place;
      safe += places.safe.at(row, col);
    }
  }
  EXPECT_EQ(places.Count(), safe);
  EXPECT_GT(safe, 20);
  EXPECT_LT(safe, 300);
}

}  // namespace
}  // namespace palace
