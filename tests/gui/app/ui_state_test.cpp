// The window state is reduced by actions: what Escape closes, the 3-D view, undo.
#include "gui/app/ui_state.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

/// Everything open that Escape can close, on Fly.
UiState AllOpen() {
  UiState state;
  state.key_help = state.frame.history_open = state.fly.approve.show_guards = true;
  state.fly.maps.probe.pinned = Eigen::Vector2d(1, 2);
  state.focus.Show("approve");
  return state;
}

/// How many of them are open.
int Open(const UiState& state) {
  return static_cast<int>(state.key_help) + static_cast<int>(state.frame.history_open) +
         static_cast<int>(state.fly.approve.show_guards) +
         static_cast<int>(state.fly.maps.probe.pinned.has_value()) +
         static_cast<int>(!state.focus.shown().empty());
}

TEST(UiStateReduce, EscapeClosesOneThingAtATimeFromTheTop) {
  UiState state = AllOpen();
  Reduce(state, CloseTop{});
  EXPECT_FALSE(state.key_help);
  EXPECT_EQ(Open(state), 4);
  Reduce(state, CloseTop{});
  EXPECT_FALSE(state.frame.history_open);
  EXPECT_EQ(Open(state), 3);
  Reduce(state, CloseTop{});
  EXPECT_FALSE(state.fly.approve.show_guards);
  EXPECT_EQ(Open(state), 2);
  Reduce(state, CloseTop{});
  EXPECT_FALSE(state.fly.maps.probe.pinned.has_value());
  EXPECT_EQ(Open(state), 1);
  Reduce(state, CloseTop{});
  EXPECT_EQ(Open(state), 0);
}

TEST(UiStateReduce, EscapeKeepsALimitThatWasOnlyAskedFor) {
  UiState state;
  state.fly.maps.asked = TickMove{"slad.max_slope_deg", 8, {}};
  Reduce(state, CloseTop{});
  EXPECT_FALSE(state.fly.maps.asked.has_value());
}

TEST(UiStateReduce, AnEscapeThatCancelledAHoldClosesNothing) {
  UiState state = AllOpen();
  state.focus.TakeEscape();
  Reduce(state, CloseTop{});
  EXPECT_EQ(Open(state), 5);
}

TEST(UiStateReduce, EscapeUnpinsTheProbeOfTheWorkspaceShown) {
  UiState state;
  state.frame.workspace = Workspace::kReview;
  state.fly.maps.probe.pinned = state.review.probe.pinned = Eigen::Vector2d(1, 2);
  Reduce(state, CloseTop{});
  EXPECT_TRUE(state.fly.maps.probe.pinned.has_value());
  EXPECT_FALSE(state.review.probe.pinned.has_value());
}

TEST(UiStateReduce, EscapeClosesTheChoiceOfAPresetAndCtrlSOpensItOnTune) {
  UiState state;
  EXPECT_TRUE(Reduce(state, ChoosePreset{PresetChoice::kSave}).choose_preset);
  EXPECT_EQ(state.frame.workspace, Workspace::kTune);
  EXPECT_EQ(state.tune.preset.choice, PresetChoice::kSave);
  Reduce(state, CloseTop{});
  EXPECT_EQ(state.tune.preset.choice, PresetChoice::kNone);
}

TEST(UiStateReduce, TheViewTurnsZoomsAndHasItsPresetsWhereverItIsAskedFrom) {
  for (const Workspace workspace : {Workspace::kFly, Workspace::kReview}) {
    UiState state;
    Reduce(state, ShowWorkspace{workspace});
    const Eigen::Vector3d before = state.orbit.eye_W();
    MoveView3d move;
    move.turn_x = 40;
    Reduce(state, move);
    const Eigen::Vector3d turned = state.orbit.eye_W();
    EXPECT_GT((turned - before).norm(), 0.5);
    EXPECT_FALSE(state.orbit.preset().has_value());
    move = {};
    move.zoom = 2;
    Reduce(state, move);
    EXPECT_GT((state.orbit.eye_W() - turned).norm(), 0.5);
    Reduce(state, ShowView3dPreset{ViewPreset::kAbove});
    EXPECT_EQ(state.orbit.preset(), View3dPreset::kAbove);
    EXPECT_EQ(state.orbit_moves, 3U);
  }
}

