// Tune: texts stay in their panels; sliders, typing, undo, apply ask for the right thing.
#include "gui/panels/tune/tune.h"
#include "tests/gui/panels/panel_checks.h"
#include "tests/gui/panels/previewing.h"
#include "tests/support/fake_snapshot.h"
#include "tests/support/fake_sweep.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

Rect Body() { return BodyOf(1920, 1080); }

template <typename T>
const T* LastUiAction(const Intents& intents) {
  const T* found = nullptr;
  for (const Intent& intent : intents) {
    if (const auto* action = std::get_if<UiAction>(&intent)) {
      found = std::get_if<T>(action) != nullptr ? std::get_if<T>(action) : found;
    }
  }
  return found;
}

TEST(TuneWorkspace, TextsStayInTheirPanels) {
  const EngineSnapshot applied = fake::Snapshot(MissionState::kProposed);
  const EngineSnapshot preview = Previewing(MissionState::kArmed);
  for (const WindowSize& size : kWindowSizes) {
    UiHarness ui(size.width, size.height);
    const Rect body = BodyOf(size.width, size.height);
    for (const EngineSnapshot* snap : {&applied, &preview}) {
      for (const TuneTab tab :
           {TuneTab::kApply, TuneTab::kSweep, TuneTab::kCells, TuneTab::kHistory}) {
        SCOPED_TRACE(std::string(size.name) + (snap->terrain->preview ? " preview" : " applied"));
        TuneState state;
        state.tab = tab;
        MoveTwoLimits(state.history);
        state.sweep = fake::RoughnessSweep(*snap);
        ui.Frame([&](UiFrame& f) { DrawTuneWorkspace(*snap, body, state, f); });
        ExpectTextsInPanels(ui.items);
        ExpectPanelsApart(ui.items, body);
      }
    }
  }
}

TEST(TuneWorkspace, NothingKnownYetIsDrawnToo) {
  UiHarness ui(1920, 1080);
  const EngineSnapshot snap;
  TuneState state;
  ui.Frame([&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); });
  ExpectTextsInPanels(ui.items);
}

TEST(TuneWorkspace, DraggingASliderSetsTheLimitAtEveryMove) {
  UiHarness ui(1920, 1080);
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  TuneState state;
  const auto draw = [&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); };
  ui.Frame(draw);
  const Item* grab = ui.items.Find("limit/slad.max_slope_deg");
  ASSERT_NE(grab, nullptr);
  const ImVec2 from = grab->rect.centre();
  ui.MoveTo(from);
  ui.Frame(draw);
  ui.Button(true);
  ui.Frame(draw);
  EXPECT_EQ(ui.CountCommands<SetSetting>(), 0);  // a press alone moves nothing
  double last = snap.session->settings.slad.limits.max_slope_deg;
  for (int step = 1; step <= 3; ++step) {
    ui.MoveTo(ImVec2{from.x - 8.0f * static_cast<float>(step), from.y});
    ui.Frame(draw);
    ASSERT_EQ(ui.CountCommands<SetSetting>(), step);
    const SetSetting set = ui.LastCommand<SetSetting>();
    EXPECT_EQ(set.name, "slad.max_slope_deg");
    EXPECT_LT(set.value, last);
    last = set.value;
    snap.session.Edit().preview_settings.slad.limits.max_slope_deg =
        set.value;  // the engine follows
    snap.session.Edit().settings = snap.session->preview_settings;
  }
  ui.MoveTo(ImVec2{from.x - 4000, from.y});  // far over the end: stops at the limit
  ui.Frame(draw);
  EXPECT_EQ(ui.LastCommand<SetSetting>().value, FindSetting("slad.max_slope_deg")->min);
  const int asked = ui.CountCommands<SetSetting>();
  ui.Button(false);
  ui.Frame(draw);
  ui.MoveTo(from);
  ui.Frame(draw);
  EXPECT_EQ(ui.CountCommands<SetSetting>(), asked);  // let go: nothing follows the pointer
}

