#include "engine/slad/hazards/ground_classes.h"

#include <numeric>

#include <gtest/gtest.h>

#include "engine/slad/hazards/explanation.h"
#include "engine/slad/hazards/hazard_maps.h"
#include "engine/slad/sites/site_selection.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::Height;
using testing::MakeMap;
using testing::Slope;
using testing::WithBox;

constexpr double kCell_m = 0.15;
constexpr Cell kMiddle{50, 50};

/// Level ground, judged, and one touchdown on it that is less likely to be safe.
struct LevelGround {
  ElevationMap map = MakeMap(101, 101, kCell_m, Flat());
  SladSettings settings;
  HazardMaps hazards = EvaluateHazards(map, settings);

  void Judge() {
    hazards.counts = {};
    ClassifyCells(settings, hazards);
  }
  GroundClass At(int south, int east) const {
    return hazards.ground.at(kMiddle.row + south, kMiddle.col + east);
  }
};

TEST(GroundClasses, ALanderIsSentWhereEveryTouchdownKeepsTheLimits) {
  LevelGround ground;
  ground.hazards.safe_probability.at(kMiddle) = 0.5F;
  ground.Judge();
  // 0.5 m of navigation error are 3.3 cells.
  EXPECT_EQ(ground.At(0, 0), GroundClass::kFootprint);
  EXPECT_EQ(ground.At(0, 3), GroundClass::kFootprint);
  EXPECT_EQ(ground.At(-3, 0), GroundClass::kFootprint);
  EXPECT_EQ(ground.At(2, 2), GroundClass::kFootprint);
  EXPECT_EQ(ground.At(3, 2), GroundClass::kLandable);
  EXPECT_EQ(ground.At(0, 4), GroundClass::kLandable);
  EXPECT_EQ(ground.hazards.counts[GroundClass::kFootprint], 37);  // cells within 3.3 of one
  ground.settings.lander.nav_error_m = 0;
  ground.Judge();
  EXPECT_EQ(ground.hazards.counts[GroundClass::kFootprint], 1);
}

TEST(GroundClasses, WhatHidesIsAskedOfThePlaceNotOfItsTouchdowns) {
  LevelGround ground;
  ground.hazards.hidden_things = GridF(101, 101, 0.0F);
  // Beside the middle more hides, beyond its clear radius: the touchdown itself is as safe.
  ground.hazards.hidden_things.at(kMiddle.row, kMiddle.col + 2) = 0.4F;
  ground.hazards.safe_probability.at(kMiddle.row, kMiddle.col + 2) *= std::exp(-0.4F);
  ground.Judge();
  EXPECT_EQ(ground.At(0, 0), GroundClass::kLandable);
  EXPECT_EQ(ground.At(0, 2), GroundClass::kFootprint);
}

TEST(GroundClasses, TheExplanationAndTheRecheckNameTheTouchdownBesideIt) {
  LevelGround ground;
  ground.hazards.safe_probability.at(kMiddle.row - 2, kMiddle.col) = 0.5F;
  ground.Judge();
  const CellExplanation e = ExplainCell(ground.map, ground.hazards, ground.settings, kMiddle);
  EXPECT_FALSE(e.can_bear);
  EXPECT_NE(e.verdict.find("under a lander 0.3 m north"), std::string::npos) << e.verdict;
  EXPECT_NE(e.verdict.find("0.50"), std::string::npos) << e.verdict;
  LandingSite site;
  site.p_WS = {ground.map.geometry.NorthOfRow(kMiddle.row),
               ground.map.geometry.EastOfCol(kMiddle.col), 0};
  const auto now = RecheckSite(ground.map, ground.hazards, ground.settings, site, {});
  ASSERT_TRUE(now);
  EXPECT_FLOAT_EQ(static_cast<float>(now->safe_probability), 0.5F);
}

/// On ground of every kind: the classes against every touchdown asked one by one; a cell is
/// landable just where the terms that people read are all inside.
TEST(GroundClasses, AgreeWithEveryTouchdownAskedOneByOne) {
  const Height worlds[] = {
      Flat(), Slope(Rad(9), 0.7), WithBox(Slope(Rad(6), 2), 2, -1, 0.4, 0.3),
      WithBox(WithBox(Flat(), -3, 2, 0.6, -0.4), 3, 3, 0.3, 0.12),
      [](double n, double e) { return 0.06 * std::sin(2 * n) * std::cos(1.7 * e); }};
  int footprint = 0, beside = 0, landable = 0;
  for (const Height& world : worlds) {
    for (const double sigma_m : {0.0, 0.012, 0.025}) {
      const ElevationMap map = MakeMap(101, 101, kCell_m, world, sigma_m, 7);
      const SladSettings settings;
      const HazardMaps hazards = EvaluateHazards(map, settings);
      for (int r = 0; r < 101; ++r) {
        for (int c = 0; c < 101; ++c) {
          const GroundClass ground = hazards.ground.at(r, c);
          if (ground != GroundClass::kLandable && ground != GroundClass::kFootprint) {
            continue;
          }
          bool keeps = true;
          for (int rr = std::max(0, r - 3); rr <= std::min(100, r + 3); ++rr) {
            for (int cc = std::max(0, c - 3); cc <= std::min(100, c + 3); ++cc) {
              if (std::hypot(rr - r, cc - c) * kCell_m > settings.lander.nav_error_m) {
                continue;
              }
              LandingSite touchdown;
              touchdown.slope_rad.value = static_cast<double>(hazards.slope_rad.at(rr, cc));
              touchdown.roughness_m = {
                  static_cast<double>(hazards.roughness_m.at(rr, cc)),
                  3 * static_cast<double>(hazards.roughness_sigma_m.at(rr, cc))};
              touchdown.step_m.value = static_cast<double>(hazards.step_m.at(rr, cc));
              touchdown.safe_probability = static_cast<double>(hazards.safe_probability.at(rr, cc));
              touchdown.safe_distance_m = settings.lander.clear_radius_m();
              for (const ExplainedTerm& term : TermsOf(touchdown, settings)) {
                keeps = keeps && !term.over;
              }
            }
          }
          ASSERT_EQ(ground == GroundClass::kLandable, keeps) << r << ", " << c;
          const bool is_beside = WorstTouchdown(hazards, settings, {r, c}) != Cell{r, c};
          EXPECT_TRUE(!is_beside || !keeps);
          beside += is_beside ? 1 : 0;
          landable += keeps ? 1 : 0;
          footprint += keeps ? 0 : 1;
        }
      }
      EXPECT_EQ(hazards.counts[GroundClass::kLandable], hazards.safe_cells);
    }
  }
  EXPECT_GT(landable, 5000);
  EXPECT_GT(footprint, 200);
  EXPECT_GT(beside, 50);
}

}  // namespace
}  // namespace palace
