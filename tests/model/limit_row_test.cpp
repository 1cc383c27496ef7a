// Rows say of a site what its verdict says, and a row that nobody enforces is never over.
#include "engine/model/mission/limit_row.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/model/cell_explanation.h"
#include "engine/model/site_standing.h"
#include "engine/model/size_words.h"

namespace palace {
namespace {

LimitRow Wind(double value, EnforcedBy by) {
  return Judged({.id = LimitId::kWind,
                 .label = "Wind",
                 .value = value,
                 .limit = 8,
                 .unit = "m/s",
                 .enforced_by = by});
}

TEST(LimitRow, IsOverOnlyWhereSomebodyEnforcesIt) {
  EXPECT_FALSE(Wind(8, EnforcedBy::kGuard).over);
  EXPECT_TRUE(Wind(8.01, EnforcedBy::kGuard).over);
  EXPECT_TRUE(Wind(8.01, EnforcedBy::kAlarm).over);
  EXPECT_FALSE(Wind(80, EnforcedBy::kNobody).over);
  EXPECT_FALSE(Wind(NAN, EnforcedBy::kGuard).over);
  LimitRow least = Wind(0.6, EnforcedBy::kAlarm);
  least.is_least = true;
  least.limit = 0.7;
  EXPECT_TRUE(Judged(least).over);
  least.value = 0.7;
  EXPECT_FALSE(Judged(least).over);
}

TEST(LimitRow, UsesTheWholeLimitAtTheLimit) {
  LimitRow row = Wind(8, EnforcedBy::kGuard);
  EXPECT_EQ(ShareUsed(row), 1);
  row.value = 2;
  EXPECT_EQ(ShareUsed(row), 0.25);
  row.value = NAN;
  EXPECT_TRUE(std::isnan(ShareUsed(row)));
  row.is_least = true;
  row.value = 16;
  EXPECT_EQ(ShareUsed(row), 0.5);
  row.value = 0;
  EXPECT_GT(ShareUsed(row), 1);
  row = {.id = LimitId::kProbability, .value = 0.95, .limit = 0.9, .is_least = true};
  EXPECT_NEAR(ShareUsed(row), 0.5, 1e-9);
  row = {.id = LimitId::kUnknownCells, .value = 0, .limit = 0};
  EXPECT_EQ(ShareUsed(row), 0);
  row.value = 3;
  EXPECT_GT(ShareUsed(row), 1);
}

TEST(LimitRow, ASizeThatNoiseCouldMakeOfNothingIsOnlyKnownToBeBelow) {
  EXPECT_EQ(KnownBelow(Figure{0, 0.02}), 0.02);
  EXPECT_EQ(KnownBelow(Figure{0.01, 0.02}), 0.03);
  EXPECT_TRUE(std::isnan(KnownBelow(Figure{0.026, 0.007})));
  EXPECT_TRUE(std::isnan(KnownBelow(Figure{0, 0})));  // no noise is known
  EXPECT_TRUE(std::isnan(KnownBelow(Figure{0, NAN})));
  EXPECT_TRUE(std::isnan(KnownBelow(Figure{NAN, 0.02})));
  EXPECT_EQ(SizeWords({0, 0.02}, 100, " cm", 1), "under 2.0 cm");
  EXPECT_EQ(SizeWords({0.026, 0.007}, 100, " cm", 1), "2.6 cm");
  EXPECT_EQ(WordsOf({CellTerm::kRoughness, {0, 0.02}, 0.1}).value, "under 2.0 cm");
  EXPECT_EQ(WordsOf({CellTerm::kRoughness, {0, 0.02}, 0.1}).spread, "");
  EXPECT_EQ(WordsOf({CellTerm::kProbability, {0, 0.02}, 0.1}).value, "0.000");
}

TEST(LimitRow, ReadsWithItsUnit) {
  EXPECT_EQ(ValueWords(Wind(9.24, EnforcedBy::kGuard)), "9.2 m/s");
  EXPECT_EQ(LimitWords(Wind(9.24, EnforcedBy::kGuard)), "8.0 m/s");
  EXPECT_EQ(ValueWords(Wind(NAN, EnforcedBy::kGuard)), "––");
  LimitRow slope{.id = LimitId::kSlope,
                 .label = "Slope",
                 .value = Rad(2.5),
                 .limit = Rad(10),
                 .unit = "°",
                 .shown_per_unit = kDegPerRad};
  EXPECT_EQ(ValueWords(slope), "2.5°");
  slope.three_sigma = Rad(0.4);
  EXPECT_EQ(ValueWords(slope), "2.5 ± 0.4°");
  slope.value = Rad(0.1);  // noise alone could make it: only what it is below is known
  EXPECT_EQ(ValueWords(slope), "under 0.5°");
}

TEST(SiteLimits, SayWhatTheVerdictOfTheSiteSays) {
  RandomStream random(12);
  const std::pair<CellTerm, LimitId> pairs[] = {{CellTerm::kSlope, LimitId::kSlope},
                                                {CellTerm::kRoughness, LimitId::kRoughness},
                                                {CellTerm::kStep, LimitId::kStep},
                                                {CellTerm::kProbability, LimitId::kProbability},
                                                {CellTerm::kHazardDistance, LimitId::kClearRadius}};
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE("seed 12 trial " + std::to_string(trial));
    SladSettings settings;
    settings.mode = trial % 4 == 0 ? SladMode::kThesis : SladMode::kModern;
    LandingSite site;
    site.slope_rad = {random.Uniform(0, Rad(20)), Rad(0.5)};
    site.roughness_m = {random.Uniform(0, 0.2), 0.02};
    site.step_m = {random.Uniform(0, 0.3), 0.02};
    site.safe_probability = random.Uniform(0.8, 1);
    site.safe_distance_m = random.Uniform(0, 5);
    site.unknown_cells = trial % 3;
    site.height_m.three_sigma = random.Uniform(0, 0.2);
    const std::vector<LimitRow> rows = SiteLimits(site, settings);
    for (const auto& [term, id] : pairs) {
      const LimitRow* row = FindLimit(rows, id);
      bool there = false;
      for (const ExplainedTerm& explained : TermsOf(site, settings)) {
        if (explained.term == term) {
          there = true;
          ASSERT_NE(row, nullptr);
          EXPECT_EQ(row->over, explained.over) << row->label;
          EXPECT_EQ(row->limit, explained.limit);
          EXPECT_EQ(row->enforced_by, EnforcedBy::kGuard);
        }
      }
      EXPECT_EQ(there, row != nullptr);
    }
    const bool modern = settings.mode == SladMode::kModern;
    EXPECT_EQ(FindLimit(rows, LimitId::kUnknownCells)->over, modern && site.unknown_cells > 0);
    // What is enforced is the confirmation that follows from it, so the row never claims a guard.
    const LimitRow* noise = FindLimit(rows, LimitId::kHeightNoise);
    EXPECT_EQ(noise->value, site.height_m.three_sigma);
    EXPECT_EQ(noise->enforced_by, EnforcedBy::kNobody);
    EXPECT_FALSE(noise->over);
    EXPECT_EQ(FindLimit(rows, LimitId::kAirSeen), nullptr) << "nobody asked";
    site.air_seen_m = random.Uniform(0, 12);
    const std::vector<LimitRow> asked = SiteLimits(site, settings);
    const LimitRow* air = FindLimit(asked, LimitId::kAirSeen);
    ASSERT_NE(air, nullptr);
    EXPECT_EQ(air->value, site.air_seen_m);
    EXPECT_EQ(air->limit, kLeastAirSeen_m);
    EXPECT_TRUE(air->is_least);
    EXPECT_EQ(air->enforced_by, EnforcedBy::kGuard);
    EXPECT_EQ(air->over, !IsAirShown(site));
    site.air_on_way_m = kLeastAirSeen_m;  // the way down shows it
    EXPECT_FALSE(FindLimit(SiteLimits(site, settings), LimitId::kAirSeen)->over);
  }
}

}  // namespace
}  // namespace palace
