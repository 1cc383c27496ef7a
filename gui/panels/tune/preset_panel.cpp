#include "gui/panels/tune/preset_panel.h"

#include <algorithm>

#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/panel_frame.h"

namespace palace {
namespace {

/// The path, typed; every change is looked at.
void DrawPath(const Rect& field, PresetState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  FillRect(Canvas(), field, p.window, s.Fine(3));
  StrokeRect(Canvas(), field, p.strong_line, s.Fine(1), s.Fine(3));
  ImGui::SetCursorScreenPos({field.x + s.Px(4), field.y + s.Px(2)});
  ImGui::PushFont(s.body);
  ImGui::PushStyleColor(ImGuiCol_FrameBg, p.window);
  ImGui::PushStyleColor(ImGuiCol_Text, p.text1);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      ImVec2(s.Px(4), (field.h - s.Px(4) - s.body->FontSize) / 2));
  ImGui::SetNextItemWidth(field.w - s.Px(8));
  if (Interact(ui, "preset/path", field, kKeysOnly, state.field).key_pressed) {
    ImGui::SetKeyboardFocusHere();
  }
  if (ImGui::InputText("##preset_path", state.field, sizeof state.field)) {
    ui.intents.push_back(UiAction(LookAtPreset{state.field}));
  }
  ImGui::PopStyleVar();
  ImGui::PopStyleColor(2);
  ImGui::PopFont();
}

/// What is at that path, in a sentence.
std::string WordsOf(const PresetState& state) {
  const PresetLook& look = state.look;
  if (state.choice == PresetChoice::kSave) {
    return look.exists ? "A file of that name is there already. Saving replaces it."
                       : "A new file, with all limits as they are now.";
  }
  if (!look.problem.empty()) {
    return look.problem;
  }
  const std::size_t n = look.differences.size();
  return n == 0 ? "All its values are as now."
                : std::to_string(n) + (n == 1 ? " value differs" : " values differ") + " from now:";
}

void DrawDifferences(const Rect& area, const std::vector<SettingChange>& differences, UiFrame& ui) {
  const Style& s = ui.style;
  const float row = s.Px(24);
  const auto fit = static_cast<std::size_t>(std::max(0.0f, area.h / row));
  const std::size_t shown = differences.size() <= fit ? differences.size() : fit > 0 ? fit - 1 : 0;
  float y = area.y + row / 2;
  for (std::size_t i = 0; i < shown; ++i, y += row) {
    const SettingChange& change = differences[i];
    const SettingInfo* info = FindSetting(change.name);
    if (info == nullptr) {
      continue;
    }
    const std::string values =
        FormatSetting(*info, change.before) + " to " + FormatSetting(*info, change.after);
    const float room = area.w - TextWidth(s.body, values) - s.Px(12);
    DrawText(ui, s.body, s.palette.text2, area.x, y, FitWords(s.body, info->label, room));
    DrawText(ui, s.body, s.palette.text1, area.right(), y, values, Align::kRight);
    ui.items.Add("preset/difference/" + change.name, {area.x, y - row / 2, area.w, row}, true,
                 values);
  }
  if (shown < differences.size()) {
    DrawText(ui, s.body, s.palette.text2, area.x, y,
             "and " + std::to_string(differences.size() - shown) + " more");
  }
}

void DrawButtons(const Rect& row, PresetState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const float gap = s.Px(8), w = (row.w - gap) / 2;
  if (DrawButton(ui, "preset/cancel", {row.x, row.y, w, row.h}, "Cancel", {})) {
    ui.intents.push_back(UiAction(ChoosePreset{PresetChoice::kNone}));
  }
  const Rect act{row.x + w + gap, row.y, w, row.h};
  const PresetLook& look = state.look;
  ButtonLook button;
  button.font = s.medium;
  if (state.choice == PresetChoice::kLoad) {
    button.enabled = look.problem.empty() && !look.differences.empty();
    button.reason = look.problem.empty() ? "Nothing would change" : "It cannot be read";
    if (DrawButton(ui, "preset/load", act, "Load", button)) {
      ui.intents.push_back(UiAction(LoadPreset{look.path}));
    }
    return;
  }
  button.enabled = !look.path.empty();
  button.reason = "Type a file name";
  if (DrawButton(ui, look.exists ? "preset/replace" : "preset/save", act,
                 look.exists ? "Replace" : "Save", button)) {
    ui.intents.push_back(UiAction(SavePreset{look.path, look.exists}));
  }
}

}  // namespace

int ChangedFromPreset(const PresetState& state, const Settings& settings) {
  return static_cast<int>(
      std::count_if(SettingTable().begin(), SettingTable().end(), [&](const SettingInfo& info) {
        const double preset =
            state.values ? GetSetting(*state.values, info.name) : info.default_value;
        return GetSetting(settings, info.name) != preset;
      }));
}

void DrawPresetPanel(const Rect& rect, PresetState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const bool load = state.choice == PresetChoice::kLoad;
  const Rect content = DrawPanelFrame(ui, rect, load ? "Load a preset" : "Save as a preset");
  const float pad = s.Px(12), x = content.x + pad, w = content.w - 2 * pad;
  DrawText(ui, s.caption, s.palette.text2, x, content.y + s.Px(12), "File, with its folder");
  DrawPath({x, content.y + s.Px(24), w, s.Px(30)}, state, ui);
  const float buttons_y = rect.bottom() - pad - s.Px(32);
  float y = content.y + s.Px(74);
  for (const std::string& line : WrapText(s.body, WordsOf(state), w)) {
    if (y + s.Px(12) > buttons_y) {
      break;
    }
    DrawText(ui, s.body, s.palette.text1, x, y, line);
    y += s.Px(20);
  }
  if (load && state.look.problem.empty()) {
    DrawDifferences({x, y, w, buttons_y - s.Px(8) - y}, state.look.differences, ui);
  }
  DrawButtons({x, buttons_y, w, s.Px(32)}, state, ui);
}

}  // namespace palace
