#include "engine/slad/terrain/narrow_relief.h"

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/core/random.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;
using testing::Slope;
using testing::WithBox;

constexpr double kNarrow_m = 0.2;  // so that factors between 1 and 6 show
const PinholeCamera kCamera = PinholeFromFov(640, 480, Rad(60));

ElevationMap RaisedFrom(double camera_height_m, const ElevationMap& map) {
  ElevationMap raised = map;
  RaiseNarrowRelief(kCamera, {0, 0, -camera_height_m}, kNarrow_m, {}, {}, raised);
  return raised;
}

TEST(NarrowRelief, LevelAndSlopingGroundWithNoiseStays) {
  for (const auto& world : {Flat(3), Slope(Rad(12), 0.7)}) {
    const ElevationMap map = MakeMap(80, 80, 0.15, world, 0.02, 4);
    const ElevationMap raised = RaisedFrom(25, map);
    int changed = 0;
    for (std::size_t i = 0; i < map.height_m.cells().size(); ++i) {
      changed += map.height_m.cells()[i] != raised.height_m.cells()[i] ? 1 : 0;
    }
    EXPECT_EQ(changed, 0) << "of 6400 cells";
  }
}

TEST(NarrowRelief, AThingSmallerThanTheWindowGetsItsHeight) {
  const double camera_m = 22;
  const double window_m = 9 * camera_m / kCamera.fx_px;
  const double seen_m = 0.5 * std::pow(kNarrow_m / window_m, 2);
  // The window smears the thing as wide as itself.
  const auto world = WithBox(Slope(Rad(4), 1), 0.075, 0.075, window_m, seen_m);
  const ElevationMap map = MakeMap(60, 60, 0.15, world, 0.005, 2);
  const ElevationMap raised = RaisedFrom(camera_m, map);
  const auto cell = map.geometry.CellFromPoint(0.075, 0.075);
  ASSERT_TRUE(cell);
  const double ground_m = Slope(Rad(4), 1)(0.075, 0.075);
  EXPECT_NEAR(double(map.height_m.at(*cell)) - ground_m, seen_m, 0.02);
  EXPECT_NEAR(double(raised.height_m.at(*cell)) - ground_m, 0.5, 0.08);
}

// A camera that looks down at 45 degrees reads what it reads too low as farther away by as much.
TEST(NarrowRelief, AThingReadTooLowMayStandNearerToTheCamera) {
  const double range_m = 22, window_m = 9 * range_m / kCamera.fx_px;
  const double seen_m = 0.5 * std::pow(kNarrow_m / window_m, 2), missing_m = 0.5 - seen_m;
  const double side_m = range_m / std::sqrt(2.0), half_m = window_m / 2;
  const ElevationMap map =
      MakeMap(80, 80, 0.15, WithBox(Flat(), 0.075, 0.075, window_m, seen_m), 0.002, 2);
  for (const Eigen::Vector2d& from : {Eigen::Vector2d(-1, 0), Eigen::Vector2d(0, 1)}) {
    ElevationMap raised = map;
    const Eigen::Vector3d p_WC(side_m * from.x(), side_m * from.y(), -side_m);
    RaiseNarrowRelief(kCamera, p_WC, kNarrow_m, {}, {}, raised);
    const auto height_at = [&](double along_m) {
      const Eigen::Vector2d at = Eigen::Vector2d(0.075, 0.075) + along_m * from;
      return double(raised.height_m.at(*map.geometry.CellFromPoint(at.x(), at.y())));
    };
    EXPECT_GT(height_at(half_m + 0.15), 0.1) << "in front of what was seen";
    EXPECT_LE(height_at(half_m + 0.15), 0.55) << "no higher than the thing";
    EXPECT_NEAR(height_at(half_m + missing_m + 0.2), 0, 0.01) << "no nearer than its rays allow";
    EXPECT_NEAR(height_at(-half_m - 0.15), 0, 0.01) << "nothing behind it";
  }
}

TEST(NarrowRelief, BelowTheHeightWhereTheWindowIsNarrowNothingChanges) {
  const auto world = WithBox(Flat(), 0, 0, 0.3, 0.4);
  const ElevationMap map = MakeMap(60, 60, 0.15, world, 0.005, 3);
  EXPECT_EQ(RaisedFrom(9, map).height_m.cells(), map.height_m.cells());
  EXPECT_NE(RaisedFrom(30, map).height_m.cells(), map.height_m.cells());
}

