// What stands above its surroundings with a drop around it, and what does not.
#include "engine/slad/terrain/raised_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/slad/slad.h"
#include "tests/slad/raised_reference.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::Height;
using testing::MakeMap;
using testing::Slope;
using testing::WithBox;
using testing::WithMode;

/// A rectangle raised on other ground.
Height WithRectangle(Height ground, double north_m, double east_m, double height_m, double n0 = 0,
                     double e0 = 0) {
  return [=](double n, double e) {
    const bool on = std::abs(n - n0) <= north_m / 2 && std::abs(e - e0) <= east_m / 2;
    return ground(n, e) + (on ? height_m : 0.0);
  };
}
/// A platform 4 m wide that its ramp leads up to over `share` of a turn.
Height PlatformWithRamp(double height_m, double share, double gradient) {
  return [=](double n, double e) {
    const double radius = std::hypot(n, e), turn = (std::atan2(e, n) + M_PI) / (2 * M_PI);
    if (radius <= 2) {
      return height_m;
    }
    return turn < share ? std::max(0.0, height_m - (radius - 2) * gradient) : 0.0;
  };
}
double Mound(double n, double e) { return std::max(0.0, 2.4 - 0.8 * std::hypot(n, e)); }
double Plateau(double n, double) { return n > -0.5 ? 4.0 : 0.0; }
double Hill(double n, double e) { return 2.0 * std::exp(-(n * n + e * e) / 18); }
double Terrace(double n, double) { return n > 0 ? 1.2 : 0.0; }
double Bank(double n, double) { return std::clamp(n * 0.6, 0.0, 2.0); }
double Pit(double n, double e) { return std::hypot(n, e) < 2 ? -1.0 : 0.0; }
double Stairs(double n, double) { return 0.16 * std::floor(n / 0.3); }
double Ditch(double n, double) { return std::abs(n) < 0.6 ? -0.8 : 0.0; }
double Wave(double n, double e) { return 0.4 * std::sin(n / 1.3) * std::cos(e / 1.7); }

struct World {
  std::string name;
  Height height;
  bool raised;  ///< at the origin
  double cell_m = 0.15;
};

std::vector<World> Worlds() {
  const Height slope = Slope(Rad(10), 0.7);
  return {{"table", WithBox(Flat(), 0, 0, 1.5, 0.75), true},
          {"vehicle_on_a_slope", WithRectangle(slope, 4.5, 1.8, 1.5), true},
          {"roof", WithRectangle(Flat(40), 8, 6, 3), true},
          {"roof_on_a_slope", WithRectangle(slope, 6, 6, 3), true},
          {"pitched_roof",
           [](double n, double e) {
             return std::abs(n) < 3 && std::abs(e) < 4 ? 3.5 - 0.5 * std::abs(n) : 0.0;
           },
           true},
          {"roof_in_the_corner", WithRectangle(Flat(), 10, 10, 4, 4, 4), true},
          {"crate_on_a_roof", WithBox(WithRectangle(Flat(), 9, 9, 3), 0, 0, 1.2, 0.8), true},
          {"platform_with_a_narrow_ramp", PlatformWithRamp(1, 0.15, 0.25), true},
          {"platform_with_a_wide_ramp", PlatformWithRamp(1, 0.6, 0.25), false},
          {"platform_with_a_wide_steep_ramp", PlatformWithRamp(1.5, 0.6, 0.7), false},
          {"platform_6_m", WithRectangle(Flat(), 6.4, 6.4, 1.1), true},
          {"steep_mound", Mound, false},
          {"plateau_over_half_the_map", Plateau, false},
          {"plain", Flat(-3), false},
          {"steep_slope", Slope(Rad(35), 2), false},
          {"hill", Hill, false},
          {"terrace", Terrace, false},
          {"bank", Bank, false},
          {"pit", Pit, false},
          {"stairs", Stairs, false},
          {"ditch", [](double n, double e) { return Ditch(n - 2, e); }, false},
          {"waves", Wave, false},
          {"kerb", WithBox(Flat(), 0, 0, 4, 0.15), false},
          {"beside_a_roof", WithRectangle(Flat(), 6, 5, 3, 4, 4), false},
          {"hall_36_m", WithBox(Flat(), 0, 0, 36, 6), true, 0.6},
          {"mesa_44_m_is_beyond_the_limit", WithBox(Flat(), 0, 0, 44, 6), false, 0.6},
          {"survey_cells", WithBox(Flat(), 0, 0, 12, 4), true, 1.0}};
}

