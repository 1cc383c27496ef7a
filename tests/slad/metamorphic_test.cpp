// What must happen to the verdict when the same world is laid elsewhere: turned, mirrored, shifted,
// raised, scaled. Terrains are random, their seeds printed with every failure.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/slad/slad.h"
#include "tests/slad/thesis_reference.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::MakeMap;
using testing::RandomGround;
using testing::Turn;
using testing::WithMode;

constexpr double kCell_m = 0.15;
constexpr std::array kModes = {SladMode::kThesis, SladMode::kModern};
constexpr std::array<Turn, 7> kTurns = {
    {{1, false}, {2, false}, {3, false}, {0, true}, {1, true}, {2, true}, {3, true}}};

std::string Label(SladMode mode, std::uint64_t seed, const Turn& turn = {}) {
  return std::string(mode == SladMode::kThesis ? "thesis" : "modern") + " seed " +
         std::to_string(seed) + " quarters " + std::to_string(turn.quarters) +
         (turn.mirrored ? " mirrored" : "");
}

/// The vehicle over a place off the middle, a square picture straight down that breaks ties alike
/// in every direction, and no approach to fly: nothing but the ground decides.
SiteContext Overhead(const Turn& turn, double height_m = 15) {
  SiteContext context;
  context.p_WB = turn(Eigen::Vector3d(0.31, 0.17, -height_m));
  context.X_WC = {CameraRotationFromTilt(Rad(-90)), context.p_WB};
  context.camera = {480, 480, 480, 480, 239.5, 239.5};
  context.glide_slope_rad = Rad(89);
  return context;
}

struct Answer {
  HazardMaps hazards;
  SiteSelection selection;
};

Answer Ask(const ElevationMap& map, const SladSettings& settings,
           const SiteContext& context = Overhead({})) {
  Answer answer{EvaluateHazards(map, settings), {}};
  answer.selection = SelectSites(map, answer.hazards, settings, context);
  return answer;
}

/// Largest difference of two layers; infinity where one is unknown and the other is not.
double LargestDifference(const GridF& a, const GridF& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.cells().size(); ++i) {
    const double x = double(a.cells()[i]), y = double(b.cells()[i]);
    if (std::isnan(x) != std::isnan(y)) {
      return HUGE_VAL;
    }
    most = std::isnan(x) ? most : std::max(most, std::abs(x - y));
  }
  return most;
}

constexpr std::array kLayers = {&HazardMaps::slope_rad,       &HazardMaps::slope_sigma_rad,
                                &HazardMaps::roughness_m,     &HazardMaps::roughness_sigma_m,
                                &HazardMaps::step_m,          &HazardMaps::cost,
                                &HazardMaps::safe_distance_m, &HazardMaps::safe_probability};
/// Rounding of the moving sums: heights within some um, probabilities and costs accordingly.
constexpr double kRounding = 2e-5;

/// Sites at the places of `is`, turned, and moved by `offset_W`.
void ExpectSitesMoved(const SiteSelection& is, const SiteSelection& moved, const Turn& turn,
                      const Eigen::Vector3d& offset_W = Eigen::Vector3d::Zero()) {
  ASSERT_EQ(is.sites.size(), moved.sites.size());
  EXPECT_EQ(is.none_reason, moved.none_reason);
  for (std::size_t i = 0; i < is.sites.size(); ++i) {
    EXPECT_LE((turn(is.sites[i].p_WS) + offset_W - moved.sites[i].p_WS).norm(), 1e-4) << i;
    EXPECT_LE((turn(is.sites[i].normal_W) - moved.sites[i].normal_W).norm(), kRounding) << i;
  }
}

TEST(Metamorphic, TurnedGroundTurnsEveryLayerAndTheSites) {
  const SladSettings settings;
  int sites = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const ElevationMap map = RandomGround(64, 72, kCell_m, seed);
    const Answer is = Ask(map, settings);
    sites += static_cast<int>(is.selection.sites.size());
    for (const Turn& turn : kTurns) {
      SCOPED_TRACE(Label(settings.mode, seed, turn));
      const Answer turned = Ask(turn(map), settings, Overhead(turn));
      for (const auto layer : kLayers) {
        EXPECT_LE(LargestDifference(turn(is.hazards.*layer), turned.hazards.*layer), kRounding);
      }
      EXPECT_EQ(turn(is.hazards.reasons).cells(), turned.hazards.reasons.cells());
      EXPECT_EQ(is.hazards.safe_cells, turned.hazards.safe_cells);
      ExpectSitesMoved(is.selection, turned.selection, turn);
    }
  }
  EXPECT_GE(sites, 40) << "the grounds offer too few sites to test anything";
}