// Stereo refuses the steep sides of a cone seen from near: what it leaves is the cone's foot.
TEST(NarrowRelief, AThingWithRefusedSidesRisesFromAnyHeight) {
  const double foot_m = 0.04;
  const ElevationMap map = MakeMap(60, 60, 0.15, WithBox(Flat(), 0, 0, 0.3, foot_m), 0.002, 3);
  const auto middle = map.geometry.CellFromPoint(0.05, 0.05);
  ASSERT_TRUE(middle);
  const auto height_with = [&](float refused) {
    Grid<PixelCount> pixels(60, 60, {100, 0});
    pixels.at(middle->row + 1, middle->col) = {100 - refused, refused};
    ElevationMap raised = map;
    RaiseNarrowRelief(kCamera, {0, 0, -6.0}, kNarrow_m, pixels, {}, raised);
    EXPECT_EQ(raised.height_m.at(5, 5), map.height_m.at(5, 5));
    return double(raised.height_m.at(*middle));
  };
  EXPECT_NEAR(height_with(0), foot_m, 0.01);
  EXPECT_NEAR(height_with(14), foot_m, 0.01);
  EXPECT_NEAR(height_with(16), 4 * foot_m, 0.03);
}

TEST(NarrowRelief, EdgesOfWideThingsStay) {
  const auto ramp = [](double n, double e) {
    return std::abs(n) < 1.5 && std::abs(e) < 1.5 ? 0.3 + 0.1 * n : 0.0;
  };
  for (const testing::Height& world :
       {testing::Height(ramp), WithBox(Slope(Rad(8), 1), 0, 0, 2, 0.5)}) {
    const ElevationMap map = MakeMap(80, 80, 0.15, world, 0.002, 6);
    EXPECT_EQ(RaisedFrom(20, map).height_m.cells(), map.height_m.cells());
  }
}

TEST(NarrowRelief, RoughGroundStaysAndAThingOnItIsRaised) {
  // Heights in 0.15 m cells, from gravel to clods; each bump is many sigmas high.
  for (const double rough_m : {0.01, 0.02, 0.03}) {
    for (const double range_m : {16.0, 20.0, 28.0}) {
      ElevationMap map = MakeMap(200, 200, 0.15, Slope(Rad(4), 2), 0.0, 6);
      RandomStream random(3, "rough ground");
      for (float& height_m : map.height_m.cells()) {
        height_m += static_cast<float>(rough_m * random.Normal());
      }
      const ElevationMap raised = RaisedFrom(range_m, map);
      int moved = 0;
      for (std::size_t i = 0; i < map.height_m.cells().size(); ++i) {
        moved += raised.height_m.cells()[i] == map.height_m.cells()[i] ? 0 : 1;
      }
      // One more than without what lies before them, towards the camera.
      EXPECT_LE(moved, 9) << "of 40,000 cells, rough by " << rough_m << " m from " << range_m;

      for (const Cell cell : {Cell{100, 100}, {100, 101}}) {
        map.height_m.at(cell) = raised.height_m.at(100, 99) + static_cast<float>(8 * rough_m);
      }
      EXPECT_GT(RaisedFrom(range_m, map).height_m.at(100, 100), map.height_m.at(100, 100));
    }
  }
}

TEST(NarrowRelief, RoughnessThatStereoRepeatsIsNoneOfTheGround) {
  ElevationMap map = MakeMap(100, 100, 0.15, Flat(), 0.0, 6);
  RandomStream random(3, "repeated");
  for (float& height_m : map.height_m.cells()) {
    height_m += static_cast<float>(0.02 * random.Normal());
  }
  // 3.5 times as high, on a quiet spot.
  for (int r = 46; r <= 54; ++r) {
    for (int c = 46; c <= 55; ++c) {
      map.height_m.at(r, c) /= 2;
    }
  }
  map.height_m.at(50, 50) = map.height_m.at(50, 51) = 0.07F;
  // 2.5 sigmas are taken off: of 7 mm enough for four roughnesses, of 2 mm not.
  for (const auto& [repeated_m, stands] :
       {std::pair{0.0F, false}, {0.002F, false}, {0.007F, true}}) {
    ElevationMap raised = map;
    RaiseNarrowRelief(kCamera, {0, 0, -20}, kNarrow_m, {}, GridF(100, 100, repeated_m * repeated_m),
                      raised);
    EXPECT_EQ(raised.height_m.at(50, 50) > map.height_m.at(50, 50), stands) << repeated_m;
  }
}