class RaisedSurfaces : public ::testing::TestWithParam<double> {};

TEST_P(RaisedSurfaces, AreToldFromGround) {
  const double sigma_m = GetParam();
  for (const World& world : Worlds()) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(world.name + ", seed " + std::to_string(seed));
      const ElevationMap map = MakeMap(100, 100, world.cell_m, world.height, sigma_m, seed);
      const Grid<std::uint8_t> flags = FindRaisedSurfaces(map);
      ASSERT_EQ(flags.rows(), 100);
      for (int r = 49; r <= 50; ++r) {
        for (int c = 49; c <= 50; ++c) {
          EXPECT_EQ(flags.at(r, c), world.raised ? kFlagElevated : kFlagNone);
        }
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Noise, RaisedSurfaces, ::testing::Values(0.0, 0.03, 0.08));

TEST(RaisedSurface, FlagsTheTopToItsEdgeAndNoGround) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const ElevationMap map =
        MakeMap(100, 100, 0.15, WithRectangle(Slope(Rad(4), 1), 4.5, 1.8, 1.4), 0.04, seed);
    const Grid<std::uint8_t> flags = FindRaisedSurfaces(map);
    int missed = 0, wrong = 0, top = 0;
    for (int r = 0; r < 100; ++r) {
      for (int c = 0; c < 100; ++c) {
        const bool on = std::abs(map.geometry.NorthOfRow(r)) <= 2.25 &&
                        std::abs(map.geometry.EastOfCol(c)) <= 0.9;
        top += on ? 1 : 0;
        missed += on && flags.at(r, c) == 0 ? 1 : 0;
        wrong += !on && flags.at(r, c) != 0 ? 1 : 0;
      }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_LE(missed, top / 10);
  }
}

// What stands out is raised to the rays before it, on the top layer only: no ramp up to the roof.
TEST(RaisedSurface, AFootRaisedToItsRaysHidesNoDrop) {
  const Height roof = WithRectangle(Flat(), 6, 5, 3);
  ElevationMap map = MakeMap(100, 100, 0.15, roof, 0.03);
  map.measured_m = map.height_m;
  map.height_m = MakeMap(100, 100, 0.15, [&](double n, double e) {
                   const double before_m = std::max(std::abs(n) - 3, std::abs(e) - 2.5);
                   return std::max(roof(n, e), 3 - std::max(0.0, before_m));
                 }).height_m;
  const Grid<std::uint8_t> flags = FindRaisedSurfaces(map);
  for (int r = 0; r < 100; ++r) {
    for (int c = 0; c < 100; ++c) {
      const bool on = roof(map.geometry.NorthOfRow(r), map.geometry.EastOfCol(c)) > 0;
      EXPECT_EQ(flags.at(r, c), on ? kFlagElevated : kFlagNone) << r << " " << c;
    }
  }
}

TEST(RaisedSurface, NoiseAloneRaisesNothing) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const double sigma_m = 0.02 * static_cast<double>(seed % 10 + 1);
    const ElevationMap map = MakeMap(100, 100, 0.15, Slope(Rad(6), 0.3), sigma_m, seed);
    const Grid<std::uint8_t> flags = FindRaisedSurfaces(map);
    EXPECT_EQ(std::count(flags.cells().begin(), flags.cells().end(), kFlagNone), 10000)
        << "sigma " << sigma_m << " m, seed " << seed;
  }
}