/// 1 where the LMedS plane has an equal. On a grid two triples often share one residual and one
/// area, so that nothing but their order tells them apart: some 10 % of noisy windows.
Grid<std::uint8_t> CellsOfTwoAnswers(const ElevationMap& map, const SladSettings& settings) {
  const int stride = testing::thesis::ReferenceStride(map.geometry, settings);
  Grid<std::uint8_t> ambiguous(map.geometry.rows, map.geometry.cols, 0);
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      const double reference_m = double(map.height_m.at(r, c));
      if (std::isnan(reference_m)) {
        continue;  // no ground, whatever its plane
      }
      const auto planes = testing::thesis::ReferencePlanes(map.height_m, r, c, stride, reference_m);
      for (const auto& plane : planes) {
        const double apart = std::abs(plane.height - planes.front().height) +
                             std::abs(plane.east - planes.front().east) +
                             std::abs(plane.south - planes.front().south);
        ambiguous.at(r, c) |= apart > 1e-7 ? 1 : 0;
      }
    }
  }
  return ambiguous;
}

TEST(Metamorphic, TurnedGroundTurnsThesisPlanesThatAreUnique) {
  const SladSettings settings = WithMode(SladMode::kThesis);
  std::size_t ambiguous_cells = 0, all_cells = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const ElevationMap map = RandomGround(64, 72, kCell_m, seed);
    const HazardMaps is = EvaluateHazards(map, settings);
    const Grid<std::uint8_t> ambiguous = CellsOfTwoAnswers(map, settings);
    for (const std::uint8_t cell : ambiguous.cells()) {
      ambiguous_cells += cell;
      ++all_cells;
    }
    for (const Turn& turn : kTurns) {
      SCOPED_TRACE(Label(settings.mode, seed, turn));
      HazardMaps turned = EvaluateHazards(turn(map), settings);
      const Grid<std::uint8_t> leave = turn(ambiguous);
      for (const auto layer :
           {&HazardMaps::slope_rad, &HazardMaps::roughness_m, &HazardMaps::cost}) {
        const GridF want = turn(is.*layer);
        for (std::size_t i = 0; i < want.cells().size(); ++i) {
          if (leave.cells()[i] != 0) {
            (turned.*layer).cells()[i] = want.cells()[i];
          }
        }
        EXPECT_LE(LargestDifference(want, turned.*layer), kRounding);
      }
    }
  }
  EXPECT_LT(ambiguous_cells, all_cells * 15 / 100);
}

/// The same ground on a map with more unknown ground around it, `rows` and `cols` further in.
ElevationMap Embedded(const ElevationMap& map, int rows, int cols) {
  const auto nothing = [](double, double) { return std::nan(""); };
  ElevationMap larger =
      MakeMap(map.geometry.rows + 2 * rows + 2, map.geometry.cols + 2 * cols + 4, kCell_m, nothing);
  larger.geometry.north_min_m = map.geometry.north_min_m;
  larger.geometry.east_min_m = map.geometry.east_min_m;
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      larger.height_m.at(r + rows, c + cols) = map.height_m.at(r, c);
      larger.variance_m2.at(r + rows, c + cols) = map.variance_m2.at(r, c);
      larger.frame_count.at(r + rows, c + cols) = map.frame_count.at(r, c);
      larger.state.at(r + rows, c + cols) = map.state.at(r, c);
    }
  }
  return larger;
}

