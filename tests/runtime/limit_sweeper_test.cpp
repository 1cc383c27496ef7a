// Sweeps beside the flight: the newest question is answered, of the newest map.
#include "engine/runtime/limit_sweeper.h"

#include <gtest/gtest.h>

#include "tests/runtime/engine_doors.h"
#include "tests/support/fake_snapshot.h"

namespace palace {
namespace {

const SettingInfo& Slope() { return *FindSetting("slad.max_slope_deg"); }
const SettingInfo& Roughness() { return *FindSetting("slad.max_deviation_m"); }

EngineSnapshot OfMap(std::int64_t time_us) {
  EngineSnapshot snapshot = fake::Snapshot(MissionState::kProposed);
  auto decision = std::make_shared<TerrainDecision>(*snapshot.terrain->applied);
  decision->map_time = {time_us};
  snapshot.terrain.Edit().applied = decision;
  return snapshot;
}

TEST(LimitSweeper, GivesWhatTheSweepItselfGives) {
  const EngineSnapshot snapshot = OfMap(1'000'000);
  const LimitSweep expected = SweepLimit(*SweepOf(snapshot, Slope()), [] { return true; });
  LimitSweeper sweeper;
  EXPECT_EQ(sweeper.Latest(), nullptr);
  sweeper.Ask(snapshot, Slope(), 0);
  WaitFor([&] { return sweeper.Latest() != nullptr; });
  const auto sweep = sweeper.Latest();
  EXPECT_EQ(sweep->limit, "slad.max_slope_deg");
  ASSERT_EQ(sweep->values.size(), expected.values.size());
  for (std::size_t i = 0; i < expected.values.size(); ++i) {
    EXPECT_EQ(sweep->values[i].value, expected.values[i].value);
    EXPECT_EQ(sweep->values[i].safe_area_m2, expected.values[i].safe_area_m2);
    EXPECT_EQ(sweep->values[i].best, expected.values[i].best);
  }
}

TEST(LimitSweeper, AnotherLimitIsAnsweredAtOnceAndANewerMapAfterAWhile) {
  LimitSweeper sweeper;
  sweeper.Ask(OfMap(1'000'000), Slope(), 0);
  sweeper.Ask(OfMap(1'000'000), Roughness(), 0.1);
  WaitFor([&] { return sweeper.Latest() && sweeper.Latest()->limit == Roughness().name; });
  sweeper.Ask(OfMap(1'200'000), Roughness(), 0.3);  // too soon
  sweeper.Ask(OfMap(3'000'000), Roughness(), 2.2);
  WaitFor([&] {
    const Timestamp map_time = sweeper.Latest()->map_time;
    EXPECT_NE(map_time.us, 1'200'000);
    return map_time.us == 3'000'000;
  });
}

TEST(LimitSweeper, OtherLimitsAreAnotherQuestionButTheLimitItselfIsNot) {
  LimitSweeper sweeper;
  EngineSnapshot snapshot = OfMap(1'000'000);
  sweeper.Ask(snapshot, Slope(), 0);
  WaitFor([&] { return sweeper.Latest() != nullptr; });
  const auto first = sweeper.Latest();
  snapshot.session.Edit().preview_settings.slad.limits.max_slope_deg = 4;
  sweeper.Ask(snapshot, Slope(), 0.1);  // a drag of the limit that is swept
  snapshot.session.Edit().preview_settings.slad.limits.max_deviation_m = 0.04;
  sweeper.Ask(snapshot, Slope(), 0.2);
  WaitFor([&] { return sweeper.Latest() != first; });
  EXPECT_EQ(sweeper.Latest()->others.slad.limits.max_deviation_m, 0.04);
}

TEST(SweepOf, AsksNothingWithoutAMapOrOfWhatChangesTheMap) {
  EXPECT_FALSE(SweepOf(EngineSnapshot{}, Slope()));
  EXPECT_FALSE(SweepOf(OfMap(1'000'000), *FindSetting("slad.cell_m")));
  EXPECT_TRUE(SweepOf(OfMap(1'000'000), Slope()));
}

TEST(SweepOf, KnowsWhoWasRefused) {
  EngineSnapshot snapshot = OfMap(1'000'000);
  snapshot.flight.Edit().mission.refused_sites = {2};
  EXPECT_EQ(SweepOf(snapshot, Slope())->refused, std::vector<std::uint64_t>{2});
}

}  // namespace
}  // namespace palace