TEST(RaisedSurface, TurnsWithTheWorld) {
  const auto world = [](double n, double e) {
    return WithRectangle(Slope(Rad(5), 0.4), 3, 2, 1.2, 1.5, -2)(n, e);
  };
  // Even numbers of coarse cells, so that the turned map falls into the same blocks.
  const ElevationMap map = MakeMap(80, 80, 0.15, world);
  const ElevationMap turned =
      MakeMap(80, 80, 0.15, [&](double n, double e) { return world(e, -n); });
  const Grid<std::uint8_t> flags = FindRaisedSurfaces(map), after = FindRaisedSurfaces(turned);
  int raised = 0;
  for (int r = 0; r < 80; ++r) {
    for (int c = 0; c < 80; ++c) {
      // (n, e) of the turned world shows (e, -n) of the first.
      EXPECT_EQ(after.at(r, c), flags.at(79 - c, r)) << r << ", " << c;
      raised += flags.at(r, c) != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(raised, 100);
}

TEST(RaisedSurface, AnyMapIsTaken) {
  EXPECT_TRUE(FindRaisedSurfaces({}).empty());
  for (const auto& [rows, cols] : {std::pair{1, 1}, {1, 40}, {40, 1}, {2, 2}, {3, 700}}) {
    for (const double cell_m : {1e-3, 0.15, 50.0}) {
      ElevationMap map = MakeMap(rows, cols, cell_m, Hill, 0.1);
      EXPECT_EQ(FindRaisedSurfaces(map).cols(), cols);
      std::fill(map.state.cells().begin(), map.state.cells().end(), CellState::kUnknown);
      const Grid<std::uint8_t> flags = FindRaisedSurfaces(map);
      EXPECT_EQ(std::count(flags.cells().begin(), flags.cells().end(), kFlagElevated), 0);
    }
  }
}

/// Middle of a roof large enough for the lander.
TEST(RaisedSurface, IsALandingPlaceOnlyWhereAllowed) {
  const ElevationMap map = MakeMap(100, 100, 0.15, WithRectangle(Flat(), 8, 8, 3));
  SladSettings settings = WithMode(SladMode::kModern);
  HazardMaps hazards = EvaluateHazards(map, settings);
  EXPECT_EQ(hazards.flags.at(50, 50), kFlagElevated);
  EXPECT_EQ(hazards.reasons.at(50, 50), kHazardFlagged);
  EXPECT_GT(hazards.rejected.flagged, 1000);
  settings.limits.elevated = ElevatedSurface::kAllow;
  hazards = EvaluateHazards(map, settings);
  EXPECT_EQ(hazards.flags.at(50, 50), kFlagElevated);
  EXPECT_EQ(hazards.reasons.at(50, 50), kHazardNone);
  EXPECT_GT(hazards.safe_distance_m.at(50, 50), settings.lander.clear_radius_m());
}

/// Beside a wall the ground's own plane decides: level ground is no hazard up to the wall.
TEST(RaisedSurface, LeavesTheGroundBesideItAlone) {
  const ElevationMap map = MakeMap(60, 60, 1.0, WithBox(Slope(Rad(3), 0.5), 0, 0, 20, 5));
  SladSettings settings = WithMode(SladMode::kModern);
  settings.grid.cell_m = 1.0;
  const HazardMaps hazards = EvaluateHazards(map, settings);
  for (int r = 0; r < 60; ++r) {
    for (int c = 0; c < 60; ++c) {
      const bool roof =
          std::abs(map.geometry.NorthOfRow(r)) < 10 && std::abs(map.geometry.EastOfCol(c)) < 10;
      EXPECT_EQ(hazards.reasons.at(r, c) != 0, roof) << r << ", " << c;
      EXPECT_TRUE(roof || std::abs(hazards.slope_rad.at(r, c) - Rad(3)) < 1e-3) << r << ", " << c;
    }
  }
}

TEST(RaisedSurface, AreThePlainOnes) {
  int raised = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RandomStream random(seed, "raised ground");
    const int rows = 1 + random.Index(70), cols = 1 + random.Index(90);
    const double cell_m = std::array{0.07, 0.1, 0.15, 0.4}[std::size_t(seed % 4)];
    ElevationMap map = testing::RandomGround(rows, cols, cell_m, seed);
    for (int boxes = random.Index(8); boxes > 0; --boxes) {
      const Cell corner{random.Index(rows), random.Index(cols)};
      const int wide = 1 + random.Index(12);
      const float height_m = float(random.Uniform(0.2, 3));
      for (int k = 0; k < wide * wide; ++k) {
        const Cell cell{corner.row + k / wide, corner.col + k % wide};
        if (map.geometry.Contains(cell)) {
          map.height_m.at(cell) += height_m;
        }
      }
    }
    const Grid<std::uint8_t> fast = FindRaisedSurfaces(map),
                             plain = testing::PlainRaised(map).Run();
    ASSERT_EQ(fast.cells(), plain.cells()) << seed;
    raised += int(std::count(fast.cells().begin(), fast.cells().end(), kFlagElevated));
  }
  EXPECT_GT(raised, 1000);
}

}  // namespace
}  // namespace palace