TEST(NarrowRelief, ManyThingsOnEvenGroundDoNotHideEachOther) {
  // Posts 0.8 m apart that the window smears and reads as 6 cm.
  const double gap_m = 0.8, range_m = 20;
  const double smear_m = 9 * range_m / kCamera.fx_px / 3;
  const auto posts = [=](double n, double e) {
    const double dn = n - gap_m * std::round(n / gap_m), de = e - gap_m * std::round(e / gap_m);
    return 0.06 * std::exp(-(dn * dn + de * de) / (2 * smear_m * smear_m));
  };
  for (const double cell_m : {0.15, 0.05, 0.02}) {
    const int cells = static_cast<int>(8 / cell_m);
    const ElevationMap map = MakeMap(cells, cells, cell_m, posts, 0.002, 6);
    const ElevationMap raised = RaisedFrom(range_m, map);
    for (int i = -2; i <= 2; ++i) {
      for (int j = -2; j <= 2; ++j) {
        const auto cell = map.geometry.CellFromPoint(i * gap_m, j * gap_m);
        ASSERT_TRUE(cell);
        EXPECT_GT(raised.height_m.at(*cell), 1.5F * map.height_m.at(*cell))
            << cell_m << " m cells, post " << i << ' ' << j;
      }
    }
  }
}

TEST(NarrowRelief, TheRingLiesOutsideOfWhatTheWindowSmears) {
  const double range_m = 28;
  const double window_m = 9 * range_m / kCamera.fx_px;
  const auto smeared = [=](double n, double e) {
    return std::max(0.0, 0.1 * (1 - std::hypot(n, e) / (1.3 * window_m)));
  };
  const ElevationMap map = MakeMap(121, 121, 0.05, smeared, 0.001, 6);
  const double k = std::pow(window_m / kNarrow_m, 2);
  EXPECT_NEAR(static_cast<double>(RaisedFrom(range_m, map).height_m.at(60, 60)), 0.1 * k, 0.02 * k);
}

TEST(NarrowRelief, ACellThatStandsAloneIsNoise) {
  struct Case {
    float own_sigmas, beside_sigmas;
    bool raised;
  };
  for (const Case& c :
       {Case{7, 3, false}, {7, 5, true}, {5, 6, false}, {12, 1, false}, {12, 3.5F, true}}) {
    ElevationMap map = MakeMap(60, 60, 0.15, Slope(Rad(6), 2), 0.0, 1);
    const float sigma_m = std::sqrt(map.variance_m2.at(0, 0));
    map.height_m.at(30, 30) += c.own_sigmas * sigma_m;
    map.height_m.at(30, 31) += c.beside_sigmas * sigma_m;
    EXPECT_EQ(RaisedFrom(25, map).height_m.at(30, 30) > map.height_m.at(30, 30), c.raised)
        << c.own_sigmas << " and " << c.beside_sigmas << " sigmas";
  }
}

TEST(NarrowRelief, WhatIsTallIsNotMadeTaller) {
  const ElevationMap map = MakeMap(60, 60, 0.15, WithBox(Flat(), 0, 0, 0.14, 3), 0.005, 5);
  const ElevationMap raised = RaisedFrom(30, map);
  for (std::size_t i = 0; i < map.height_m.cells().size(); ++i) {
    EXPECT_LE(raised.height_m.cells()[i], std::max(map.height_m.cells()[i], 1.05F));
  }
}

