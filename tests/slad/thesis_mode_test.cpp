// Thesis mode, the engine's fast version, equals the slow reference.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/hazards/plane_fit.h"
#include "engine/slad/slad.h"
#include "engine/slad/terrain/hole_filling.h"
#include "tests/slad/thesis_reference.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

constexpr double kSame = 1e-6;

/// Ground with a tilt, boxes, pits and ramps on it, noise or none, holes and lone unknown cells.
ElevationMap RandomMap(RandomStream& random) {
  const double cell_m = random.Uniform(0.08, 0.4);
  testing::Height world = testing::Slope(Rad(random.Uniform(0, 15)), Rad(random.Uniform(0, 360)));
  for (int boxes = random.Index(4); boxes > 0; --boxes) {
    world = testing::WithBox(world, random.Uniform(-3, 3), random.Uniform(-3, 3),
                             random.Uniform(0.2, 3), random.Uniform(-0.5, 0.8));
  }
  if (random.Uniform() < 0.5) {
    const double edge_m = random.Uniform(-2, 2), rise = random.Uniform(-0.8, 0.8);
    world = [=](double n, double e) { return world(n, e) + rise * std::max(0.0, n - edge_m); };
  }
  const double offset_m = random.Uniform(-60, 60);
  const auto lifted = [=](double n, double e) { return world(n, e) + offset_m; };
  const double noise[] = {0, 0.004, 0.03};
  ElevationMap map = testing::MakeMap(3 + random.Index(18), 3 + random.Index(18), cell_m, lifted,
                                      noise[random.Index(3)], random.NextBits());
  const auto forget = [&](Cell cell) {
    if (map.geometry.Contains(cell)) {
      map.height_m.at(cell) = map.variance_m2.at(cell) = kUnknownValue;
      map.state.at(cell) = CellState::kUnknown;
    }
  };
  for (int holes = random.Index(4); holes > 0; --holes) {
    const int side = 1 + random.Index(5);
    const Cell corner{random.Index(map.geometry.rows), random.Index(map.geometry.cols)};
    for (int k = 0; k < side * side; ++k) {
      forget({corner.row + k / side, corner.col + k % side});
    }
  }
  const double lone_share = random.Uniform() < 0.5 ? 0.0 : random.Uniform(0, 0.4);
  for (int k = 0; k < map.geometry.rows * map.geometry.cols; ++k) {
    if (random.Uniform() < lone_share) {
      forget({k / map.geometry.cols, k % map.geometry.cols});
    }
  }
  return map;
}

SladSettings RandomSettings(RandomStream& random) {
  SladSettings settings = testing::WithMode(SladMode::kThesis);
  settings.limits.max_slope_deg = random.Uniform(4, 30);
  settings.limits.max_deviation_m = random.Uniform(0.02, 0.3);
  settings.lander.max_rock_size_m = random.Uniform(0.05, 1.0);
  settings.lander.up_tilt_deg = random.Uniform() < 0.5 ? 0.0 : random.Uniform(0, 20);
  settings.lander.up_azimuth_deg = random.Uniform(0, 360);
  settings.lander.base_size_m = random.Uniform(0.2, 0.8);
  settings.lander.nav_error_m = 0;
  settings.lander.rotor_diameter_m = 0;  // the thesis knows no approach corridor
  settings.choice.ranking = random.Uniform() < 0.5 ? SiteRanking::kFarthest : SiteRanking::kCost;
  settings.grid.data_size_cells = random.Index(4);
  settings.grid.border_size_cells = random.Index(4);
  return settings;
}

struct Tally {
  int cells = 0;
  int in_doubt = 0;  ///< another plane, as good to the last digits of a float, was taken
};