/// Types into the field of a setting and presses Enter.
void Type(UiHarness& ui, const std::string& setting, const char* text,
          const std::function<void(UiFrame&)>& draw) {
  ui.Frame(draw);
  ui.Click("field/" + setting, draw);
  ui.Frame(draw);
  ui.Frame(draw);
  for (const char* c = text; *c != '\0'; ++c) {
    ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(*c));
  }
  ui.Frame(draw);
  ui.Key(ImGuiKey_Enter, true);
  ui.Frame(draw);
  ui.Key(ImGuiKey_Enter, false);
  ui.Frame(draw);
}

TEST(TuneWorkspace, TypedValuesAreSetOrRefusedWithTheReason) {
  UiHarness ui(1920, 1080);
  const EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  TuneState state;
  const auto draw = [&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); };
  Type(ui, "slad.max_deviation_m", "6.5", draw);
  ASSERT_EQ(ui.CountCommands<SetSetting>(), 1);
  EXPECT_EQ(ui.LastCommand<SetSetting>().name, "slad.max_deviation_m");
  EXPECT_NEAR(ui.LastCommand<SetSetting>().value, 0.065, 1e-12);
  Type(ui, "slad.max_slope_deg", "60", draw);
  EXPECT_EQ(ui.CountCommands<SetSetting>(), 1);
  const Item* refused = ui.items.Find("refused/slad.max_slope_deg");
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(refused->text, "60.0° refused, max 45.0°");
}

struct Typed {
  const char* setting;
  const char* text;
  bool accepted;
  double value;
  const char* refusal;
};

TEST(SliderRow, ParsesWhatPeopleType) {
  const Typed table[] = {
      {"slad.max_slope_deg", "8", true, 8, ""},
      {"slad.max_slope_deg", "8,5°", true, 8.5, ""},
      {"slad.max_deviation_m", "8 cm", true, 0.08, ""},
      {"slad.max_deviation_m", "0.2", false, 0, "0.2 cm refused, min 0.5 cm"},
      {"slad.max_slope_deg", "abc", false, 0, "\"abc\" is not a number"},
      {"slad.max_slope_deg", "8 m", false, 0, "\"8 m\" is not a number"},
      {"slad.max_slope_deg", "nan", false, 0, "\"nan\" is not a number"},
      {"slad.max_slope_deg", "", false, 0, "\"\" is not a number"},
      {"slad.grid_rows", "10.5", false, 0, "10 refused, must be a whole number"},
      {"stereo.block_size_px", "6", false, 0, "6 px refused, must be odd"},
      {"stereo.num_disparities", "40", false, 0, "40 px refused, must be a multiple of 16"},
  };
  for (const Typed& row : table) {
    SCOPED_TRACE(std::string(row.setting) + " " + row.text);
    double value = 0;
    std::string refusal;
    EXPECT_EQ(ParseTyped(*FindSetting(row.setting), Settings{}, row.text, value, refusal),
              row.accepted);
    EXPECT_EQ(refusal, row.refusal);
    if (row.accepted) {
      EXPECT_NEAR(value, row.value, 1e-12);
    }
  }
}

TEST(SliderRow, TrackReachesBothHardLimitsAndInvertsItself) {
  for (const SettingInfo& info : SettingTable()) {
    SCOPED_TRACE(info.name);
    EXPECT_NEAR(TrackValue(info, 0), info.min, 1e-9);
    EXPECT_NEAR(TrackValue(info, 1), info.max, 1e-9);
    for (int i = 0; i <= 20; ++i) {
      const double value = info.min + (info.max - info.min) * i / 20;
      EXPECT_NEAR(TrackValue(info, TrackShare(info, value)), value, 1e-4 * (info.max - info.min));
    }
  }
}

TEST(TuneWorkspace, ResetAppearsOnlyWhenChangedAndSetsTheDefault) {
  UiHarness ui(1920, 1080);
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  TuneState state;
  const auto draw = [&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); };
  ui.Frame(draw);
  EXPECT_EQ(ui.items.Find("reset/slad.max_slope_deg"), nullptr);
  snap.session.Edit().settings.slad.limits.max_slope_deg =
      snap.session.Edit().preview_settings.slad.limits.max_slope_deg = 7;
  ui.Frame(draw);
  ui.Click("reset/slad.max_slope_deg", draw);
  EXPECT_EQ(ui.LastCommand<SetSetting>().value, 10);
}

