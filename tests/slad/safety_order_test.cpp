// What must never make the verdict safer: a rock, a hole, a flag, a stricter limit, a larger
// lander. Terrains are random, their seeds printed with every failure.
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "engine/slad/slad.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;
using testing::RandomGround;
using testing::WithBox;
using testing::WithMode;

constexpr double kCell_m = 0.15;
constexpr std::array kModes = {SladMode::kThesis, SladMode::kModern};

std::string Label(SladMode mode, std::uint64_t seed) {
  return std::string(mode == SladMode::kThesis ? "thesis" : "modern") + " seed " +
         std::to_string(seed);
}

/// Cells safer in `after` than in `before`.
struct Safer {
  int freed = 0;     ///< a hazard before, none now
  int farther = 0;   ///< farther from the nearest hazard
  int likelier = 0;  ///< of higher safe probability
};

Safer SaferCells(const HazardMaps& before, const HazardMaps& after) {
  Safer safer;
  for (std::size_t i = 0; i < before.reasons.cells().size(); ++i) {
    safer.freed += before.reasons.cells()[i] != 0 && after.reasons.cells()[i] == 0 ? 1 : 0;
    safer.farther +=
        after.safe_distance_m.cells()[i] > before.safe_distance_m.cells()[i] + 1e-5F ? 1 : 0;
    safer.likelier +=
        after.safe_probability.cells()[i] > before.safe_probability.cells()[i] + 1e-5F ? 1 : 0;
  }
  return safer;
}

void ExpectNoneSafer(const HazardMaps& before, const HazardMaps& after) {
  const Safer safer = SaferCells(before, after);
  EXPECT_EQ(safer.freed, 0);
  EXPECT_EQ(safer.farther, 0);
  EXPECT_EQ(safer.likelier, 0);
  EXPECT_LE(after.safe_cells, before.safe_cells);
}

struct StricterLimit {
  const char* name;
  std::function<void(SladSettings&)> tighten;
};

class Stricter : public ::testing::TestWithParam<StricterLimit> {};

TEST_P(Stricter, LimitMakesNoCellSafer) {
  for (const SladMode mode : kModes) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      SCOPED_TRACE(Label(mode, seed));
      const ElevationMap map = RandomGround(64, 72, kCell_m, seed);
      SladSettings settings = WithMode(mode);
      HazardMaps before = EvaluateHazards(map, settings);
      for (int step = 0; step < 4; ++step) {
        GetParam().tighten(settings);
        HazardMaps after = EvaluateHazards(map, settings);
        ExpectNoneSafer(before, after);
        before = std::move(after);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Limits, Stricter,
    ::testing::Values(
        StricterLimit{"slope", [](SladSettings& s) { s.limits.max_slope_deg *= 0.8; }},
        StricterLimit{"deviation", [](SladSettings& s) { s.limits.max_deviation_m *= 0.75; }},
        StricterLimit{"step", [](SladSettings& s) { s.limits.max_step_m *= 0.75; }},
        StricterLimit{"probability",
                      [](SladSettings& s) {
                        s.limits.min_safe_probability = 1 - (1 - s.limits.min_safe_probability) / 3;
                      }},
        StricterLimit{"nav_error", [](SladSettings& s) { s.lander.nav_error_m += 0.3; }},
        StricterLimit{"belly", [](SladSettings& s) { s.lander.belly_clearance_m *= 0.7; }}),
    [](const auto& row) { return row.param.name; });

TEST(SafetyOrder, SmallerLanderHasNoFewerPlacesAmongRocks) {
  // On even ground: on wavy ground a smaller base rests on steeper ground, as it should.
  for (const SladMode mode : kModes) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(Label(mode, seed));
      RandomStream random(seed, "rocks");
      testing::Height world = testing::Slope(Rad(random.Uniform(0, 6)), random.Uniform(0, 6.28));
      for (int rock = 0; rock < 6; ++rock) {
        world = WithBox(world, random.Uniform(-6, 6), random.Uniform(-6, 6),
                        random.Uniform(0.3, 0.8), random.Uniform(0.3, 1.0));
      }
      const ElevationMap map = MakeMap(90, 90, kCell_m, world, 0.005, seed);
      SladSettings settings = WithMode(mode);
      int larger_lander = 0;
      for (const double size_m : {6.0, 4.8, 3.6, 2.4, 1.5}) {
        settings.lander.base_size_m = size_m;
        settings.lander.gear_length_m = size_m / 3;
        settings.lander.gear_width_m = size_m / 4;
        const int safe_cells = EvaluateHazards(map, settings).safe_cells;
        EXPECT_GE(safe_cells, larger_lander) << size_m << " m";
        larger_lander = safe_cells;
      }
      EXPECT_GT(larger_lander, 0);
    }
  }
}

/// Ground with a rock put on it where it was clear; the same ground where there is no room.
ElevationMap WithRock(ElevationMap map, const HazardMaps& hazards, RandomStream& random) {
  const double n = random.Uniform(-4.5, 4.5), e = random.Uniform(-5, 5);
  const auto rock = WithBox(Flat(), n, e, random.Uniform(0.3, 1.2), random.Uniform(0.3, 1.5));
  const ElevationMap bare = map;
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      const double rise_m = rock(map.geometry.NorthOfRow(r), map.geometry.EastOfCol(c));
      map.height_m.at(r, c) += static_cast<float>(rise_m);
      if (rise_m > 0 && hazards.reasons.at(r, c) != kHazardNone) {
        return bare;
      }
    }
  }
  return map;
}

