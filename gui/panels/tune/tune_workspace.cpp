// Tune: what the panels share, and where they lie.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "gui/panels/fly_layout.h"
#include "gui/panels/tune/tune.h"
#include "gui/widgets/button.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

void DrawMapRow(const EngineSnapshot& snap, const Rect& row, TuneState& state, UiFrame& ui) {
  const float gap = ui.style.Px(8);
  const float w = std::floor((row.w - 3 * gap) / 4);
  const MapKind kinds[] = {MapKind::kElevation, MapKind::kSlope, MapKind::kRoughness,
                           MapKind::kCost};
  for (int i = 0; i < 4; ++i) {
    const float x = row.x + static_cast<float>(i) * (w + gap);
    const float width = i == 3 ? row.right() - x : w;
    DrawTuneMap(snap, {x, row.y, width, row.h}, kinds[i], true, state, ui);
  }
}

void DrawWideCentre(const EngineSnapshot& snap, const Rect& c, TuneState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const float gap = s.Px(8), strip = s.Px(104);
  const float both = c.h - strip - 2 * gap;
  const float map_w = std::floor((c.w - 3 * gap) / 4);
  // The four small maps are as wide as their panels; the picture takes what is left.
  const float lower = std::min(map_w + s.Px(70), std::round(both * 0.42f));
  const float upper = both - lower;
  const float camera_w = std::min(std::round(c.w * 0.59f), std::floor((upper - s.Px(28)) * 4 / 3));
  DrawTuneCamera(snap, {c.x, c.y, camera_w, upper}, state, ui);
  DrawTuneMap(snap, {c.x + camera_w + gap, c.y, c.w - camera_w - gap, upper},
              MapKind::kSafeDistance, true, state, ui);
  DrawMapRow(snap, {c.x, c.y + upper + gap, c.w, lower}, state, ui);
  DrawCompareStrip(snap, {c.x, c.bottom() - strip, c.w, strip}, state, ui);
}

void DrawRight(const EngineSnapshot& snap, const Rect& r, TuneState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const float gap = s.Px(8);
  const float cells = s.Px(190), chosen = s.Px(126), apply = s.Px(190);
  // What is left is the sweep's and the history's, which has two rows at least.
  const float left = r.h - cells - chosen - apply - 4 * gap;
  const float sweep = std::min(s.Px(260), left - s.Px(28 + 2 * 28 + 4));
  float y = r.y;
  DrawCellsPanel(snap, {r.x, y, r.w, cells}, ui);
  y += cells + gap;
  DrawSweepPanel(snap, {r.x, y, r.w, sweep}, state, ui);
  y += sweep + gap;
  DrawChosenPanel(snap, {r.x, y, r.w, chosen}, ui);
  y += chosen + gap;
  DrawHistoryPanel(snap, {r.x, y, r.w, r.bottom() - apply - gap - y}, state, ui);
  DrawApplyPanel(snap, {r.x, r.bottom() - apply, r.w, apply}, ui);
}

void DrawNarrowTabs(const EngineSnapshot& snap, const Rect& r, TuneState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const struct {
    const char* label;
    TuneTab tab;
  } tabs[] = {{"Apply", TuneTab::kApply},
              {"Sweep", TuneTab::kSweep},
              {"Cells", TuneTab::kCells},
              {"History", TuneTab::kHistory}};
  DrawPanelBackground(ui, {r.x, r.y, r.w, s.Px(32)}, "Tabs");
  float x = r.x + s.Px(4);
  for (const auto& tab : tabs) {
    const Rect box{x, r.y + s.Px(4), s.Px(84), s.Px(24)};
    ButtonLook look;
    look.active = state.tab == tab.tab;
    if (DrawButton(ui, std::string("tune_tab/") + tab.label, box, tab.label, look)) {
      state.tab = tab.tab;
    }
    x = box.right() + s.Px(8);
  }
  const Rect content{r.x, r.y + s.Px(36), r.w, r.h - s.Px(36)};
  if (state.tab == TuneTab::kApply) {
    DrawApplyPanel(snap, content, ui);
  } else if (state.tab == TuneTab::kSweep) {
    DrawSweepPanel(snap, content, state, ui);
  } else if (state.tab == TuneTab::kCells) {
    const float half = std::floor((content.w - s.Px(8)) / 2);
    DrawCellsPanel(snap, {content.x, content.y, half, content.h}, ui);
    DrawChosenPanel(snap, {content.x + half + s.Px(8), content.y, half, content.h}, ui);
  } else {
    DrawHistoryPanel(snap, content, state, ui);
  }
}