TEST(Metamorphic, GroundShiftedByWholeCellsShiftsEveryLayerAndTheSites) {
  for (const SladMode mode : kModes) {
    const SladSettings settings = WithMode(mode);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(Label(mode, seed));
      const ElevationMap map = RandomGround(64, 72, kCell_m, seed);
      const Answer is = Ask(map, settings);
      // Raised surfaces are looked for on blocks of 0.3 m: two cells.
      const int rows = 2 + 2 * (static_cast<int>(seed) % 7);
      const int cols = 2 * (static_cast<int>(seed) % 5);
      const ElevationMap larger = Embedded(map, rows, cols);
      const Eigen::Vector3d offset_W(larger.geometry.NorthOfRow(rows) - map.geometry.NorthOfRow(0),
                                     larger.geometry.EastOfCol(cols) - map.geometry.EastOfCol(0),
                                     0);
      SiteContext context = Overhead({});
      context.p_WB += offset_W;
      context.X_WC.p = context.p_WB;
      const Answer shifted = Ask(larger, settings, context);
      for (const auto layer : kLayers) {
        GridF inside(map.geometry.rows, map.geometry.cols, kUnknownValue);
        for (int r = 0; r < inside.rows(); ++r) {
          for (int c = 0; c < inside.cols(); ++c) {
            inside.at(r, c) = (shifted.hazards.*layer).at(r + rows, c + cols);
          }
        }
        EXPECT_LE(LargestDifference(is.hazards.*layer, inside), kRounding);
      }
      EXPECT_EQ(is.hazards.safe_cells, shifted.hazards.safe_cells);
      ASSERT_EQ(is.selection.sites.size(), shifted.selection.sites.size());
      for (std::size_t i = 0; i < is.selection.sites.size(); ++i) {
        EXPECT_LE((is.selection.sites[i].p_WS + offset_W - shifted.selection.sites[i].p_WS).norm(),
                  1e-4);
      }
    }
  }
}

TEST(Metamorphic, RaisedGroundKeepsEveryVerdict) {
  for (const SladMode mode : kModes) {
    const SladSettings settings = WithMode(mode);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      ElevationMap map = RandomGround(64, 72, kCell_m, seed);
      for (float& height : map.height_m.cells()) {
        height = std::round(height * 4096) / 4096;  // so that raising rounds nothing
      }
      const Answer is = Ask(map, settings);
      for (const double rise_m : {1.0, -300.0, 1000.0}) {
        SCOPED_TRACE(Label(mode, seed) + " raised by " + std::to_string(rise_m) + " m");
        ElevationMap raised = map;
        for (float& height : raised.height_m.cells()) {
          height += static_cast<float>(rise_m);
        }
        SiteContext context = Overhead({});
        context.p_WB.z() -= rise_m;
        context.X_WC.p = context.p_WB;
        const Answer now = Ask(raised, settings, context);
        EXPECT_EQ(is.hazards.reasons.cells(), now.hazards.reasons.cells());
        for (const auto layer : {&HazardMaps::slope_rad, &HazardMaps::safe_distance_m}) {
          EXPECT_LE(LargestDifference(is.hazards.*layer, now.hazards.*layer), kRounding);
        }
        // Heights of planes are floats too, 0.06 mm fine at 1000 m, and near the noise the root of
        // r^2 - 16 s^2 magnifies their last digit.
        const double last_digit_m = std::abs(rise_m) * 0x1p-23;
        EXPECT_LE(LargestDifference(is.hazards.roughness_m, now.hazards.roughness_m),
                  std::sqrt(0.2 * last_digit_m));
        ASSERT_EQ(is.selection.sites.size(), now.selection.sites.size());
      }
    }
  }
}

// Modern mode knows three lengths by themselves (a sensor's least noise and what counts as level),
// so only thesis mode is the same at every scale.
TEST(Metamorphic, ThesisModeIsTheSameAtTwiceTheScale) {
  std::size_t differing = 0, cells = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ElevationMap map = RandomGround(64, 72, kCell_m, seed);
    SladSettings settings = WithMode(SladMode::kThesis);
    const HazardMaps is = EvaluateHazards(map, settings);
    ElevationMap larger = MakeMap(64, 72, 2 * kCell_m, testing::Flat());
    larger.state = map.state;
    for (std::size_t i = 0; i < map.state.cells().size(); ++i) {
      larger.height_m.cells()[i] = 2 * map.height_m.cells()[i];
      larger.variance_m2.cells()[i] = 4 * map.variance_m2.cells()[i];
    }
    for (double* length_m : {&settings.limits.max_deviation_m, &settings.lander.max_rock_size_m,
                             &settings.lander.base_size_m, &settings.lander.nav_error_m}) {
      *length_m *= 2;
    }
    const HazardMaps now = EvaluateHazards(larger, settings);
    for (std::size_t i = 0; i < is.reasons.cells().size(); ++i) {
      differing += is.reasons.cells()[i] != now.reasons.cells()[i] ? 1 : 0;
      ++cells;
    }
  }
  // The inlier threshold is never below 1 mm: windows that even get another plane.
  EXPECT_LE(differing, cells / 2000);
}

}  // namespace
}  // namespace palace