// The same place has one name before and after; one that the flight has not named is called new.
TEST(TuneWorkspace, NamesAPlaceThatOnlyThePreviewHasAsNew) {
  EngineSnapshot snap = Previewing(MissionState::kArmed);
  TerrainDecision preview = *snap.terrain->preview;
  preview.selection.sites.front().id = kFirstUnnamedSite + 1;
  preview.selection.sites.front().letter = "+1";
  snap.terrain.Edit().preview = std::make_shared<const TerrainDecision>(preview);
  UiHarness ui(1920, 1080);
  TuneState state;
  ui.Frame([&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); });
  EXPECT_TRUE(HasText(ui.items, "Site A loses its rank to a new place, +1."));
  EXPECT_TRUE(HasText(ui.items, "Site chosen in preview"));
  ExpectTextsInPanels(ui.items);
}

TEST(TuneWorkspace, ApplyIsOfferedOnlyForAPreviewThatMayApply) {
  const struct {
    MissionState state;
    bool apply, discard;
  } table[] = {{MissionState::kSearch, false, false},    {MissionState::kProposed, false, false},
               {MissionState::kArmed, true, true},       {MissionState::kApproved, true, true},
               {MissionState::kDescending, false, true}, {MissionState::kHold, true, true}};
  for (const auto& row : table) {
    SCOPED_TRACE(MissionStateName(row.state));
    UiHarness ui(1920, 1080);
    EngineSnapshot snap = Previewing(row.state);
    TuneState state;
    const auto draw = [&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); };
    ui.Frame(draw);
    ui.Click("apply", draw);
    EXPECT_EQ(ui.CountCommands<ApplySettings>(), row.apply ? 1 : 0);
    ui.Click("discard", draw);
    EXPECT_EQ(ui.CountCommands<DiscardSettings>(), row.discard ? 1 : 0);
  }
}

TEST(TuneWorkspace, SearchAndGroupsChooseTheRows) {
  UiHarness ui(1920, 1080);
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  TuneState state;
  const auto draw = [&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); };
  ui.Frame(draw);
  EXPECT_NE(ui.items.Find("field/slad.max_slope_deg"), nullptr);
  EXPECT_EQ(ui.items.Find("field/tracking.min_coherence"), nullptr);  // folded
  ui.Click("group/Hazard limits", draw);
  ui.Frame(draw);
  EXPECT_EQ(ui.items.Find("field/slad.max_slope_deg"), nullptr);
  std::snprintf(state.search, sizeof state.search, "COHERENCE");
  ui.Frame(draw);
  EXPECT_NE(ui.items.Find("field/tracking.min_coherence"), nullptr);  // search opens groups
  EXPECT_EQ(ui.items.Find("field/slad.cell_m"), nullptr);
  state.search[0] = '\0';
  snap.session.Edit().preview_settings.slad.grid.cell_m = 0.3;
  ui.Click("limits/changed", draw);
  ui.Frame(draw);
  EXPECT_NE(ui.items.Find("field/slad.cell_m"), nullptr);
  EXPECT_EQ(ui.items.Find("field/slad.max_rock_size_m"), nullptr);
  const auto says = [&](const char* words) {
    ui.Frame(draw);
    return std::any_of(ui.items.items().begin(), ui.items.items().end(),
                       [&](const Item& item) { return item.name == "text" && item.text == words; });
  };
  std::snprintf(state.search, sizeof state.search, "coherence");
  EXPECT_TRUE(says("No changed limit has that name."));
  state.changed_only = false;
  std::snprintf(state.search, sizeof state.search, "zzz");
  EXPECT_TRUE(says("No limit has that name."));
}

