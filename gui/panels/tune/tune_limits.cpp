// Limits panel of Tune: search, groups that fold, slider rows, preset foot.
#include <algorithm>
#include <cctype>

#include "gui/panels/tune/tune.h"
#include "gui/widgets/button.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

std::string Lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// A group heading (info null) or a setting.
struct ListRow {
  std::string group;
  const SettingInfo* info = nullptr;
  int changed_in_group = 0;
};

std::string GroupItemName(const ListRow& heading) { return "group/" + heading.group; }
std::string ItemName(const ListRow& row) {
  return row.info != nullptr ? "limit/" + row.info->name : GroupItemName(row);
}

bool IsChanged(const Settings& settings, const SettingInfo& info) {
  return GetSetting(settings, info.name) != info.default_value;
}

bool Matches(const SettingInfo& info, const std::string& wanted) {
  return wanted.empty() || Lower(info.label).find(wanted) != std::string::npos ||
         info.name.find(wanted) != std::string::npos;
}

std::vector<ListRow> RowsOf(const Settings& settings, const TuneState& state) {
  const std::string wanted = Lower(state.search);
  std::vector<ListRow> rows;
  std::vector<std::string> groups;
  for (const SettingInfo& info : SettingTable()) {
    if (std::find(groups.begin(), groups.end(), info.group) == groups.end()) {
      groups.push_back(info.group);
    }
  }
  for (const std::string& group : groups) {
    ListRow heading{group, nullptr, 0};
    std::vector<ListRow> inside;
    for (const SettingInfo& info : SettingTable()) {
      if (info.group != group) {
        continue;
      }
      const bool changed = IsChanged(settings, info);
      heading.changed_in_group += changed ? 1 : 0;
      if (Matches(info, wanted) && (changed || !state.changed_only)) {
        inside.push_back({group, &info, 0});
      }
    }
    const bool filtered = !wanted.empty() || state.changed_only;
    if (filtered && inside.empty()) {
      continue;
    }
    rows.push_back(heading);
    if (filtered || state.folded.count(group) == 0) {
      rows.insert(rows.end(), inside.begin(), inside.end());
    }
  }
  return rows;
}

void DrawSearch(UiFrame& ui, const Rect& field, TuneState& state) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  FillRect(Canvas(), field, p.window, s.Fine(3));
  StrokeRect(Canvas(), field, p.strong_line, s.Fine(1), s.Fine(3));
  DrawIcon(Canvas(), Icon::kSearch, {field.x + s.Px(16), field.centre().y}, s.Px(16), p.text3);
  ImGui::SetCursorScreenPos({field.x + s.Px(26), field.y + s.Px(2)});
  ImGui::PushFont(s.body);
  ImGui::PushStyleColor(ImGuiCol_FrameBg, p.window);
  ImGui::PushStyleColor(ImGuiCol_Text, p.text1);
  ImGui::PushStyleColor(ImGuiCol_TextDisabled, p.text3);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      ImVec2(s.Px(4), (field.h - s.Px(4) - s.body->FontSize) / 2));
  ImGui::SetNextItemWidth(field.w - s.Px(30));
  if (Interact(ui, "limits/search", field, kKeysOnly, state.search).key_pressed) {
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::InputTextWithHint("##search_limits", "Search limits", state.search, sizeof state.search);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor(3);
  ImGui::PopFont();
}

void DrawHeading(UiFrame& ui, const Rect& row, const ListRow& heading, TuneState& state) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const bool folded = state.folded.count(heading.group) != 0;
  const float middle = row.centre().y;
  const Interaction in = Interact(ui, GroupItemName(heading), row, 0, heading.group);
  if (in.hovered) {
    FillRect(Canvas(), row, p.control);
  }
  DrawIcon(Canvas(), folded ? Icon::kChevronRight : Icon::kChevronDown, {row.x + s.Px(20), middle},
           s.Px(12), p.text2);
  DrawText(ui, s.medium, p.text1, row.x + s.Px(34), middle, heading.group);
  if (heading.changed_in_group > 0) {
    DrawText(ui, s.caption, p.text2, row.right() - s.Px(14), middle,
             std::to_string(heading.changed_in_group) + " changed", Align::kRight);
  }
  if (in.clicked) {
    if (folded) {
      state.folded.erase(heading.group);
    } else {
      state.folded.insert(heading.group);
    }
  }
}

