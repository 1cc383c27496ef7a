// What a log is decided with when other limits are asked for: they stand over the recorded ones.
#include "engine/runtime/wanted_settings.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

FlightRecord Recorded() {
  FlightRecord record;
  record.has_settings = true;
  record.settings_at_start.slad.limits.max_step_m = 0.12;
  record.settings_at_start.slad.fusion.frames_fused = 20;
  return record;
}

TEST(SettingsOfReplay, NothingAskedLeavesTheRecord) {
  const auto replay = SettingsOfReplay({}, Recorded());
  ASSERT_TRUE(replay.ok());
  EXPECT_EQ(replay->settings, Recorded().settings_at_start);
  EXPECT_FALSE(replay->redecide_with.has_value());
}

TEST(SettingsOfReplay, ALimitIsJudgedBesideTheRecordedOnes) {
  const auto replay = SettingsOfReplay({"", {"slad.max_slope_deg=6"}}, Recorded());
  ASSERT_TRUE(replay.ok());
  EXPECT_EQ(replay->settings, Recorded().settings_at_start);
  ASSERT_TRUE(replay->redecide_with.has_value());
  EXPECT_EQ(replay->redecide_with->slad.limits.max_slope_deg, 6);
  EXPECT_EQ(replay->redecide_with->slad.limits.max_step_m, 0.12);  // of the record
}

TEST(SettingsOfReplay, WhatMapsAreMadeWithHoldsFromTheStart) {
  const auto replay = SettingsOfReplay({"", {"slad.frames_fused=5"}}, Recorded());
  ASSERT_TRUE(replay.ok());
  EXPECT_EQ(replay->settings.slad.fusion.frames_fused, 5);
  EXPECT_EQ(replay->held, std::vector<std::string>{"slad.frames_fused"});
  EXPECT_EQ(replay->settings.slad.limits.max_step_m, 0.12);
}

TEST(SettingsOfReplay, AForeignLogBeginsWithWhatIsWanted) {
  const auto replay = SettingsOfReplay({"", {"slad.max_slope_deg=6"}}, FlightRecord{});
  ASSERT_TRUE(replay.ok());
  EXPECT_EQ(replay->settings.slad.limits.max_slope_deg, 6);
  EXPECT_FALSE(replay->redecide_with.has_value());
}

TEST(SettingsOfReplay, ABadValueIsAUsageError) {
  const auto replay = SettingsOfReplay({"", {"slad.max_slope_deg=300"}}, Recorded());
  ASSERT_FALSE(replay.ok());
  EXPECT_EQ(replay.error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace palace