void ComparePlanes(const ElevationMap& map, const SladSettings& settings, const HazardMaps& fast,
                   Tally& tally) {
  const int stride = testing::thesis::ReferenceStride(map.geometry, settings);
  const double spacing_m = stride * map.geometry.cell_m;
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      SCOPED_TRACE(::testing::Message() << "cell " << r << ' ' << c);
      const double z = double(map.height_m.at(r, c));
      const auto planes = std::isnan(z)
                              ? std::vector<testing::thesis::ReferencePlane>{}
                              : testing::thesis::ReferencePlanes(map.height_m, r, c, stride, z);
      const double slope = double(fast.slope_rad.at(r, c));
      const double roughness = double(fast.roughness_m.at(r, c));
      if (planes.empty()) {
        ASSERT_EQ(fast.reasons.at(r, c), kHazardUnknown);
        ASSERT_TRUE(std::isnan(slope) && std::isnan(roughness));
        ASSERT_TRUE(std::isnan(fast.cost.at(r, c)));
        continue;
      }
      const auto same = std::find_if(planes.begin(), planes.end(), [&](const auto& plane) {
        return std::abs(testing::thesis::ReferenceSlope(plane, spacing_m, settings) - slope) <
                   kSame &&
               std::abs(std::abs(plane.height) - roughness) < kSame;
      });
      ASSERT_NE(same, planes.end())
          << "slope " << slope << ", reference "
          << testing::thesis::ReferenceSlope(planes[0], spacing_m, settings) << "; roughness "
          << roughness << ", reference " << std::abs(planes[0].height);
      ++tally.cells;
      tally.in_doubt += same == planes.begin() ? 0 : 1;
    }
  }
}

/// From slope and roughness on, the engine's own maps are the input: a limit met to the last digit
/// must not hide an error further on.
void CompareVerdicts(const ElevationMap& map, const SladSettings& settings,
                     const HazardMaps& fast) {
  Grid<std::uint8_t> safe(map.geometry.rows, map.geometry.cols, 0);
  const auto near_limit = [&](Cell cell) {
    return std::abs(double(fast.slope_rad.at(cell)) - Rad(settings.limits.max_slope_deg)) < kSame ||
           std::abs(double(fast.roughness_m.at(cell)) - settings.limits.max_deviation_m) < kSame;
  };
  for (int k = 0; k < map.geometry.rows * map.geometry.cols; ++k) {
    const Cell cell{k / map.geometry.cols, k % map.geometry.cols};
    safe.at(cell) = fast.reasons.at(cell) == kHazardNone ? 1 : 0;
    const double slope = double(fast.slope_rad.at(cell));
    const double roughness = double(fast.roughness_m.at(cell));
    if (std::isnan(slope) || near_limit(cell)) {
      continue;
    }
    ASSERT_EQ((fast.reasons.at(cell) & kHazardSlope) != 0,
              slope > Rad(settings.limits.max_slope_deg));
    ASSERT_EQ((fast.reasons.at(cell) & kHazardRoughness) != 0,
              roughness > settings.limits.max_deviation_m);
    ASSERT_NEAR(double(fast.cost.at(cell)),
                testing::thesis::ReferenceCost(slope, roughness, settings), kSame);
  }
  for (int k = 0; k < map.geometry.rows * map.geometry.cols; ++k) {
    const Cell cell{k / map.geometry.cols, k % map.geometry.cols};
    ASSERT_NEAR(double(fast.safe_distance_m.at(cell)),
                testing::thesis::ReferenceSafeDistance(safe, cell, map.geometry.cell_m), kSame);
  }
}

/// Both readings of the choice: farthest from any hazard, cost breaking ties within a cell's
/// width; or the least smoothed cost, distance breaking ties.
double ReferenceScore(const ElevationMap& map, const SladSettings& settings,
                      const HazardMaps& hazards, Cell cell) {
  const double cost = testing::thesis::ReferenceSmoothedCost(hazards.cost, cell);
  const double distance_m = double(hazards.safe_distance_m.at(cell));
  return settings.choice.ranking == SiteRanking::kFarthest
             ? distance_m + 0.4 * map.geometry.cell_m * (1 - cost)
             : -cost + 1e-3 * distance_m;
}

