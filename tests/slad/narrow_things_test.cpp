// What a map takes over of narrow things, from fields in closed form.
#include "engine/slad/terrain/narrow_things.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slad/fine_field.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::FineField;
using testing::Flat;
using testing::Height;
using testing::MakeMap;
using testing::Slope;
using testing::ThesisCamera;
using testing::WithBox;

constexpr double kPlace_m = 0.01;
const Eigen::Vector3d kAbove(0, 0, -10);

/// The map of such ground, of which it is remembered what `stood` out.
ElevationMap SeenAgain(const Height& ground, Grid<std::uint8_t>& stood,
                       const Eigen::Vector3d& p_WC = kAbove, double place_m = kPlace_m,
                       double repeated_m = 0, const Height& laid = Flat()) {
  ElevationMap map = MakeMap(60, 60, 0.15, Flat(), 0.005);
  map.measured_m = map.height_m;
  const PinholeCamera camera = ThesisCamera();
  TakeNarrowThings(FineField(map.geometry, ground, place_m, 1, laid), {camera, p_WC},
                   GridF(60, 60, static_cast<float>(repeated_m * repeated_m)), stood, map);
  return map;
}

Grid<std::uint8_t> NothingStood() { return Grid<std::uint8_t>(120, 120, 0); }

ElevationMap Seen(const Height& ground, const Eigen::Vector3d& p_WC = kAbove,
                  double place_m = kPlace_m, double repeated_m = 0, const Height& laid = Flat()) {
  Grid<std::uint8_t> stood = NothingStood();
  return SeenAgain(ground, stood, p_WC, place_m, repeated_m, laid);
}

/// Place whose square lies about the point, on the corner of two places.
Cell PlaceAt(double north_m, double east_m) {
  return {static_cast<int>(std::lround((4.5 - north_m) / 0.075)),
          static_cast<int>(std::lround((east_m + 4.5) / 0.075))};
}

TEST(NarrowThings, OverBareGroundTheyAreNormalWithTheSigmaThatIsStated) {
  for (const Height& ground : {Flat(), Slope(Rad(15), 2)}) {
    const ElevationMap map = Seen(ground);
    std::vector<double> sigmas;
    for (std::size_t i = 0; i < map.narrow.prominence_m.cells().size(); ++i) {
      const auto shown_m = static_cast<double>(map.narrow.prominence_m.cells()[i]);
      if (!std::isnan(shown_m)) {
        sigmas.push_back(std::abs(shown_m) / static_cast<double>(map.narrow.noise_m.cells()[i]));
      }
    }
    ASSERT_GT(sigmas.size(), 12000u);
    std::sort(sigmas.begin(), sigmas.end());
    EXPECT_NEAR(sigmas[sigmas.size() / 2], 0.674, 0.04);
    EXPECT_NEAR(sigmas[sigmas.size() * 99 / 100], 2.58, 0.15);
    const ElevationMap before = MakeMap(60, 60, 0.15, Flat(), 0.005);
    int moved = 0;
    for (std::size_t i = 0; i < before.height_m.cells().size(); ++i) {
      moved += map.height_m.cells()[i] != before.height_m.cells()[i] ? 1 : 0;
    }
    EXPECT_LE(moved, 8) << "of 14,400 places one stands four sigmas off by chance";
  }
}

TEST(NarrowThings, AThingShowsItselfAgainstThePlaneAround) {
  for (const double thing_m : {0.12, -0.12}) {
    const ElevationMap map = Seen(WithBox(Slope(Rad(10), 1), 0, 0, 0.16, thing_m));
    const Cell at = PlaceAt(0, 0);
    EXPECT_NEAR(map.narrow.prominence_m.at(at), thing_m, 0.02);
    EXPECT_NEAR(map.narrow.sigma_m.at(at), kPlace_m / 2, 0.3 * kPlace_m) << "four places";
    EXPECT_EQ(map.narrow.ring_m, 4.5 * 0.15);
  }
}

TEST(NarrowThings, TheShareIsThatOfAThing18CmAcross) {
  const double gradient_m = 3 / ThesisCamera().fx_px * 10;
  const double share = 0.8 / (1 + (gradient_m * gradient_m + 0.15 * 0.15) / (0.18 * 0.18));
  EXPECT_NEAR(Seen(Flat()).narrow.share.at(PlaceAt(0, 0)), share, 1e-3);
  EXPECT_LT(Seen(Flat(), {0, 0, -40}).narrow.share.at(PlaceAt(0, 0)), 0.8 * share);
}

