// Every control of every workspace is reached and worked by the keyboard alone.
#include <set>

#include "gui/panels/diagnose/diagnose.h"
#include "gui/panels/review/review.h"
#include "gui/panels/tune/tune.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

using Draw = std::function<void(UiFrame&)>;

/// Presses Tab until it comes round again; the names in order.
std::vector<std::string> TabRound(UiHarness& ui, const Draw& draw) {
  std::vector<std::string> names;
  for (int i = 0; i < 200; ++i) {
    ui.Tap(ImGuiKey_Tab, draw);
    const std::string name(ui.focus.shown());
    if (!names.empty() && name == names.front()) {
      return names;
    }
    names.push_back(name);
  }
  ADD_FAILURE() << "Tab does not come round";
  return names;
}

void TabTo(UiHarness& ui, const std::string& name, const Draw& draw) {
  for (int i = 0; i < 200 && ui.focus.shown() != name; ++i) {
    ui.Tap(ImGuiKey_Tab, draw);
  }
  ASSERT_EQ(ui.focus.shown(), name);
}

void DownTo(UiHarness& ui, const std::string& name, const Draw& draw) {
  for (int i = 0; i < 200 && ui.focus.shown() != name; ++i) {
    ui.Tap(ImGuiKey_DownArrow, draw);
  }
  ASSERT_EQ(ui.focus.shown(), name);
}

void ExpectAll(const std::vector<std::string>& names, const std::vector<std::string>& wanted) {
  const std::set<std::string> found(names.begin(), names.end());
  EXPECT_EQ(found.size(), names.size()) << "a control comes twice in one round";
  for (const std::string& name : wanted) {
    EXPECT_EQ(found.count(name), 1U) << name;
  }
}

TEST(FlyKeyboard, TabReachesEveryControlSitesFirst) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kArmed));
  window.ui.focus.Clear();
  const auto names = TabRound(window.ui, window.draw);
  ExpectAll(names, {"site/A",
                    "site/B",
                    "site/C",
                    "site/D",
                    "refuse",
                    "approve",
                    "show_checks",
                    "depth",
                    "view/Orbit",
                    "view/Above",
                    "view/Behind",
                    "view_3d",
                    "map/elevation",
                    "map/slope",
                    "map/roughness",
                    "map/cost",
                    "map/safe_distance",
                    "tick/slad.max_slope_deg",
                    "tick/slad.max_deviation_m",
                    "tick/slad.nav_error_m",
                    "tab/Fly",
                    "tab/Tune",
                    "tab/Review",
                    "tab/Diagnose",
                    "alarm",
                    "acknowledge",
                    "shelve"});
  EXPECT_EQ(names[0], "site/A");
  FlyWindow descent(1920, 1080, fake::Snapshot(MissionState::kDescending));
  ExpectAll(TabRound(descent.ui, descent.draw),
            {"hold_here", "map/recheck", "tab/Descent", "tab/Maps", "depth", "view_3d"});
}

TEST(FlyKeyboard, AfterArmingByKeyTheHoldButtonHasTheFocusAndEnterHeldApproves) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  window.ui.Tap(ImGuiKey_Tab, window.draw);
  window.ui.Key(ImGuiKey_Enter, true);
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.ui.LastCommand<SelectSite>().site_id, 1U);
  window.snap = fake::Snapshot(MissionState::kArmed);
  window.Run(2);  // the Enter that armed is still down: it does not approve
  EXPECT_EQ(window.ui.focus.shown(), "approve");
  EXPECT_EQ(window.ui.highlighted_site, 0U);
  EXPECT_EQ(window.ui.CountCommands<ApproveSite>(), 0);
  window.ui.Key(ImGuiKey_Enter, false);
  window.Run(0.1);
  window.ui.Key(ImGuiKey_Enter, true);
  window.Run(1.1);
  EXPECT_EQ(window.ui.CountCommands<ApproveSite>(), 1);
}

TEST(FlyKeyboard, AfterArmingByMouseTheNextTabIsTheHoldButton) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  window.ui.Click("site/B", window.draw);
  window.snap = fake::Snapshot(MissionState::kArmed);
  window.Run(0.1);
  EXPECT_EQ(window.ui.focus.shown(), "");  // no ring for a mouse, and no Enter without a ring
  window.ui.Key(ImGuiKey_Enter, true);
  window.Run(1.5);
  window.ui.Key(ImGuiKey_Enter, false);
  EXPECT_EQ(window.ui.CountCommands<ApproveSite>(), 0);
  window.ui.Tap(ImGuiKey_Tab, window.draw);
  EXPECT_EQ(window.ui.focus.shown(), "approve");
}