struct Freed {
  int cells = 0;
  int freed = 0;
};

/// Puts rocks on random grounds; `check` sees every cell that was a hazard before and is none now.
Freed PutRocks(
    const SladSettings& settings,
    const std::function<void(const ElevationMap& bare, const ElevationMap& rocky,
                             const HazardMaps& before, const HazardMaps& after, Cell)>& check) {
  Freed count;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(Label(settings.mode, seed));
    ElevationMap map = RandomGround(64, 72, kCell_m, seed);
    HazardMaps before = EvaluateHazards(map, settings);
    RandomStream random(seed, "rocks on ground");
    for (int rock = 0; rock < 4; ++rock) {
      const ElevationMap rocky = WithRock(map, before, random);
      HazardMaps after = EvaluateHazards(rocky, settings);
      for (int r = 0; r < map.geometry.rows; ++r) {
        for (int c = 0; c < map.geometry.cols; ++c) {
          const bool is_freed =
              before.reasons.at(r, c) != kHazardNone && after.reasons.at(r, c) == kHazardNone;
          if (is_freed) {
            check(map, rocky, before, after, {r, c});
          }
          ++count.cells;
          count.freed += is_freed ? 1 : 0;
        }
      }
      map = rocky;
      before = std::move(after);
    }
  }
  return count;
}

// A rock moves the robust plane of the ground beside it by a hair: a cell whose probability was a
// hair below the limit may rise above it, and the foot of an obstacle may fall below a foot's.
// Nothing else may.
TEST(SafetyOrder, RockFreesNothingButCellsOnTheEdgeOfALimit) {
  const SladSettings settings;
  const Freed count =
      PutRocks(settings, [&](const ElevationMap& bare, const ElevationMap& rocky,
                             const HazardMaps& before, const HazardMaps& after, Cell cell) {
        const bool obstacle =
            (before.reasons.at(cell) & (kHazardRoughness | kHazardStep | kHazardUnknown)) != 0;
        const TerrainFigures own = MeasureTerrain(bare, settings);
        const float moved_m =
            own.deviation_m.at(cell) - MeasureTerrain(rocky, settings).deviation_m.at(cell);
        const bool foot = own.deviation_m.at(cell) < 0.5 * settings.limits.max_deviation_m &&
                          own.step_m.at(cell) <= settings.limits.max_step_m &&
                          std::abs(moved_m) < 0.005;
        EXPECT_TRUE(!obstacle || foot) << cell.row << " " << own.deviation_m.at(cell);
        EXPECT_LT(std::abs(before.slope_rad.at(cell) - after.slope_rad.at(cell)),
                  before.slope_sigma_rad.at(cell))
            << cell.row;
      });
  EXPECT_LE(count.freed, count.cells / 300'000);
}

// LMedS follows the majority of nine samples; a rock may turn the majority over. It can do so only
// where its own cells are among the nine.
TEST(SafetyOrder, RockFreesThesisCellsOnlyInWindowsItStandsIn) {
  const SladSettings settings = WithMode(SladMode::kThesis);
  const int stride = static_cast<int>(settings.lander.max_rock_size_m / kCell_m);
  const Freed count = PutRocks(settings, [&](const ElevationMap& bare, const ElevationMap& rocky,
                                             const HazardMaps&, const HazardMaps&, Cell cell) {
    bool touched = false;
    for (int k = 0; k < 9; ++k) {
      const Cell sample{cell.row + (k / 3 - 1) * stride, cell.col + (k % 3 - 1) * stride};
      touched = touched || (bare.geometry.Contains(sample) &&
                            bare.height_m.at(sample) != rocky.height_m.at(sample));
    }
    EXPECT_TRUE(touched) << cell.row << ' ' << cell.col;
  });
  EXPECT_LE(count.freed, count.cells / 10'000);
}

TEST(SafetyOrder, FlaggedCellsMakeNothingSaferAndShadowChangesNothing) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(Label(SladMode::kModern, seed));
    ElevationMap map = RandomGround(64, 72, kCell_m, seed);
    const HazardMaps before = EvaluateHazards(map, SladSettings{});
    RandomStream random(seed, "flags");
    map.flags = Grid<std::uint8_t>(64, 72, kFlagShadow);
    EXPECT_EQ(EvaluateHazards(map, SladSettings{}).reasons.cells(), before.reasons.cells());
    for (const std::uint8_t flag : {kFlagThinStructure, kFlagNoTexture, kFlagMotion}) {
      const Cell cell{random.Index(64), random.Index(72)};
      map.flags.at(cell) |= flag;
      const HazardMaps after = EvaluateHazards(map, SladSettings{});
      ExpectNoneSafer(before, after);
      EXPECT_NE(after.reasons.at(cell) & kHazardFlagged, 0);
    }
  }
}

}  // namespace
}  // namespace palace
