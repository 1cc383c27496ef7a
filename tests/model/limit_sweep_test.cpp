// Which limits can be swept, and what a sweep says around a value.
#include "engine/model/limit_sweep.h"

#include <gtest/gtest.h>

#include "engine/model/landing_site.h"

namespace palace {
namespace {

TEST(MaySweep, NumbersOfLimitsAndLanderAlone) {
  const struct {
    const char* limit;
    bool may;
  } rows[] = {{"slad.max_slope_deg", true},   {"slad.max_deviation_m", true},
              {"slad.nav_error_m", true},     {"slad.lander_base_size_m", true},
              {"slad.up_tilt_deg", true},     {"slad.gear", false},
              {"slad.elevated", false},       {"slad.mode", false},
              {"slad.cell_m", false},         {"slad.frames_fused", false},
              {"slad.site_spacing_m", false}, {"slad.commit_height_m", false}};
  for (const auto& row : rows) {
    EXPECT_EQ(MaySweep(*FindSetting(row.limit)), row.may) << row.limit;
  }
}

LimitSweep Sweep() {
  LimitSweep sweep{.limit = "slad.max_slope_deg", .map_time = {}, .others = {}, .values = {}};
  const std::uint64_t best[] = {0, 0, 2, 2, 1, 1};
  for (int i = 0; i < 6; ++i) {
    sweep.values.push_back({.value = 2.0 + i, .best_id = best[i]});
  }
  return sweep;
}

TEST(BestAroundValue, FindsTheNextChangesOnBothSides) {
  const LimitSweep sweep = Sweep();
  const auto middle = BestAroundValue(sweep, 4.4);
  ASSERT_TRUE(middle && middle->below && middle->above);
  EXPECT_EQ(middle->here.best_id, 2u);
  EXPECT_EQ(middle->below->value, 4);
  EXPECT_EQ(middle->below->then.best_id, 0u);
  EXPECT_EQ(middle->above->value, 5);
  EXPECT_EQ(middle->above->then.best_id, 1u);
  const auto end = BestAroundValue(sweep, 90);
  ASSERT_TRUE(end && end->below);
  EXPECT_EQ(end->below->value, 6);
  EXPECT_FALSE(end->above);
  EXPECT_FALSE(BestAroundValue(LimitSweep{}, 1));
}

TEST(SameBest, PlacesWithoutALetterOfTheFlightAreOne) {
  const SweptValue here{.best_id = kFirstUnnamedSite + 1}, there{.best_id = kFirstUnnamedSite + 2};
  EXPECT_TRUE(SameBest(here, there));
  EXPECT_FALSE(SameBest(here, {.best_id = 1}));
  EXPECT_FALSE(SameBest({.best_id = 2}, {.best_id = 1}));
  EXPECT_FALSE(SameBest({}, {.best_id = 1}));
  EXPECT_TRUE(SameBest({}, {}));
}

}  // namespace
}  // namespace palace