TEST(FlyKeyboard, EscapeCancelsAHoldUnderWay) {
  for (const bool by_key : {false, true}) {
    FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kArmed));
    if (by_key) {
      TabTo(window.ui, "approve", window.draw);
      window.ui.Key(ImGuiKey_Enter, true);
    } else {
      window.ui.MoveTo("approve");
      window.Run(0.05);
      window.ui.Button(true);
    }
    window.Run(0.6);
    window.ui.Tap(ImGuiKey_Escape, window.draw);
    window.Run(2);
    EXPECT_EQ(window.ui.CountCommands<ApproveSite>(), 0) << "by key: " << by_key;
  }
}

TEST(FlyKeyboard, TheSiteWithTheFocusIsHighlightedAndComesIntoSight) {
  FlyWindow window(1280, 720, fake::Snapshot(MissionState::kProposed));
  for (const std::uint64_t id : {1U, 2U, 3U, 4U}) {
    window.ui.Tap(ImGuiKey_Tab, window.draw);
    EXPECT_EQ(window.ui.highlighted_site, id);
    EXPECT_NE(window.ui.items.Find(std::string(window.ui.focus.shown())), nullptr);
  }
  window.ui.Tap(ImGuiKey_Tab, window.draw);  // past the sites
  EXPECT_EQ(window.ui.highlighted_site, 0U);
}

TEST(FlyKeyboard, ArrowsMoveThePinOfTheMapAndEnterTakesItAway) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  TabTo(window.ui, "map/slope", window.draw);
  window.ui.Tap(ImGuiKey_UpArrow, window.draw);
  ASSERT_TRUE(window.fly.maps.probe.pinned.has_value());
  const Eigen::Vector2d first = *window.fly.maps.probe.pinned;
  window.ui.Tap(ImGuiKey_UpArrow, window.draw);
  const double cell_m = window.snap.terrain->applied->hazards->geometry.cell_m;
  EXPECT_NEAR(window.fly.maps.probe.pinned->x() - first.x(), cell_m, 1e-9);
  window.ui.Tap(ImGuiKey_RightArrow, window.draw);
  EXPECT_NEAR(window.fly.maps.probe.pinned->y() - first.y(), cell_m, 1e-9);
  window.ui.Tap(ImGuiKey_Enter, window.draw);
  EXPECT_FALSE(window.fly.maps.probe.pinned.has_value());
}

TEST(FlyKeyboard, TheWaveOffFiresByMouseWhileEnterIsHeldOnTheHoldButton) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kArmed));
  TabTo(window.ui, "approve", window.draw);
  window.ui.MoveTo("wave_off");
  window.ui.Key(ImGuiKey_Enter, true);
  window.Run(0.3);
  window.ui.Button(true);
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.ui.CountCommands<WaveOff>(), 1);
}

/// Tune over a snapshot that the engine keeps up with.
struct TuneDesk {
  TuneDesk() : snap(fake::Snapshot(MissionState::kSearch)) {
    draw = [this](UiFrame& f) { DrawTuneWorkspace(snap, BodyOf(1920, 1080), state, f); };
    ui.Frame(draw);
  }
  void Follow() {
    for (const Intent& intent : ui.intents) {
      const auto* command = std::get_if<CommandAction>(&intent);
      if (const auto* set = command != nullptr ? std::get_if<SetSetting>(command) : nullptr) {
        EXPECT_TRUE(
            SetSettingValue(snap.session.Edit().preview_settings, set->name, set->value).ok());
      }
    }
    ui.intents.clear();
    snap.session.Edit().settings = snap.session->preview_settings;
  }
  void Tap(ImGuiKey key, bool shift = false) {
    FeedModifiers(shift, false);
    ui.Tap(key, draw);
    FeedModifiers(false, false);
    Follow();
  }
  void GoTo(const std::string& setting) {
    TabTo(ui, "limits/changed", draw);
    ui.Tap(ImGuiKey_Tab, draw);
    DownTo(ui, "limit/" + setting, draw);
  }
  double Value(const char* setting) const {
    return GetSetting(snap.session->preview_settings, setting);
  }
  UiHarness ui{1920, 1080};
  EngineSnapshot snap;
  TuneState state;
  Draw draw;
};

