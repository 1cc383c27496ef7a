// What is said to stand in an approach is what blocks it, where it is.
#include "engine/slad/approach_obstacle.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/slad/hazards/hazard_maps.h"
#include "tests/slad/seen_from_the_south.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Context;
using testing::Flat;
using testing::MakeMap;
using Kind = ApproachObstacle::Kind;

constexpr double kCell_m = 0.15;

std::optional<ApproachObstacle> InTheWay(const ElevationMap& map, const SiteContext& context,
                                         const SladSettings& settings = {}) {
  const auto site =
      RecheckSite(map, EvaluateHazards(map, settings), settings, LandingSite{}, context);
  EXPECT_TRUE(site);
  return FindApproachObstacle(map, settings, context, *site);
}

// The vehicle comes from each of eight sides; between it and the site a wall, and a higher one
// behind that.
TEST(ApproachObstacle, IsTheFirstThingThatStandsOnTheWay) {
  for (int side = 0; side < 8; ++side) {
    SCOPED_TRACE(side);
    const double bearing_rad = side * Rad(45);
    const auto walls = [=](double n, double e) {
      const double along = n * std::cos(bearing_rad) + e * std::sin(bearing_rad);
      return std::abs(along - 5) < 0.3 ? 6.0 : std::abs(along - 7) < 0.3 ? 8.0 : 0.0;
    };
    SiteContext context = Context();
    context.p_WB = {15 * std::cos(bearing_rad), 15 * std::sin(bearing_rad), -15};
    const auto found = InTheWay(MakeMap(121, 121, kCell_m, walls), context);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->kind, Kind::kStands);
    EXPECT_NEAR(found->top_m, 6, 1e-5);
    const double along_m = found->distance_m * std::cos(found->bearing_rad - bearing_rad);
    EXPECT_NEAR(along_m, 4.7, 2 * kCell_m);
    EXPECT_LT(found->distance_m, 7);
  }
}

// A wire across the way, over a low wall that is flown over: the wire is what is named.
TEST(ApproachObstacle, AWireIsNamedWithItsHeight) {
  for (const float top_m : {7.0F, 12.0F, HUGE_VALF}) {
    ElevationMap map = MakeMap(121, 121, kCell_m,
                               [](double n, double) { return std::abs(n + 7) < 0.3 ? 1.0 : 0.0; });
    map.thin_top_m = GridF(121, 121, kUnknownValue);
    for (int r = 0; r < 121; ++r) {
      for (int c = 0; c < 121; ++c) {
        if (std::abs(map.geometry.NorthOfRow(r) + 7) < 0.2) {
          map.thin_top_m.at(r, c) = top_m;
        }
      }
    }
    const auto found = InTheWay(map, Context());
    ASSERT_TRUE(found);
    EXPECT_EQ(found->kind, Kind::kThin);
    EXPECT_EQ(found->top_m, static_cast<double>(top_m));
    EXPECT_NEAR(found->distance_m * std::cos(found->bearing_rad), -6.8, 2 * kCell_m);
  }
}

// As in ApproachTest: a mast higher than the vehicle, beside the corridor of the planned course.
TEST(ApproachObstacle, OnTheLevelWayItIsSaidToBeThere) {
  const auto mast = [](double n, double e) {
    return std::hypot(n + 4.5, e + 4.5) < 0.3 ? 12.0 : 0.0;
  };
  SiteContext context = Context();
  context.p_WB = context.X_WC.p = {-9, 0, -9};
  context.approach_heading_rad = Rad(90);  // from the west
  SladSettings settings;
  settings.lander.rotor_diameter_m = 2;
  const auto found = InTheWay(MakeMap(121, 121, kCell_m, mast), context, settings);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Kind::kOnLevelWay);
}

TEST(ApproachObstacle, NothingStandsInAClearOne) {
  EXPECT_FALSE(InTheWay(MakeMap(121, 121, kCell_m, Flat()), Context()));
}

}  // namespace
}  // namespace palace