void CompareChoice(const ElevationMap& map, const SladSettings& settings, const HazardMaps& hazards,
                   int& chosen) {
  SiteContext context;
  context.p_WB = {0.0123, 0.0456, -10};
  const SiteSelection selection = SelectSites(map, hazards, settings, context);
  double best = -HUGE_VAL;
  for (int k = 0; k < map.geometry.rows * map.geometry.cols; ++k) {
    const Cell cell{k / map.geometry.cols, k % map.geometry.cols};
    // A cell wider than the lander shows nothing of what is under it.
    if (map.geometry.cell_m <= settings.lander.base_size_m &&
        hazards.reasons.at(cell) == kHazardNone &&
        hazards.safe_distance_m.at(cell) >= float(settings.lander.clear_radius_m())) {
      best = std::max(best, ReferenceScore(map, settings, hazards, cell));
    }
  }
  ASSERT_EQ(selection.sites.empty(), std::isinf(best));
  if (!selection.sites.empty()) {
    ASSERT_NEAR(ReferenceScore(map, settings, hazards, selection.sites.front().cell), best, kSame);
    ++chosen;
  }
}

TEST(ThesisMode, EqualsTheSlowReferenceOnRandomMaps) {
  Tally tally;
  int chosen = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    RandomStream random(seed, "thesis mode");
    const ElevationMap measured = RandomMap(random);
    const SladSettings settings = RandomSettings(random);
    ElevationMap map = measured, reference = measured;
    FillHoles(map, settings.grid.data_size_cells, settings.grid.border_size_cells);
    testing::thesis::ReferenceFillHoles(reference, settings.grid.data_size_cells,
                                        settings.grid.border_size_cells);
    for (std::size_t i = 0; i < map.state.cells().size(); ++i) {
      ASSERT_EQ(map.state.cells()[i], reference.state.cells()[i]) << i;
      // Filled heights are floats, 60 m up at most: half a last digit is 2 um.
      ASSERT_TRUE(map.state.cells()[i] == CellState::kUnknown ||
                  std::abs(map.height_m.cells()[i] - reference.height_m.cells()[i]) < 4e-6F)
          << i;
    }
    const HazardMaps fast = EvaluateHazards(map, settings);
    ComparePlanes(map, settings, fast, tally);
    CompareVerdicts(map, settings, fast);
    CompareChoice(map, settings, fast, chosen);
    if (HasFatalFailure()) {
      return;
    }
  }
  EXPECT_GT(tally.cells, 10000);
  EXPECT_GT(chosen, 50);
  // Steps and ramps make exact ties between planes; rounding then decides. Noise makes none.
  EXPECT_LT(tally.in_doubt, tally.cells / 1000) << tally.in_doubt << " of " << tally.cells;
  RecordProperty("cells", tally.cells);
  RecordProperty("in_doubt", tally.in_doubt);
}

void ExpectSameBits(const GridF& a, const GridF& b) {
  for (std::size_t i = 0; i < a.cells().size(); ++i) {
    ASSERT_TRUE(a.cells()[i] == b.cells()[i] ||
                (std::isnan(a.cells()[i]) && std::isnan(b.cells()[i])))
        << i << ": " << a.cells()[i] << ' ' << b.cells()[i];
  }
}

TEST(ThesisMode, PlanesAreTheSameBitsOnEveryProcessorAndForAnyNumberOfThreads) {
  const int threads = cv::getNumThreads();
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "same bits");
    const ElevationMap map = RandomMap(random);
    const int stride = 1 + random.Index(3);
    cv::setNumThreads(1);
    const PlaneMaps plain = FitThesisPlanes(map.height_m, 0.2, stride, &PortableSladLoops());
    cv::setNumThreads(2);
    // Where the processor lacks a set, the fastest that it has.
    for (const SladLoops* loops : {Avx2SladLoops(), Avx512SladLoops()}) {
      const PlaneMaps fast = FitThesisPlanes(map.height_m, 0.2, stride, loops);
      ExpectSameBits(plain.height_m, fast.height_m);
      ExpectSameBits(plain.residual_m, fast.residual_m);
      ExpectSameBits(plain.north_gradient, fast.north_gradient);
      ExpectSameBits(plain.east_gradient, fast.east_gradient);
    }
  }
  cv::setNumThreads(threads);
}

}  // namespace
}  // namespace palace