TEST(TuneKeyboard, TabAndDownReachEveryLimitAlsoThoseOutOfSight) {
  TuneDesk desk;
  desk.state.folded.clear();
  ExpectAll(TabRound(desk.ui, desk.draw), {"limits/search", "limits/changed", "load_preset",
                                           "save_preset", "map/safe_distance", "map/cost"});
  TabTo(desk.ui, "limits/changed", desk.draw);
  desk.ui.Tap(ImGuiKey_Tab, desk.draw);
  std::set<std::string> seen;
  for (int i = 0; i < 200; ++i) {
    const std::string name(desk.ui.focus.shown());
    seen.insert(name);
    EXPECT_NE(desk.ui.items.Find(name), nullptr) << name << " is not in sight";
    desk.ui.Tap(ImGuiKey_DownArrow, desk.draw);
    if (desk.ui.focus.shown() == name) {
      break;
    }
  }
  for (const SettingInfo& info : SettingTable()) {
    EXPECT_EQ(seen.count("limit/" + info.name), 1U) << info.name;
  }
}

TEST(TuneKeyboard, ArrowsStepBackspaceResetsEnterTypes) {
  TuneDesk desk;
  desk.GoTo("slad.max_slope_deg");
  desk.Tap(ImGuiKey_LeftArrow);
  EXPECT_NEAR(desk.Value("slad.max_slope_deg"), 9.9, 1e-9);
  desk.Tap(ImGuiKey_RightArrow, true);
  EXPECT_NEAR(desk.Value("slad.max_slope_deg"), 10.9, 1e-9);
  desk.Tap(ImGuiKey_Backspace);
  EXPECT_EQ(desk.Value("slad.max_slope_deg"), 10);
  desk.Tap(ImGuiKey_Enter);
  desk.ui.Frame(desk.draw);
  desk.ui.Frame(desk.draw);
  for (const char c : std::string("7.5")) {
    ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
  }
  desk.ui.Frame(desk.draw);
  desk.Tap(ImGuiKey_Enter);
  EXPECT_EQ(desk.Value("slad.max_slope_deg"), 7.5);
  EXPECT_EQ(desk.ui.focus.shown(), "limit/slad.max_slope_deg");  // and stays there
  desk.Tap(ImGuiKey_RightArrow);
  EXPECT_NEAR(desk.Value("slad.max_slope_deg"), 7.6, 1e-9);
}

TEST(TuneKeyboard, EverySettingStepsUpAndBackWhereItCan) {
  TuneDesk desk;
  desk.state.folded.clear();
  for (const SettingInfo& info : SettingTable()) {
    SCOPED_TRACE(info.name);
    desk.ui.focus.Clear();
    desk.GoTo(info.name);
    const double before = desk.Value(info.name.c_str());
    desk.Tap(ImGuiKey_RightArrow);
    const double up = desk.Value(info.name.c_str());
    const bool at_end = before >= info.max;
    EXPECT_TRUE(up > before || at_end);
    desk.Tap(ImGuiKey_LeftArrow);
    if (!at_end) {
      EXPECT_NEAR(desk.Value(info.name.c_str()), before, 1e-9);
    }
  }
}

TEST(TuneKeyboard, TabLeavesATextFieldAndEscapeInItSetsNothing) {
  TuneDesk desk;
  desk.GoTo("slad.max_slope_deg");
  desk.Tap(ImGuiKey_Enter);
  desk.ui.Frame(desk.draw);
  desk.ui.Frame(desk.draw);
  EXPECT_TRUE(ImGui::GetIO().WantTextInput);
  ImGui::GetIO().AddInputCharacter('3');
  desk.ui.Frame(desk.draw);
  desk.Tap(ImGuiKey_Escape);
  desk.ui.Frame(desk.draw);
  EXPECT_FALSE(ImGui::GetIO().WantTextInput);
  EXPECT_EQ(desk.Value("slad.max_slope_deg"), 10);
  desk.Tap(ImGuiKey_Enter);
  desk.ui.Frame(desk.draw);
  desk.ui.Frame(desk.draw);
  desk.Tap(ImGuiKey_Tab);
  desk.ui.Frame(desk.draw);
  EXPECT_FALSE(ImGui::GetIO().WantTextInput);
  EXPECT_NE(desk.ui.focus.shown(), "limit/slad.max_slope_deg");
}