TEST(NarrowThings, NoMoreIsClaimedThanWhatNoFramesAverageAway) {
  const Cell at = PlaceAt(0, 0);
  const ElevationMap map = Seen(Flat(), kAbove, kPlace_m, 0.03);
  const double said_m = std::hypot(kPlace_m / 2, 0.03);
  EXPECT_NEAR(map.narrow.sigma_m.at(at), said_m, 0.001);
  EXPECT_NEAR(map.narrow.noise_m.at(at), said_m, 0.001);
  // What stands out is told by the noise of the pictures alone.
  const ElevationMap thing = Seen(WithBox(Flat(), 0, 0, 0.3, 0.12), kAbove, kPlace_m, 0.03);
  const auto cell = thing.geometry.CellFromPoint(0, 0);
  EXPECT_GT(thing.height_m.at(*cell), 0.1);
  EXPECT_LT(0.12, 4.5 * said_m);
}

TEST(NarrowThings, BumpsAroundAreNoiseToo) {
  const Cell at = PlaceAt(0, 0);
  RandomStream random(4, "bumps");
  std::vector<double> bumps_m(61 * 61);
  for (double& bump_m : bumps_m) {
    bump_m = 0.03 * random.Normal();
  }
  const ElevationMap bumpy = Seen([&](double n, double e) {
    return bumps_m[static_cast<std::size_t>((n + 4.5) / 0.15) * 61 +
                   static_cast<std::size_t>((e + 4.5) / 0.15)];
  });
  EXPECT_GT(bumpy.narrow.sigma_m.at(at), 0.015);
  EXPECT_LT(bumpy.narrow.noise_m.at(at), 0.01);
}

TEST(NarrowThings, RaiseTheTopNeverTheMeasuredGround) {
  const ElevationMap rock = Seen(WithBox(Flat(), 0, 0, 0.16, 0.12));
  const Cell at = *rock.geometry.CellFromPoint(0.01, 0.01);
  EXPECT_GT(rock.height_m.at(at), 0.12);
  EXPECT_LT(rock.height_m.at(at), 0.3);
  const ElevationMap hole = Seen(WithBox(Flat(), 0, 0, 0.3, -0.12));
  EXPECT_LT(hole.height_m.at(at), -0.11);
  for (const ElevationMap* map : {&rock, &hole}) {
    EXPECT_EQ(map->measured_m.cells(), MakeMap(60, 60, 0.15, Flat(), 0.005).height_m.cells());
  }
  const ElevationMap noise = Seen(WithBox(Flat(), 0, 0, 0.16, 0.12), kAbove, 0.2);
  EXPECT_LT(noise.height_m.at(at), 0.05) << "not told from noise";
}

TEST(NarrowThings, SeenAslantTheGroundBeforeAThingRisesToItsRays) {
  // From the south, 45 degrees: 0.2 m rise over 0.2 m of ground.
  const ElevationMap map = Seen(WithBox(Flat(), 0.075, 0.075, 0.16, 0.12), {-10, 0.075, -10});
  const auto top_m = [&](double north_m, double east_m) {
    return static_cast<double>(map.height_m.at(*map.geometry.CellFromPoint(north_m, east_m)));
  };
  EXPECT_GT(top_m(-0.075, 0.075), 0.08);
  EXPECT_LT(top_m(-0.675, 0.075), 0.03);
  EXPECT_LT(top_m(0.375, 0.075), 0.03) << "behind it nothing rises";
}

TEST(NarrowThings, WhatWasLaidWhereItStandsRaisesNothingBeforeIt) {
  // Low beside a box that stereo measured, 30 degrees: its rays take 1.2 m to rise by its height.
  const Height box = WithBox(Flat(), 0.075, 0.075, 0.6, 0.7);
  const auto top_m = [&](const Height& laid) {
    const ElevationMap map = Seen(box, {-8.7, 0.075, -5}, kPlace_m, 0, laid);
    return static_cast<double>(map.height_m.at(*map.geometry.CellFromPoint(-0.825, 0.075)));
  };
  EXPECT_GT(top_m(Flat()), 0.3) << "laid behind it";
  EXPECT_LT(top_m(box), 0.03) << "laid on it";
}

