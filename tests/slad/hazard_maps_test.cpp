#include "engine/slad/hazards/hazard_maps.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "engine/slad/map_hash.h"
#include "engine/slad/slad.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;
using testing::Slope;
using testing::WithBox;
using testing::WithMode;

struct SlopeRow {
  const char* name;
  SladMode mode;
  double slope_deg;
  double azimuth_deg;
  bool safe;
};

class PlaneWorld : public ::testing::TestWithParam<SlopeRow> {};

TEST_P(PlaneWorld, SlopeIsExactEverywhere) {
  const SlopeRow row = GetParam();
  const SladSettings settings = WithMode(row.mode);
  const ElevationMap map = MakeMap(60, 70, 0.15, Slope(Rad(row.slope_deg), Rad(row.azimuth_deg)));
  const HazardMaps hazards = EvaluateHazards(map, settings);
  for (int r = 0; r < 60; ++r) {
    for (int c = 0; c < 70; ++c) {
      ASSERT_NEAR(Deg(double(hazards.slope_rad.at(r, c))), row.slope_deg, 0.01) << r << ' ' << c;
      ASSERT_NEAR(double(hazards.roughness_m.at(r, c)), 0, 1e-4);
      ASSERT_TRUE(!row.safe || hazards.reasons.at(r, c) == kHazardNone);
      ASSERT_EQ((hazards.reasons.at(r, c) & kHazardSlope) == 0, row.safe);
    }
  }
  EXPECT_EQ(hazards.safe_cells > 0, row.safe);
  EXPECT_EQ(hazards.safe_cells + hazards.rejected.slope + hazards.rejected.roughness +
                hazards.rejected.unknown + hazards.rejected.doubtful + hazards.rejected.footprint,
            60 * 70);
}

INSTANTIATE_TEST_SUITE_P(
    Slopes, PlaneWorld,
    ::testing::Values(SlopeRow{"thesis_flat", SladMode::kThesis, 0, 0, true},
                      SlopeRow{"thesis_5_north", SladMode::kThesis, 5, 0, true},
                      SlopeRow{"thesis_12_east", SladMode::kThesis, 12, 90, false},
                      SlopeRow{"modern_flat", SladMode::kModern, 0, 0, true},
                      SlopeRow{"modern_5_south_west", SladMode::kModern, 5, 225, true},
                      SlopeRow{"modern_12_north", SladMode::kModern, 12, 0, false}),
    [](const auto& row) { return row.param.name; });

TEST(HazardMaps, UpVectorTiltsTheLimit) {
  SladSettings settings;
  settings.lander.up_tilt_deg = 12;
  settings.lander.up_azimuth_deg = 180;  // ground rising north by 12 deg has a normal leaning south
  const HazardMaps hazards = EvaluateHazards(MakeMap(50, 50, 0.15, Slope(Rad(12), 0)), settings);
  EXPECT_NEAR(Deg(double(hazards.slope_rad.at(25, 25))), 0, 0.01);
  EXPECT_EQ(hazards.reasons.at(25, 25), kHazardNone);
}

class BoxWorld : public ::testing::TestWithParam<double> {};

TEST_P(BoxWorld, BoxOrPitIsFlaggedWithoutGrowth) {
  const double height_m = GetParam();
  const ElevationMap map = MakeMap(100, 100, 0.15, WithBox(Flat(), 0.75, -0.75, 0.9, height_m));
  const HazardMaps hazards = EvaluateHazards(map, SladSettings{});
  int missed = 0, beyond_one_cell = 0;
  for (int r = 0; r < 100; ++r) {
    for (int c = 0; c < 100; ++c) {
      const double off = std::max(std::abs(map.geometry.NorthOfRow(r) - 0.75),
                                  std::abs(map.geometry.EastOfCol(c) + 0.75));
      const bool flagged = hazards.reasons.at(r, c) != kHazardNone;
      missed += off <= 0.45 && !flagged ? 1 : 0;
      beyond_one_cell += off > 0.45 + 0.15 + 1e-9 && flagged ? 1 : 0;
    }
  }
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(beyond_one_cell, 0);
}

INSTANTIATE_TEST_SUITE_P(Heights, BoxWorld, ::testing::Values(0.25, 0.71, 0.75, 1.5, -0.3, -1.0));

TEST(HazardMaps, SafeDistanceToBoxIsEuclidean) {
  const ElevationMap map = MakeMap(100, 100, 0.15, WithBox(Flat(), 0, 0, 0.3, 0.75));
  const HazardMaps hazards = EvaluateHazards(map, SladSettings{});
  // The box covers rows and columns 49, 50. (30, 30) is 19 cells off the corner in both.
  ASSERT_NE(hazards.reasons.at(49, 49), kHazardNone);
  EXPECT_NEAR(double(hazards.safe_distance_m.at(30, 30)), 0.15 * 19 * std::sqrt(2.0), 0.15 * 1.5);
  EXPECT_EQ(hazards.safe_distance_m.at(49, 49), 0.0F);
}

TEST(HazardMaps, TableAndConesOnNoisyGroundAreSeenAndGroundIsNot) {
  // One frame at 50 ft: 5 cm of height noise a cell.
  const auto world =
      WithBox(WithBox(WithBox(Flat(), 3, 3, 1.2, 0.75), -3, 3, 0.36, 0.71), 2, -4, 0.36, 0.71);
  const ElevationMap map = MakeMap(100, 100, 0.15, world, 0.05, 11);
  const HazardMaps hazards = EvaluateHazards(map, SladSettings{});
  int objects = 0, objects_flagged = 0, ground = 0, ground_flagged = 0;
  for (int r = 0; r < 100; ++r) {
    for (int c = 0; c < 100; ++c) {
      const bool object = world(map.geometry.NorthOfRow(r), map.geometry.EastOfCol(c)) > 0.1;
      const bool flagged = hazards.reasons.at(r, c) != kHazardNone;
      (object ? objects : ground) += 1;
      (object ? objects_flagged : ground_flagged) += flagged ? 1 : 0;
    }
  }
  EXPECT_EQ(objects_flagged, objects);
  EXPECT_LE(ground_flagged, ground / 500);
  EXPECT_GT(hazards.safe_cells, 0);
}