/// Heights of the rows, and how many fit from one of them on.
struct ListMetrics {
  float row = 0, group = 0, area = 0;
  float HeightOf(const ListRow& r) const { return r.info != nullptr ? row : group; }
  int Fitting(const std::vector<ListRow>& rows, int first) const {
    int count = 0;
    float room = area + 0.5f;
    for (std::size_t i = static_cast<std::size_t>(first); i < rows.size(); ++i, ++count) {
      room -= HeightOf(rows[i]);
      if (room < 0) {
        break;
      }
    }
    return count;
  }
};

/// The list scrolls by whole rows, so that no text is ever cut, by the wheel or after the focus.
void ScrollList(const UiFrame& ui, const std::vector<ListRow>& rows, const ListMetrics& metrics,
                float wheel, TuneState& state) {
  const int count = static_cast<int>(rows.size());
  int last_start = count;
  for (float room = metrics.area; last_start > 0; --last_start) {
    room -= metrics.HeightOf(rows[static_cast<std::size_t>(last_start - 1)]);
    if (room < 0) {
      break;
    }
  }
  state.first_row = std::clamp(state.first_row - static_cast<int>(wheel * 2), 0, last_start);
  const bool moved = ui.focus.shown() != state.followed;
  state.followed = ui.focus.shown();
  const auto focused = std::find_if(
      rows.begin(), rows.end(), [&](const ListRow& row) { return ui.focus.Has(ItemName(row)); });
  if (!moved || focused == rows.end()) {
    return;
  }
  const int at = static_cast<int>(focused - rows.begin());
  state.first_row = std::min(state.first_row, at);
  while (at >= state.first_row + metrics.Fitting(rows, state.first_row) && state.first_row < at) {
    ++state.first_row;
  }
}

void DrawRow(UiFrame& ui, const Rect& box, const ListRow& row, const EngineSnapshot& snap,
             TuneState& state) {
  if (row.info == nullptr) {
    DrawHeading(ui, box, row, state);
    return;
  }
  SliderRow slider;
  slider.info = row.info;
  slider.value = GetSetting(snap.session->preview_settings, row.info->name);
  if (IsWithheld(state, ui)) {
    slider.ask = [](double) {};
  }
  slider.pending = slider.value != GetSetting(snap.session->settings, row.info->name);
  DrawSliderRow(ui, box, slider, snap.session->preview_settings, state.sliders);
}

void DrawList(UiFrame& ui, const Rect& area, const EngineSnapshot& snap, TuneState& state) {
  const Style& s = ui.style;
  const std::vector<ListRow> rows = RowsOf(snap.session->preview_settings, state);
  const ListMetrics metrics{s.Px(36), s.Px(30), area.h};
  ScrollList(ui, rows, metrics, Interact(ui, "panel/Limits", area, kPassive).wheel, state);
  const auto first = static_cast<std::size_t>(state.first_row);
  const auto shown = static_cast<std::size_t>(metrics.Fitting(rows, state.first_row));
  ui.tab.list = "limits";
  float y = area.y;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i < first || i >= first + shown) {
      OfferHidden(ui, ItemName(rows[i]));
      continue;
    }
    const Rect box{area.x, y, area.w, metrics.HeightOf(rows[i])};
    y = box.bottom();
    DrawRow(ui, box, rows[i], snap, state);
  }
  ui.tab.list = {};
  if (rows.empty()) {
    DrawText(ui, s.body, s.palette.text2, area.x + s.Px(16), area.y + s.Px(18),
             state.search[0] == '\0' ? "No limit differs from its default."
             : state.changed_only    ? "No changed limit has that name."
                                     : "No limit has that name.");
  } else if (shown < rows.size()) {
    const auto total = static_cast<float>(rows.size());
    const float tall = area.h * static_cast<float>(shown) / total;
    const float at = area.h * static_cast<float>(first) / total;
    FillRect(Canvas(), {area.right() - s.Px(5), area.y + at, s.Px(4), tall}, s.palette.line,
             s.Fine(2));
  }
}

