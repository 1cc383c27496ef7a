// Which limits are in force, previewed and on record, in flight and in replay.
#include "engine/runtime/settings_state.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

const char* kSlope = "slad.max_slope_deg";

TEST(SettingsState, AMovedLimitAppliesAtOnceWhileSearching) {
  SettingsState state{Settings{}};
  ASSERT_TRUE(state.Set(kSlope, 7, false));
  EXPECT_EQ(state.applied().slad.limits.max_slope_deg, 7);
  EXPECT_FALSE(state.previewing());
}

TEST(SettingsState, AMovedLimitPreviewsOnlyWhileArmed) {
  SettingsState state{Settings{}};
  ASSERT_TRUE(state.Set(kSlope, 7, true));
  EXPECT_EQ(state.applied().slad.limits.max_slope_deg, 10);
  EXPECT_TRUE(state.previewing());
  state.Discard();
  EXPECT_FALSE(state.previewing());
  ASSERT_TRUE(state.Set(kSlope, 6, true));
  state.Apply();
  EXPECT_EQ(state.applied().slad.limits.max_slope_deg, 6);
}

TEST(SettingsState, ARefusedValueChangesNothing) {
  SettingsState state{Settings{}};
  EXPECT_FALSE(state.Set(kSlope, 700, false));
  EXPECT_EQ(state.applied(), Settings{});
}

TEST(SettingsState, ReplayFollowsTheRecordUntilTheReviewerMovesALimit) {
  SettingsState state{Settings{}};
  ASSERT_TRUE(state.SetRecorded(kSlope, 8, false));
  EXPECT_EQ(state.applied().slad.limits.max_slope_deg, 8);
  EXPECT_FALSE(state.redecided());
  ASSERT_TRUE(state.Set(kSlope, 5, false));
  EXPECT_TRUE(state.redecided());
  ASSERT_TRUE(state.SetRecorded(kSlope, 9, false));
  EXPECT_EQ(state.recorded().slad.limits.max_slope_deg, 9);
  EXPECT_EQ(state.applied().slad.limits.max_slope_deg, 5);
}

TEST(SettingsState, AJumpRestoresTheRecordAndKeepsWhatTheReviewerMoved) {
  SettingsState state{Settings{}};
  Settings later;
  later.slad.limits.max_slope_deg = 6;
  later.slad.limits.max_step_m = 0.12;
  state.RestoreRecorded(later);
  EXPECT_EQ(state.applied(), later);
  EXPECT_FALSE(state.redecided());
  ASSERT_TRUE(state.Set(kSlope, 3, false));
  state.RestoreRecorded(Settings{});
  EXPECT_EQ(state.recorded(), Settings{});
  EXPECT_EQ(state.applied().slad.limits.max_slope_deg, 3);
  EXPECT_EQ(state.applied().slad.limits.max_step_m, Settings{}.slad.limits.max_step_m);
}

TEST(SettingsState, WhatTheReviewerHoldsStaysAfterAJumpAndAfterTheRecordMovesIt) {
  Settings wanted;
  wanted.slad.fusion.frames_fused = 5;
  SettingsState state{wanted};
  state.Redecide(wanted, {"slad.frames_fused"});
  ASSERT_TRUE(state.SetRecorded("slad.frames_fused", 12, false));
  state.RestoreRecorded(Settings{});
  EXPECT_EQ(state.recorded().slad.fusion.frames_fused, 5);
  EXPECT_EQ(state.applied().slad.fusion.frames_fused, 5);
  ASSERT_TRUE(state.SetRecorded(kSlope, 8, false));  // limits follow the record
  EXPECT_EQ(state.applied().slad.limits.max_slope_deg, 8);
}

}  // namespace
}  // namespace palace