TEST(TuneKeyboard, ApplyAndDiscardArePressedByEnter) {
  TuneDesk desk;
  desk.snap = fake::Snapshot(MissionState::kArmed);
  desk.snap.session.Edit().preview_settings.slad.limits.max_slope_deg = 6;
  desk.snap.terrain.Edit().preview = desk.snap.terrain->applied;
  TabTo(desk.ui, "discard", desk.draw);
  desk.ui.Tap(ImGuiKey_Enter, desk.draw);
  EXPECT_EQ(desk.ui.CountCommands<DiscardSettings>(), 1);
  desk.ui.Tap(ImGuiKey_Tab, desk.draw);
  EXPECT_EQ(desk.ui.focus.shown(), "apply");
  desk.ui.Tap(ImGuiKey_Space, desk.draw);
  EXPECT_EQ(desk.ui.CountCommands<ApplySettings>(), 1);
}

TEST(ReviewKeyboard, TransportFieldsTimelineAndViewAreWorkedByKeys) {
  UiHarness ui(1920, 1080);
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed, SourceKind::kReplay);
  snap.session.Edit().recorded_settings.slad.limits.max_slope_deg = 7;
  ReviewState state;
  const Draw draw = [&](UiFrame& f) {
    DrawReviewWorkspace(snap, nullptr, BodyOf(1920, 1080), state, f);
  };
  ui.Frame(draw);
  ExpectAll(TabRound(ui, draw), {"to_start", "step_back", "play", "step_forward", "to_end", "speed",
                                 "timeline", "redecide", "field/slad.max_slope_deg", "view_3d",
                                 "view/Above", "map/Recorded", "map/Re-decided"});
  const auto last_playback = [&] {
    const auto* control = std::get_if<PlaybackControl>(&ui.intents.back());
    EXPECT_NE(control, nullptr);
    return control != nullptr ? *control : PlaybackControl{};
  };
  TabTo(ui, "timeline", draw);
  ui.Tap(ImGuiKey_RightArrow, draw);
  EXPECT_EQ(last_playback().kind, PlaybackControl::Kind::kSeek);
  EXPECT_NEAR(last_playback().value, snap.session->source.position_s + 0.1, 1e-9);
  const double span_s = state.timeline.to_s - state.timeline.from_s;
  ui.Tap(ImGuiKey_UpArrow, draw);
  EXPECT_LT(state.timeline.to_s - state.timeline.from_s, span_s);
  TabTo(ui, "field/slad.max_slope_deg", draw);
  ui.Tap(ImGuiKey_LeftArrow, draw);
  EXPECT_NEAR(ui.LastCommand<SetSetting>().value, 9.9, 1e-9);
  TabTo(ui, "view_3d", draw);
  ui.intents.clear();
  ui.Tap(ImGuiKey_LeftArrow, draw);
  ASSERT_EQ(ui.intents.size(), 1U);
  const auto* action = std::get_if<UiAction>(&ui.intents[0]);
  ASSERT_NE(action, nullptr);
  ASSERT_NE(std::get_if<MoveView3d>(action), nullptr);
  EXPECT_LT(std::get_if<MoveView3d>(action)->turn_x, 0);
}

TEST(DiagnoseKeyboard, TheListOfEventsScrolls) {
  UiHarness ui(1280, 720);
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  std::vector<Event> many;
  for (int i = 0; i < 200; ++i) {
    many.push_back({snap.time, EventKind::kState, "Event " + std::to_string(i)});
  }
  snap.session.Edit().events = std::make_shared<const std::vector<Event>>(many);
  DiagnoseState state;
  const Draw draw = [&](UiFrame& f) { DrawDiagnoseWorkspace(snap, BodyOf(1280, 720), state, f); };
  ui.Frame(draw);
  TabTo(ui, "events", draw);
  ui.Tap(ImGuiKey_DownArrow, draw);
  ui.Tap(ImGuiKey_DownArrow, draw);
  EXPECT_EQ(state.event_offset, 2);
  ui.Tap(ImGuiKey_UpArrow, draw);
  EXPECT_EQ(state.event_offset, 1);
}

}  // namespace
}  // namespace palace