TEST(NarrowRelief, WideThingsStayAndUnknownStaysUnknown) {
  auto world = WithBox(WithBox(Flat(), 2, 2, 2.5, -0.4), -2, -1, 2.5, 0.3);
  const auto holed = [world](double n, double e) {
    return std::abs(n) < 0.3 && std::abs(e) < 0.3 ? std::nan("") : world(n, e);
  };
  const ElevationMap map = MakeMap(60, 60, 0.15, holed, 0.02, 7);
  const ElevationMap raised = RaisedFrom(30, map);
  for (std::size_t i = 0; i < map.height_m.cells().size(); ++i) {
    const float before = map.height_m.cells()[i], after = raised.height_m.cells()[i];
    ASSERT_EQ(std::isnan(before), std::isnan(after));
  }
  EXPECT_EQ(raised.height_m.at(*map.geometry.CellFromPoint(2, 2)),
            map.height_m.at(*map.geometry.CellFromPoint(2, 2)));
}

// What is bridged was not measured: a hole counts as a rock of that height does.
TEST(NarrowRelief, AHoleIsARockUpsideDown) {
  for (const double depth_m : {0.05, 0.08, 0.15}) {
    const ElevationMap rock =
        MakeMap(60, 60, 0.15, WithBox(Flat(), 0.075, 0.075, 0.3, depth_m), 0.004, 5);
    ElevationMap hole = rock;
    for (float& height_m : hole.height_m.cells()) {
      height_m = -height_m;
    }
    const ElevationMap raised = RaisedFrom(25, rock), lowered = RaisedFrom(25, hole);
    ASSERT_GT(raised.height_m.at(*rock.geometry.CellFromPoint(0.075, 0.075)),
              1.5F * float(depth_m));
    for (std::size_t i = 0; i < rock.height_m.cells().size(); ++i) {
      // The hole is a little farther away, and its window wider.
      ASSERT_NEAR(lowered.height_m.cells()[i], -raised.height_m.cells()[i], 0.03);
    }
  }
}

// A map of known noise says how much of it a cell's prominence holds, and which share a thing
// shows.
TEST(NarrowRelief, FiguresSayWhatAThingWouldShow) {
  const double sigma_m = 0.006, camera_m = 10;
  const ElevationMap map = MakeMap(80, 80, 0.15, Slope(Rad(5), 1), sigma_m, 9);
  const NarrowFigures figures = MeasureNarrowRelief(kCamera, {0, 0, -camera_m}, 0.08, {}, map);
  double square = 0;
  int cells = 0;
  for (int r = 10; r < 70; ++r) {
    for (int c = 10; c < 70; ++c) {
      square += std::pow(double(figures.prominence_m.at(r, c) / figures.sigma_m.at(r, c)), 2);
      ++cells;
    }
  }
  EXPECT_NEAR(square / cells, 1, 0.1);
  const double window_m = 9 * camera_m / kCamera.fx_px;
  EXPECT_NEAR(double(figures.share.at(40, 40)),
              0.8 / (1 + (window_m * window_m + 0.15 * 0.15) / (0.18 * 0.18)), 0.01);
}

// Two false matches beside each other at the rim of a picture, metres below the ground.
TEST(NarrowRelief, AFalseMatchIsNoRingOfThings) {
  const double camera_m = 4;
  const ElevationMap clean = MakeMap(40, 40, 0.15, Slope(Rad(3), 1), 0.005, 9);
  ElevationMap map = clean;
  for (const Cell wild : {Cell{20, 20}, Cell{21, 20}}) {
    map.height_m.at(wild) -= 2.6F;
  }
  const NarrowFigures before = MeasureNarrowRelief(kCamera, {0, 0, -camera_m}, 0.08, {}, clean);
  const NarrowFigures after = MeasureNarrowRelief(kCamera, {0, 0, -camera_m}, 0.08, {}, map);
  for (int r = 10; r < 30; ++r) {
    for (int c = 10; c < 30; ++c) {
      if (std::isnan(after.prominence_m.at(r, c))) {
        EXPECT_TRUE(c == 20 && (r == 20 || r == 21)) << r << ' ' << c;
      } else {
        EXPECT_NEAR(after.prominence_m.at(r, c), before.prominence_m.at(r, c), 0.012)
            << r << ' ' << c;
      }
    }
  }
  EXPECT_TRUE(std::isnan(after.prominence_m.at(20, 20)));
}

}  // namespace
}  // namespace palace