void DrawNarrowCentre(const EngineSnapshot& snap, const Rect& c, TuneState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const float gap = s.Px(8), strip = s.Px(88), tabs = s.Px(172);
  const float upper = c.h - strip - tabs - 2 * gap;
  const float camera_w = std::floor((upper - s.Px(28)) * 4 / 3);
  ui.tab.group = kViewTabs;
  DrawTuneCamera(snap, {c.x, c.y, camera_w, upper}, state, ui);
  const float left = c.x + camera_w + gap;
  const float w = std::floor((c.right() - left - gap) / 2), h = std::floor((upper - gap) / 2);
  const MapKind kinds[] = {MapKind::kSafeDistance, MapKind::kSlope, MapKind::kRoughness,
                           MapKind::kCost};
  for (int i = 0; i < 4; ++i) {
    const float x = left + static_cast<float>(i % 2) * (w + gap);
    const float y = c.y + static_cast<float>(i / 2) * (h + gap);
    DrawTuneMap(snap, {x, y, w, h}, kinds[i], false, state, ui);
  }
  DrawCompareStrip(snap, {c.x, c.y + upper + gap, c.w, strip}, state, ui);
  ui.tab.group = kDecisionTabs;
  DrawNarrowTabs(snap, {c.x, c.bottom() - tabs, c.w, tabs}, state, ui);
}

/// A site that was lost just now makes of a preview what applies at once.
void FollowApply(LimitsApply now, TuneState& state, const UiFrame& ui) {
  constexpr double kToRead_s = 1.5;
  if (std::exchange(state.told, now) != now && now == LimitsApply::kAtOnce) {
    state.withheld_until_s = ui.ui_time_s + kToRead_s;
  }
}

/// The limit that a person moved last is the one to ask about.
void FollowHistory(TuneState& state) {
  const std::size_t done = state.history.done();
  if (done == std::exchange(state.swept.after_steps, done) || done == 0) {
    return;
  }
  for (const SettingChange& change : state.history.steps()[done - 1].changes) {
    const SettingInfo* info = FindSetting(change.name);
    if (info != nullptr && MaySweep(*info)) {
      state.swept.limit = change.name;
      return;
    }
  }
}

}  // namespace

bool IsWithheld(const TuneState& state, const UiFrame& ui) {
  return ui.ui_time_s < state.withheld_until_s;
}

TuneFacts FactsOf(const EngineSnapshot& snap) {
  TuneFacts facts;
  facts.applied = snap.terrain->applied.get();
  facts.shown = snap.terrain->Shown();
  facts.previewing = snap.terrain->preview != nullptr;
  facts.best_shown = BestSite(snap, facts.shown);
  facts.best_applied = BestSite(snap, facts.applied);
  for (const SettingInfo& info : SettingTable()) {
    const double value = GetSetting(snap.session->preview_settings, info.name);
    facts.changed += value != info.default_value ? 1 : 0;
    facts.pending += value != GetSetting(snap.session->settings, info.name) ? 1 : 0;
  }
  return facts;
}

std::string PresetName(const TuneState& state) {
  const std::filesystem::path path(state.preset.path);
  return path.empty() ? "defaults"
                      : (path.extension() == ".toml" ? path.stem() : path.filename()).string();
}

std::string LimitsName(const TuneState& state, const Settings& applied) {
  const int changed = ChangedFromPreset(state.preset, applied);
  if (changed == 0) {
    return PresetName(state);
  }
  return state.preset.path.empty() ? std::to_string(changed) + " changed"
                                   : PresetName(state) + " + " + std::to_string(changed) +
                                         (changed == 1 ? " change" : " changes");
}

void DrawTuneWorkspace(const EngineSnapshot& snap, const Rect& body, TuneState& state,
                       UiFrame& ui) {
  const Style& s = ui.style;
  BeginProbe(state.probe);
  BeginPlots(state.sweep_hover);
  FollowHistory(state);
  FollowApply(snap.session->limits_apply, state, ui);
  const bool narrow = IsNarrowBody(body, s);
  const float gap = s.Px(8), left = s.Px(narrow ? 344 : 416), right = s.Px(400);
  DrawLimitsPanel(snap, {body.x, body.y, left, body.h}, state, ui);
  const float x = body.x + left + gap;
  if (narrow) {
    DrawNarrowCentre(snap, {x, body.y, body.right() - x, body.h}, state, ui);
  } else {
    ui.tab.group = kViewTabs;
    DrawWideCentre(snap, {x, body.y, body.right() - right - gap - x, body.h}, state, ui);
    ui.tab.group = kDecisionTabs;
    DrawRight(snap, {body.right() - right, body.y, right, body.h}, state, ui);
  }
  DrawProbeWhy(ui, body, FactsOf(snap).shown, state.probe, snap.time);
}

}  // namespace palace