TEST(TuneWorkspace, PresetAndUndoButtonsAsk) {
  UiHarness ui(1920, 1080);
  const EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  TuneState state;
  state.preset.path = "config/r50-field.toml";
  MoveTwoLimits(state.history);
  const auto draw = [&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); };
  ui.Frame(draw);
  ui.Click("undo", draw);
  EXPECT_NE(LastUiAction<UndoSetting>(ui.intents), nullptr);
  ui.Click("load_preset", draw);
  ASSERT_NE(LastUiAction<ChoosePreset>(ui.intents), nullptr);
  EXPECT_EQ(LastUiAction<ChoosePreset>(ui.intents)->choice, PresetChoice::kLoad);
  ui.Click("save_preset", draw);
  EXPECT_EQ(LastUiAction<ChoosePreset>(ui.intents)->choice, PresetChoice::kSave);
  EXPECT_EQ(LastUiAction<LoadPreset>(ui.intents), nullptr) << "nothing is read or written yet";
  EXPECT_EQ(LastUiAction<SavePreset>(ui.intents), nullptr);
}

TEST(TuneWorkspace, APresetIsLookedAtBeforeItIsLoadedOrReplaced) {
  const EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  const struct {
    const char* what;
    PresetChoice choice;
    bool exists;
    const char* problem;
    std::vector<SettingChange> differences;
    const char* button;
    bool enabled;
  } table[] = {
      {"differs",
       PresetChoice::kLoad,
       true,
       "",
       {{"slad.max_slope_deg", 10, 7}},
       "preset/load",
       true},
      {"as now", PresetChoice::kLoad, true, "", {}, "preset/load", false},
      {"broken", PresetChoice::kLoad, true, "a.toml:2: unknown key", {}, "preset/load", false},
      {"new", PresetChoice::kSave, false, "", {}, "preset/save", true},
      {"there already", PresetChoice::kSave, true, "", {}, "preset/replace", true}};
  for (const auto& row : table) {
    SCOPED_TRACE(row.what);
    for (const WindowSize& size : kWindowSizes) {
      UiHarness ui(size.width, size.height);
      TuneState state;
      state.preset.choice = row.choice;
      state.preset.look = {"a.toml", row.exists, row.problem, row.differences};
      const Rect body = BodyOf(size.width, size.height);
      const auto draw = [&](UiFrame& f) { DrawTuneWorkspace(snap, body, state, f); };
      ui.Frame(draw);
      ExpectTextsInPanels(ui.items);
      ExpectPanelsApart(ui.items, body);
      ASSERT_NE(ui.items.Find(row.button), nullptr);
      EXPECT_EQ(ui.items.Find(row.button)->enabled, row.enabled);
      EXPECT_EQ(ui.items.Find("preset/difference/slad.max_slope_deg") != nullptr,
                !row.differences.empty());
      if (row.choice == PresetChoice::kSave) {
        ui.Click(row.button, draw);
        ASSERT_NE(LastUiAction<SavePreset>(ui.intents), nullptr);
        EXPECT_EQ(LastUiAction<SavePreset>(ui.intents)->path, "a.toml");
        EXPECT_EQ(LastUiAction<SavePreset>(ui.intents)->replace, row.exists);
      }
    }
  }
}

TEST(LimitsName, CallsNothingDefaultsThatIsNot) {
  TuneState state;
  Settings applied;
  EXPECT_EQ(LimitsName(state, applied), "defaults");
  applied.slad.limits.max_slope_deg = 7;
  applied.slad.limits.max_step_m = 0.1;
  EXPECT_EQ(LimitsName(state, applied), "2 changed");
  state.preset.path = "config/r50-field.toml";
  state.preset.values = applied;
  EXPECT_EQ(LimitsName(state, applied), "r50-field");
  applied.slad.limits.max_slope_deg = 6;
  EXPECT_EQ(LimitsName(state, applied), "r50-field + 1 change");
  applied.slad.limits.max_step_m = 0.12;
  EXPECT_EQ(LimitsName(state, applied), "r50-field + 2 changes");
}

}  // namespace
}  // namespace palace