void DrawFoot(UiFrame& ui, const Rect& foot, const EngineSnapshot& snap, TuneState& state) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  FillRect(Canvas(), {foot.x + s.Px(12), foot.y, foot.w - s.Px(24), s.Px(1)}, p.line);
  const float line = foot.y + s.Px(22);
  float x = foot.x + s.Px(12);
  x += DrawText(ui, s.body, p.text2, x, line, "Preset") + s.Px(10);
  x += DrawText(ui, s.medium, p.text1, x, line, PresetName(state)) + s.Px(16);
  const int changed = ChangedFromPreset(state.preset, snap.session->preview_settings);
  const std::string note = changed == 0   ? (state.preset.path.empty() ? "" : "as in the file")
                           : changed == 1 ? "+ 1 change, not saved"
                                          : "+ " + std::to_string(changed) + " changes, not saved";
  if (x + TextWidth(s.body, note) < foot.right() - s.Px(12)) {
    DrawText(ui, s.body, p.text2, x, line, note);
  }
  const float gap = s.Px(8), h = s.Px(32);
  const float w = std::floor((foot.w - s.Px(24) - 3 * gap) / 4);
  const float y = foot.bottom() - s.Px(12) - h;
  const struct {
    const char* name;
    const char* label;
    bool enabled;
    UiAction action;
  } buttons[] = {{"undo", "Undo", state.history.can_undo(), UndoSetting{}},
                 {"redo", "Redo", state.history.can_redo(), RedoSetting{}},
                 {"load_preset", w < s.Px(84) ? "Load" : "Load preset", true,
                  ChoosePreset{PresetChoice::kLoad}},
                 {"save_preset", w < s.Px(84) ? "Save" : "Save preset", true,
                  ChoosePreset{PresetChoice::kSave}}};
  for (int i = 0; i < 4; ++i) {
    ButtonLook look;
    look.enabled = buttons[i].enabled;
    const Rect box{foot.x + s.Px(12) + static_cast<float>(i) * (w + gap), y, w, h};
    if (DrawButton(ui, buttons[i].name, box, buttons[i].label, look)) {
      ui.intents.push_back(buttons[i].action);
    }
  }
}

}  // namespace

void DrawLimitsPanel(const EngineSnapshot& snap, const Rect& rect, TuneState& state, UiFrame& ui) {
  const Style& s = ui.style;
  if (state.preset.choice != PresetChoice::kNone) {
    DrawPresetPanel(rect, state.preset, ui);
    return;
  }
  const TuneFacts facts = FactsOf(snap);
  const Rect content = DrawPanelFrame(ui, rect, "Limits");
  const float pad = s.Px(12);
  const float chip_w = s.Px(92);
  const Rect search{content.x + pad, content.y + s.Px(8), content.w - 2 * pad - chip_w - s.Px(8),
                    s.Px(28)};
  DrawSearch(ui, search, state);
  ButtonLook look;
  look.active = state.changed_only;
  if (DrawButton(ui, "limits/changed", {search.right() + s.Px(8), search.y, chip_w, search.h},
                 std::to_string(facts.changed) + " changed", look)) {
    state.changed_only = !state.changed_only;
    state.first_row = 0;
  }
  const float foot_h = s.Px(92);
  const float top = search.bottom() + s.Px(8);
  DrawList(ui, {rect.x, top, rect.w, rect.bottom() - foot_h - top}, snap, state);
  DrawFoot(ui, {rect.x, rect.bottom() - foot_h, rect.w, foot_h}, snap, state);
}

}  // namespace palace