TEST(UiStateReduce, AnotherWorkspaceForgetsHighlightAndFocusButNotThatOfTheTabs) {
  UiState state;
  Reduce(state, HighlightSite{7});
  state.focus.Show("site/A");
  Reduce(state, ShowWorkspace{Workspace::kTune});
  EXPECT_EQ(state.highlighted_site, 0U);
  EXPECT_EQ(state.focus.shown(), "");
  state.focus.Show("tab/Tune");
  Reduce(state, ShowWorkspace{Workspace::kReview});
  EXPECT_EQ(state.focus.shown(), "tab/Tune");
}

TEST(UiStateReduce, UndoAndRedoAskForTheValuesOfTheHistory) {
  UiState state;
  EngineSnapshot snap;
  state.tune.history.Remember(CommandAction(SetSetting{"slad.max_slope_deg", 7}), snap, {});
  UiRequest request = Reduce(state, UndoSetting{});
  ASSERT_EQ(request.settings.size(), 1U);
  EXPECT_EQ(request.settings[0].value, 10);
  request = Reduce(state, RedoSetting{});
  ASSERT_EQ(request.settings.size(), 1U);
  EXPECT_EQ(request.settings[0].value, 7);
  EXPECT_TRUE(Reduce(state, RedoSetting{}).settings.empty());
}

TEST(UiState, ALogOpensWhereItIsLookedAt) {
  EXPECT_EQ(FirstWorkspace(SourceChoice::kReplay), Workspace::kReview);
  for (const SourceChoice source : {SourceChoice::kSimulation, SourceChoice::kConnect,
                                    SourceChoice::kImages, SourceChoice::kCameras}) {
    EXPECT_EQ(FirstWorkspace(source), Workspace::kFly);
  }
}

TEST(UiStateReduce, TheTrackViewIsThatOfTheWorkspaceShown) {
  UiState state;
  Reduce(state, ToggleTrackView{});
  EXPECT_TRUE(state.fly.camera.track_view);
  Reduce(state, ShowWorkspace{Workspace::kTune});
  Reduce(state, ToggleTrackView{});
  EXPECT_TRUE(state.fly.camera.track_view) << "Tune has none";
  Reduce(state, ShowWorkspace{Workspace::kReview});
  Reduce(state, ToggleTrackView{});
  EXPECT_TRUE(state.review.track_view);
  Reduce(state, ShowWorkspace{Workspace::kFly});
  Reduce(state, ToggleTrackView{});
  EXPECT_FALSE(state.fly.camera.track_view);
  EXPECT_TRUE(state.review.track_view);
}

// Behind another workspace a mission may end, and the next one begin at another place.
TEST(UiState, AnAreaIsNotBroughtBackFromBehindAnotherWorkspace) {
  UiState state;
  state.fly.search_map.last_area.emplace();
  state.fly.search_map.put_aside = {{1, 2}};
  Reduce(state, ShowWorkspace{Workspace::kFly});  // no change
  EXPECT_TRUE(state.fly.search_map.last_area.has_value());
  Reduce(state, ShowWorkspace{Workspace::kTune});
  EXPECT_FALSE(state.fly.search_map.last_area.has_value());
  EXPECT_TRUE(state.fly.search_map.put_aside.empty());
}

TEST(UiState, APinStaysInNoWorkspaceThatWasLeft) {
  UiState state;
  state.fly.maps.probe.pinned = Eigen::Vector2d(1, 2);
  Reduce(state, ShowWorkspace{Workspace::kFly});  // no change
  EXPECT_TRUE(state.fly.maps.probe.pinned.has_value());
  Reduce(state, ShowWorkspace{Workspace::kTune});
  EXPECT_FALSE(state.fly.maps.probe.pinned.has_value());
}

}  // namespace
}  // namespace palace
