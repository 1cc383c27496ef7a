// The history of the limits: one step a gesture, values as the engine reports them.
#include "gui/panels/tune/setting_history.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

constexpr const char* kSlope = "slad.max_slope_deg";

/// An engine that takes every command at once.
struct Desk {
  EngineSnapshot snap;
  SettingHistory history;

  void Set(const char* name, double value, const Gesture& gesture = {}) {
    history.Remember(CommandAction(SetSetting{name, value}), snap, gesture);
    const Status ignored = SetSettingValue(snap.session.Edit().preview_settings, name, value);
  }
  void Take(const std::vector<SetSetting>& sets) {
    for (const SetSetting& set : sets) {
      EXPECT_TRUE(SetSettingValue(snap.session.Edit().preview_settings, set.name, set.value).ok());
    }
  }
  double slope() const { return snap.session->preview_settings.slad.limits.max_slope_deg; }
};

TEST(SettingHistory, ADragIsOneStepHoweverLongItLasts) {
  Desk desk;
  desk.Set(kSlope, 9, {10.0, 9.5});
  desk.Set(kSlope, 8, {10.1, 9.5});
  desk.Set(kSlope, 7, {14.0, 9.5});
  desk.Set(kSlope, 6, {14.5, 14.4});  // another press
  ASSERT_EQ(desk.history.steps().size(), 2U);
  EXPECT_EQ(desk.history.steps()[0].changes[0].before, 10);
  EXPECT_EQ(desk.history.steps()[0].changes[0].after, 7);
  desk.Take(desk.history.Undo());
  EXPECT_EQ(desk.slope(), 7);
  desk.Take(desk.history.Undo());
  EXPECT_EQ(desk.slope(), 10);
  EXPECT_FALSE(desk.history.can_undo());
  desk.Take(desk.history.Redo());
  desk.Take(desk.history.Redo());
  EXPECT_EQ(desk.slope(), 6);
  EXPECT_FALSE(desk.history.can_redo());
}

TEST(SettingHistory, KeyStepsWithinASecondAreOneStep) {
  Desk desk;
  desk.Set(kSlope, 9.9, {1.0, NAN});
  desk.Set(kSlope, 9.8, {1.5, NAN});
  desk.Set(kSlope, 9.7, {3.0, NAN});
  EXPECT_EQ(desk.history.steps().size(), 2U);
}

TEST(SettingHistory, ADragThatTheEngineHasNotReportedYetKeepsItsFirstValue) {
  SettingHistory history;
  EngineSnapshot late;  // reports 10 all along
  history.Remember(CommandAction(SetSetting{kSlope, 9}), late, {1.0, 0.9});
  history.Remember(CommandAction(SetSetting{kSlope, 8}), late, {1.1, 0.9});
  ASSERT_EQ(history.steps().size(), 1U);
  EXPECT_EQ(history.steps()[0].changes[0].before, 10);
  EXPECT_EQ(history.steps()[0].changes[0].after, 8);
}

TEST(SettingHistory, WhatTheEngineRefusesOrLeavesAloneIsNoStep) {
  Desk desk;
  desk.Set(kSlope, 400);
  desk.Set("no.such_setting", 1);
  desk.Set(kSlope, 10);
  EXPECT_TRUE(desk.history.steps().empty());
  desk.history.Remember(CommandAction(WaveOff{}), desk.snap, {});
  desk.history.Remember(CommandAction(DiscardSettings{}), desk.snap, {});
  EXPECT_TRUE(desk.history.steps().empty());
}

TEST(SettingHistory, ALoadedPresetAndADiscardedPreviewAreOneStepEach) {
  Desk desk;
  desk.history.Remember({{kSlope, 8}, {"slad.max_deviation_m", 0.05}}, desk.snap);
  desk.Take({{kSlope, 8}, {"slad.max_deviation_m", 0.05}});
  desk.history.Remember(CommandAction(DiscardSettings{}), desk.snap, {});
  desk.snap.session.Edit().preview_settings = desk.snap.session->settings;
  ASSERT_EQ(desk.history.steps().size(), 2U);
  desk.Take(desk.history.Undo());
  EXPECT_EQ(desk.slope(), 8);
  EXPECT_EQ(desk.snap.session->preview_settings.slad.limits.max_deviation_m, 0.05);
  desk.Take(desk.history.Undo());
  EXPECT_TRUE(desk.snap.session->preview_settings == Settings{});
}

TEST(SettingHistory, ANewStepForgetsTheUndoneOnes) {
  Desk desk;
  desk.Set(kSlope, 9, {1, NAN});
  desk.Take(desk.history.Undo());
  desk.Set(kSlope, 8, {1.2, NAN});
  EXPECT_FALSE(desk.history.can_redo());
  ASSERT_EQ(desk.history.steps().size(), 1U);
  EXPECT_EQ(desk.history.steps()[0].changes[0].before, 10);
}

}  // namespace
}  // namespace palace