TEST(HazardMaps, MoreNoiseNeverMakesACellSafer) {
  for (const double sigma : {0.02, 0.06, 0.12}) {
    ElevationMap map = MakeMap(60, 60, 0.15, Flat());
    for (float& v : map.variance_m2.cells()) {
      v = static_cast<float>(sigma * sigma);
    }
    ElevationMap noisier = map;
    for (float& v : noisier.variance_m2.cells()) {
      v *= 4;
    }
    const HazardMaps a = EvaluateHazards(map, SladSettings{});
    const HazardMaps b = EvaluateHazards(noisier, SladSettings{});
    EXPECT_LT(b.safe_probability.at(30, 30), a.safe_probability.at(30, 30) + 1e-7F) << sigma;
    EXPECT_LE(b.safe_cells, a.safe_cells);
  }
}

TEST(HazardMaps, ModernNeverLandsOnFilledCellsThesisDoes) {
  ElevationMap map = MakeMap(60, 60, 0.15, Flat());
  map.state.at(30, 30) = CellState::kFilled;
  const HazardMaps modern = EvaluateHazards(map, SladSettings{});
  EXPECT_EQ(modern.reasons.at(30, 30), kHazardUnknown);
  EXPECT_EQ(modern.safe_distance_m.at(30, 30), 0.0F);
  const HazardMaps thesis = EvaluateHazards(map, WithMode(SladMode::kThesis));
  EXPECT_EQ(thesis.reasons.at(30, 30), kHazardNone);
}

TEST(HazardMaps, DegenerateMapsAreNeverSafe) {
  const testing::Height nothing = [](double, double) { return std::nan(""); };
  for (const SladMode mode : {SladMode::kThesis, SladMode::kModern}) {
    for (const auto& [rows, cols] : {std::pair{0, 0}, {1, 1}, {1, 40}, {40, 1}, {2, 2}, {30, 30}}) {
      const HazardMaps hazards =
          EvaluateHazards(MakeMap(rows, cols, 0.15, nothing), WithMode(mode));
      EXPECT_EQ(hazards.safe_cells, 0) << rows << 'x' << cols;
      EXPECT_EQ(hazards.rejected.unknown, rows * cols);
    }
    EXPECT_EQ(EvaluateHazards(MakeMap(1, 1, 0.15, Flat()), WithMode(mode)).safe_cells, 0);
    EXPECT_EQ(EvaluateHazards(MakeMap(1, 50, 0.15, Flat()), WithMode(mode)).safe_cells, 0);
  }
}

TEST(HazardMaps, ThesisCostIsTheProduct) {
  const SladSettings settings = WithMode(SladMode::kThesis);
  const ElevationMap map = MakeMap(60, 60, 0.15, Slope(Rad(6), 0), 0.01, 5);
  const HazardMaps h = EvaluateHazards(map, settings);
  for (std::size_t i = 0; i < h.cost.cells().size(); ++i) {
    const double slope = double(h.slope_rad.cells()[i]), rough = double(h.roughness_m.cells()[i]);
    const bool over = slope > Rad(10) || rough > 0.10;
    EXPECT_NEAR(double(h.cost.cells()[i]), over ? 1.0 : slope * rough / (Rad(10) * 0.10), 1e-5);
  }
}

TEST(HazardMaps, AMovedLimitGivesWhatMeasuringAgainWould) {
  const ElevationMap map =
      MakeMap(70, 90, 0.15, WithBox(Slope(Rad(5), 1), 1, 1, 1.5, 0.3), 0.03, 9);
  for (const SladMode mode : {SladMode::kThesis, SladMode::kModern}) {
    SladSettings settings = WithMode(mode);
    const TerrainFigures figures = MeasureTerrain(map, settings);
    settings.limits.max_slope_deg = 6;
    settings.limits.max_deviation_m = 0.06;
    settings.limits.max_step_m = 0.08;
    settings.limits.min_safe_probability = 0.9;
    settings.lander.nav_error_m = 0.1;
    settings.lander.belly_clearance_m = 0.2;
    settings.lander.up_tilt_deg = mode == SladMode::kThesis ? 3 : 0;
    ASSERT_TRUE(figures.HoldFor(settings));
    EXPECT_EQ(HashOfMaps(map, JudgeTerrain(map.geometry, figures, settings)),
              HashOfMaps(map, EvaluateHazards(map, settings)));
    settings.lander.max_rock_size_m = 0.9;
    EXPECT_FALSE(figures.HoldFor(settings));
  }
}

TEST(HazardMaps, AreTheSameBitsForAnyNumberOfThreads) {
  const ElevationMap map =
      MakeMap(75, 90, 0.15, WithBox(Slope(Rad(5), 1), 1, 1, 1.5, 0.3), 0.03, 9);
  const int threads = cv::getNumThreads();
  for (const SladMode mode : {SladMode::kThesis, SladMode::kModern}) {
    cv::setNumThreads(1);
    const std::uint64_t alone = HashOfMaps(map, EvaluateHazards(map, WithMode(mode)));
    cv::setNumThreads(2);
    EXPECT_EQ(HashOfMaps(map, EvaluateHazards(map, WithMode(mode))), alone);
  }
  cv::setNumThreads(threads);
}

}  // namespace
}  // namespace palace
