// A sweep against deciding anew under each value: the slow way that a preview goes.
#include "engine/runtime/limit_sweep.h"

#include <gtest/gtest.h>

#include "engine/slad/slad.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;
using testing::WithBox;

/// Gentle waves, steeper eastwards, and a box: both slope and roughness decide somewhere.
ElevationMap Waves() {
  return MakeMap(80, 80, 0.15,
                 WithBox([](double north,
                            double east) { return 0.055 * (east + 6.5) * std::sin(north * 0.35); },
                         3, -3, 1.0, 0.3));
}

class Surveyed {
 public:
  Surveyed() {
    slad_.Take(Waves());
    record_ = slad_.Decide(settings_, Letters::kOfRecord);
  }

  SweepRequest Request(const char* limit) const {
    SweepRequest request{FindSetting(limit), record_, settings_, {}, {}};
    request.context.p_WB.setConstant(NAN);
    request.context.time = record_->map_time;
    return request;
  }
  std::shared_ptr<const TerrainDecision> Under(const char* limit, double value) {
    Settings moved = settings_;
    EXPECT_TRUE(SetSettingValue(moved, limit, value));
    return slad_.Decide(moved, Letters::kOfCopy);
  }
  const TerrainDecision& record() const { return *record_; }

 private:
  Settings settings_;
  Slad slad_;
  std::shared_ptr<const TerrainDecision> record_;
};

LimitSweep Swept(const SweepRequest& request) {
  return SweepLimit(request, [] { return true; });
}

TEST(LimitSweep, SaysOfEachValueWhatDecidingAnewUnderItSays) {
  Surveyed world;
  for (const char* limit : {"slad.max_slope_deg", "slad.max_deviation_m", "slad.nav_error_m",
                            "slad.lander_base_size_m"}) {
    SCOPED_TRACE(limit);
    const LimitSweep sweep = Swept(world.Request(limit));
    ASSERT_GE(sweep.values.size(), 25u);
    double before = -1;
    int areas = 0;
    double last_area = -1;
    for (const SweptValue& swept : sweep.values) {
      SCOPED_TRACE(swept.value);
      EXPECT_GT(swept.value, before);
      before = swept.value;
      const auto decision = world.Under(limit, swept.value);
      const double cell_m = decision->hazards->geometry.cell_m;
      EXPECT_DOUBLE_EQ(swept.safe_area_m2, decision->hazards->safe_cells * cell_m * cell_m);
      areas += swept.safe_area_m2 != last_area ? 1 : 0;
      last_area = swept.safe_area_m2;
      const auto& sites = decision->selection.sites;
      ASSERT_EQ(swept.best_id != 0, !sites.empty());
      if (!sites.empty()) {
        EXPECT_EQ(swept.best, sites[0].letter);
        EXPECT_DOUBLE_EQ(swept.best_clear_m, sites[0].safe_distance_m);
      }
    }
    EXPECT_GT(areas, 5) << "the limit decides something on this ground";
  }
}

TEST(LimitSweep, CoversTheUsualRangeAndTheValueInForce) {
  Surveyed world;
  SweepRequest request = world.Request("slad.max_slope_deg");
  request.settings.slad.limits.max_slope_deg = 32.5;
  const LimitSweep sweep = Swept(request);
  const SettingInfo& slope = *FindSetting("slad.max_slope_deg");
  EXPECT_EQ(sweep.values.front().value, slope.soft_min);
  EXPECT_EQ(sweep.values.back().value, 32.5);
}

TEST(LimitSweep, TellsAChangeOfTheBestPlaceToTheNumberThatTheScreenShows) {
  Surveyed world;
  const LimitSweep sweep = Swept(world.Request("slad.max_slope_deg"));
  int changes = 0;
  for (std::size_t i = 1; i < sweep.values.size(); ++i) {
    if (!SameBest(sweep.values[i - 1], sweep.values[i])) {
      ++changes;
      EXPECT_LE(sweep.values[i].value - sweep.values[i - 1].value, 0.15 + 1e-9);
    }
  }
  EXPECT_GT(changes, 0);
}

TEST(LimitSweep, ARefusedPlaceIsNeverTheBest) {
  Surveyed world;
  ASSERT_GE(world.record().selection.sites.size(), 2u);
  SweepRequest request = world.Request("slad.max_deviation_m");
  request.refused = {world.record().selection.sites[0].id};
  for (const SweptValue& swept : Swept(request).values) {
    EXPECT_NE(swept.best_id, request.refused[0]);
  }
}

TEST(LimitSweep, ComesBackEmptyWhenItIsGivenUp) {
  Surveyed world;
  int asked = 0;
  const LimitSweep sweep =
      SweepLimit(world.Request("slad.max_step_m"), [&] { return ++asked < 7; });
  EXPECT_TRUE(sweep.values.empty());
  EXPECT_EQ(asked, 7);
}

}  // namespace
}  // namespace palace