/// North of 1 m a roof of that height.
Height BesideARoof(const Height& ground, double roof_m) {
  return [=](double n, double e) { return n > 1 ? roof_m : ground(n, e); };
}

TEST(NarrowThings, LevelGroundBesideARoofAWallOrARockIsNoHole) {
  for (const double roof_m : {0.4, 1.0, 3.0}) {
    const ElevationMap map = Seen(BesideARoof(Flat(), roof_m));
    // Nearer, the widest squares reach over its edge.
    for (double north_m = 0.525; north_m > -0.8; north_m -= 0.15) {
      const Cell cell = *map.geometry.CellFromPoint(north_m, 0);
      EXPECT_NEAR(map.height_m.at(cell), map.measured_m.at(cell), 0.02)
          << "roof " << roof_m << " m, ground " << 1 - north_m << " m before it";
    }
  }
  const ElevationMap rock = Seen(WithBox(Flat(), 0, 0, 0.45, 0.6));
  for (const double east_m : {0.6, 0.75}) {
    const Cell cell = *rock.geometry.CellFromPoint(0, east_m);
    EXPECT_NEAR(rock.height_m.at(cell), rock.measured_m.at(cell), 0.02) << east_m;
  }
}

// Seen from hardly higher than the roof that it stands on, whose rays rise by its height over 2.4 m.
TEST(NarrowThings, AThingOnARoofRaisesNotTheStreetBeforeIt) {
  const Height roof = BesideARoof(Flat(), 3);
  const ElevationMap map =
      Seen(WithBox(roof, 1.575, 0.075, 0.16, 0.12), {-8.4, 0.075, -3.5}, kPlace_m, 0, roof);
  const auto top_m = [&](double north_m) {
    return static_cast<double>(map.height_m.at(*map.geometry.CellFromPoint(north_m, 0.075)));
  };
  EXPECT_GT(top_m(1.575), 3.1);
  // Nearer, the widest squares reach over its edge.
  for (double north_m = 0.525; north_m > -1.5; north_m -= 0.15) {
    EXPECT_LT(top_m(north_m), 0.03) << north_m;
  }
}

TEST(NarrowThings, AThingBesideARoofStandsOutAllTheSame) {
  for (const double thing_m : {0.15, -0.15}) {
    const ElevationMap map = Seen(BesideARoof(WithBox(Flat(), 0.375, 0, 0.16, thing_m), 3));
    const Cell cell = *map.geometry.CellFromPoint(0.375, 0);
    EXPECT_GT(std::copysign(1, thing_m) * (map.height_m.at(cell) - map.measured_m.at(cell)), 0.12)
        << thing_m;
  }
}

TEST(NarrowThings, WhatStoodOutStaysUntilItFallsClearlyBelow) {
  // A square of four places is known to 1.5 cm: some 4 sigmas, then 3.
  for (const double thing_m : {0.04, 0.024}) {
    const Height ground = WithBox(Flat(), 0, 0, 0.16, thing_m);
    const Cell cell = *Seen(Flat()).geometry.CellFromPoint(0.01, 0.01), place = PlaceAt(0, 0);
    const ElevationMap first = Seen(ground, kAbove, 0.03);
    const double sigmas = static_cast<double>(first.narrow.prominence_m.at(place)) /
                          static_cast<double>(first.narrow.sigma_m.at(place));
    const bool stays = sigmas > 3.5;
    ASSERT_LT(sigmas, 4.5);
    ASSERT_EQ(stays, thing_m > 0.03) << sigmas;
    EXPECT_NEAR(first.height_m.at(cell), first.measured_m.at(cell), 1e-6) << sigmas;
    Grid<std::uint8_t> stood = NothingStood();
    for (std::uint8_t& bits : stood.cells()) {
      bits = 4;  // of the narrowest squares
    }
    const ElevationMap again = SeenAgain(ground, stood, kAbove, 0.03);
    EXPECT_EQ(again.height_m.at(cell) > again.measured_m.at(cell) + 0.04F, stays) << sigmas;
    EXPECT_EQ(stood.at(place) != 0, stays) << sigmas;
  }
}

TEST(NarrowThings, WhatStandsAMetreOffIsNotNarrow) {
  const ElevationMap map = Seen(WithBox(Flat(), 0, 0, 0.16, 3));
  EXPECT_TRUE(std::isnan(map.narrow.prominence_m.at(PlaceAt(0, 0))));
}

}  // namespace
}  // namespace palace
