#include "gui/widgets/slider_row.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"

namespace palace {
namespace {

constexpr double kRefusalShown_s = 5;

struct Knots {
  double value[4];
  float share[4];
};

Knots KnotsOf(const SettingInfo& info) {
  const float low = info.soft_min > info.min ? 0.12f : 0.0f;
  const float high = info.soft_max < info.max ? 0.80f : 1.0f;
  return {{info.min, info.soft_min, info.soft_max, info.max}, {0.0f, low, high, 1.0f}};
}

bool IsChanged(const SliderRow& row) {
  const double step = std::pow(10.0, -row.info->decimals) / row.info->shown_per_unit;
  return std::abs(row.value - row.info->default_value) > step * 1e-3;
}

void Ask(UiFrame& ui, const SliderRow& row, double value) {
  if (row.ask) {
    row.ask(value);
  } else {
    ui.intents.push_back(CommandAction(SetSetting{row.info->name, value}));
  }
}

void StartTyping(const SliderRow& row, SliderState& state) {
  state.typing = row.info->name;
  state.focus_wanted = true;
  state.refused.clear();
  std::snprintf(state.text, sizeof state.text, "%.*f", row.info->decimals,
                row.value * row.info->shown_per_unit);
}

/// The value a drag to `share` gives: whole display steps, clamped.
double DraggedValue(const SettingInfo& info, float share) {
  const double step = std::pow(10.0, -info.decimals) / info.shown_per_unit;
  return ClampSetting(info, std::round(TrackValue(info, share) / step) * step);
}

void DrawTrack(UiFrame& ui, const Rect& track, const SliderRow& row, bool dragged) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const SettingInfo& info = *row.info;
  const bool changed = IsChanged(row);
  ImDrawList* dl = Canvas();
  const float x = track.x + TrackShare(info, row.value) * track.w;
  FillRect(dl, track, p.hover, s.Fine(1));
  const Knots knots = KnotsOf(info);
  for (const auto& [from, to] :
       {std::pair{knots.share[0], knots.share[1]}, std::pair{knots.share[2], knots.share[3]}}) {
    if (to > from) {
      Hatch(dl, {track.x + from * track.w, track.y, (to - from) * track.w, track.h}, p.unsafe,
            s.Fine(1.5f), s.Px(6));
    }
  }
  FillRect(dl, {track.x, track.y, x - track.x, track.h}, changed ? p.white_mark : p.text3,
           s.Fine(1));
  if (changed) {
    const float tick = std::round(track.x + TrackShare(info, info.default_value) * track.w);
    FillRect(dl, {tick - s.Px(1), track.centre().y - s.Px(8), s.Px(2), s.Px(16)}, p.text2);
  }
  const Rect grab{std::round(x - s.Px(5)), std::round(track.centre().y - s.Px(10)), s.Px(10),
                  s.Px(20)};
  FillRect(dl, grab, dragged || changed ? p.white_mark : p.text2, s.Fine(2));
  ui.items.Last("limit/" + info.name).rect = grab;
}

/// The value after `steps` display steps, or the next one that the setting can take that way.
double SteppedValue(const SettingInfo& info, double value, int steps) {
  constexpr int kWidestGap = 16;  // of the settings that take multiples
  const double step = std::pow(10.0, -info.decimals) / info.shown_per_unit;
  const int sign = steps > 0 ? 1 : -1;
  for (int n = std::abs(steps); n <= std::abs(steps) + kWidestGap; ++n) {
    const double wanted = std::round((value + sign * n * step) / step) * step;
    const double to = ClampSetting(info, wanted);
    if ((to - value) * sign > step * 1e-3) {
      return to;
    }
  }
  return value;
}

/// What the keyboard asks of a setting: arrows step it, Enter types, Backspace resets.
void RunSettingKeys(UiFrame& ui, const SliderRow& row, const Interaction& in, SliderState& state) {
  const SettingInfo& info = *row.info;
  if (in.step_right != 0) {
    const double value = SteppedValue(info, row.value, in.step_right);
    if (value != row.value) {
      Ask(ui, row, value);
    }
  }
  if (in.cleared && IsChanged(row)) {
    Ask(ui, row, info.default_value);
  }
  if (in.key_pressed && info.words.empty()) {
    StartTyping(row, state);
  }
}

/// Mouse and keyboard over the track. Records the item, whose rectangle becomes the grab's.
Interaction RunTrack(UiFrame& ui, const Rect& track, const SliderRow& row, SliderState& state) {
  const Style& s = ui.style;
  const SettingInfo& info = *row.info;
  const float x = track.x + TrackShare(info, row.value) * track.w;
  const Rect reach{track.x - s.Px(6), track.centre().y - s.Px(12), track.w + s.Px(12), s.Px(24)};
  const Interaction in =
      Interact(ui, "limit/" + info.name, reach,
               kSideSteps | kClears | (state.typing.empty() ? 0U : unsigned{kKeysOnly}),
               info.label + " " + FormatSetting(info, row.value));
  RunSettingKeys(ui, row, in, state);
  if (in.hovered || in.held) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  }
  if (in.pressed) {
    state.last_value = row.value;
    const bool on_grab = std::abs(in.pointer.x - x) <= s.Px(7);
    state.grab_offset_px = on_grab ? in.pointer.x - x : 0;
  }
  if (in.held) {
    const float at = in.pointer.x - state.grab_offset_px;
    const double value = DraggedValue(info, (at - track.x) / track.w);
    if (value != state.last_value && std::abs(at - x) >= 0.5f) {
      state.last_value = value;
      Ask(ui, row, value);
    }
  }
  return in;
}

void DrawWords(UiFrame& ui, const Rect& area, const SliderRow& row, SliderState& state) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const SettingInfo& info = *row.info;
  float total = 0;
  std::vector<std::string> words = info.words;
  for (std::string& word : words) {
    std::replace(word.begin(), word.end(), '_', ' ');
    total += TextWidth(s.caption, word);
  }
  const Interaction keys =
      Interact(ui, "limit/" + info.name, area, kSideSteps | kClears | kKeysOnly,
               info.label + " " + FormatSetting(info, row.value));
  RunSettingKeys(ui, row, keys, state);
  const float pad = (area.w - total) / static_cast<float>(words.size());
  float x = area.x;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Rect box{std::round(x), area.y, std::round(TextWidth(s.caption, words[i]) + pad), area.h};
    x += box.w;
    const bool on = static_cast<int>(row.value) == static_cast<int>(i);
    const Interaction in =
        Interact(ui, "limit/" + info.name + "/" + info.words[i], box, kNoTab, words[i]);
    FillRect(Canvas(), box, on ? p.white_mark : (in.hovered ? p.hover : p.window), s.Fine(3));
    StrokeRect(Canvas(), box, row.pending && on ? p.strong_line : p.line, s.Fine(1), s.Fine(3));
    DrawText(ui, s.caption, on ? p.on_white : p.text2, box.centre().x, box.centre().y, words[i],
             Align::kCentre);
    if (!on && in.clicked) {
      Ask(ui, row, static_cast<double>(i));
    }
  }
}

/// The text field while it is being typed in. True when typing ended.
bool RunTyping(UiFrame& ui, const Rect& field, const SliderRow& row, const Settings& settings,
               SliderState& state) {
  const Style& s = ui.style;
  const SettingInfo& info = *row.info;
  ImGui::SetCursorScreenPos(field.min());
  ImGui::PushID(info.name.c_str());
  ImGui::PushFont(s.medium);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      ImVec2(s.Px(6), std::max(0.0f, (field.h - s.medium->FontSize) / 2)));
  ImGui::PushStyleColor(ImGuiCol_FrameBg, s.palette.window);
  ImGui::PushStyleColor(ImGuiCol_Text, s.palette.text1);
  ImGui::SetNextItemWidth(field.w);
  if (state.focus_wanted) {
    ImGui::SetKeyboardFocusHere();
  }
  const bool entered =
      ImGui::InputText("##value", state.text, sizeof state.text,
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  const bool left = !state.focus_wanted && !ImGui::IsItemActive();
  state.focus_wanted = state.focus_wanted && !ImGui::IsItemActive();
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar();
  ImGui::PopFont();
  ImGui::PopID();
  StrokeRect(Canvas(), field, s.palette.white_mark, s.Fine(1), s.Fine(3));
  if (!entered && !left) {
    return false;
  }
  state.typing.clear();
  if (entered) {
    double value = 0;
    std::string refusal;
    if (ParseTyped(info, settings, state.text, value, refusal)) {
      Ask(ui, row, value);
    } else {
      state.refused = info.name;
      state.refusal = refusal;
      state.refused_until_s = ui.ui_time_s + kRefusalShown_s;
    }
  }
  return true;
}

bool ShowsRefusal(const UiFrame& ui, const SliderState& state, const SettingInfo& info) {
  return state.refused == info.name && ui.ui_time_s < state.refused_until_s;
}

void DrawReset(UiFrame& ui, const Rect& box, const SliderRow& row) {
  const Style& s = ui.style;
  const Interaction in = Interact(ui, "reset/" + row.info->name, box, kNoTab,
                                  "Reset to " + FormatSetting(*row.info, row.info->default_value));
  DrawIcon(Canvas(), Icon::kReset, box.centre(), s.Px(14),
           in.hovered ? s.palette.text1 : s.palette.text2);
  if (in.clicked) {
    Ask(ui, row, row.info->default_value);
  }
}

}  // namespace

float TrackShare(const SettingInfo& info, double value) {
  const Knots k = KnotsOf(info);
  const double v = std::clamp(value, info.min, info.max);
  for (int i = 0; i < 3; ++i) {
    if (v <= k.value[i + 1] || i == 2) {
      const double span = k.value[i + 1] - k.value[i];
      const double t = span > 0 ? (v - k.value[i]) / span : 0;
      return k.share[i] + static_cast<float>(t) * (k.share[i + 1] - k.share[i]);
    }
  }
  return 1;
}

double TrackValue(const SettingInfo& info, float share) {
  const Knots k = KnotsOf(info);
  const float at = std::clamp(share, 0.0f, 1.0f);
  for (int i = 0; i < 3; ++i) {
    if (at <= k.share[i + 1] && k.share[i + 1] > k.share[i]) {
      const double t = static_cast<double>((at - k.share[i]) / (k.share[i + 1] - k.share[i]));
      return k.value[i] + t * (k.value[i + 1] - k.value[i]);
    }
  }
  return info.max;
}

bool ParseTyped(const SettingInfo& info, const Settings& settings, const std::string& text,
                double& value, std::string& refusal) {
  std::string plain = text;
  std::replace(plain.begin(), plain.end(), ',', '.');
  if (const auto minus = plain.find("\u2212"); minus != std::string::npos) {
    plain.replace(minus, std::strlen("\u2212"), "-");
  }
  char* end = nullptr;
  const double shown = std::strtod(plain.c_str(), &end);
  std::string rest = end != nullptr ? end : "";
  rest.erase(std::remove(rest.begin(), rest.end(), ' '), rest.end());
  if (end == plain.c_str() || !std::isfinite(shown) || !(rest.empty() || rest == info.unit)) {
    refusal = "\"" + text + "\" is not a number";
    return false;
  }
  value = shown / info.shown_per_unit;
  if (value < info.min || value > info.max) {
    refusal = value < info.min
                  ? FormatSetting(info, value) + " refused, min " + FormatSetting(info, info.min)
                  : FormatSetting(info, value) + " refused, max " + FormatSetting(info, info.max);
    return false;
  }
  if (FindSetting(info.name) == nullptr) {
    return true;  // its range is all there is to check
  }
  Settings trial = settings;
  const Status set = SetSettingValue(trial, info.name, value);
  if (!set.ok()) {
    const std::string& why = set.error().message;
    const auto must = why.find("must be");
    refusal = FormatSetting(info, value) + " refused, " +
              (must != std::string::npos ? why.substr(must) : why);
    return false;
  }
  return true;
}

void DrawValueField(UiFrame& ui, const Rect& field, const SliderRow& row, const Settings& settings,
                    SliderState& state, FieldKeys keys) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const SettingInfo& info = *row.info;
  const std::string shown = FormatSetting(info, row.value);
  const bool own = keys == FieldKeys::kOwn;
  const bool typing = state.typing == info.name;
  const unsigned flags =
      (own ? kSideSteps | kClears : unsigned{kNoTab}) | (typing ? unsigned{kKeysOnly} : 0U);
  const Interaction in = Interact(ui, "field/" + info.name, field, flags, shown);
  if (typing && !RunTyping(ui, field, row, settings, state)) {
    return;
  }
  const bool refused = ShowsRefusal(ui, state, info);
  FillRect(Canvas(), field, p.window, s.Fine(3));
  StrokeRect(Canvas(), field, refused ? p.caution : (row.pending ? p.strong_line : p.line),
             s.Fine(1), s.Fine(3));
  DrawText(ui, s.medium, p.text1, field.right() - s.Px(8), field.centre().y, shown, Align::kRight);
  if (refused) {
    ui.items.Add("refused/" + info.name, field, true, state.refusal);
  }
  if (own) {
    RunSettingKeys(ui, row, in, state);
  }
  if (in.clicked && !in.key_pressed) {
    StartTyping(row, state);
  }
}

void DrawSliderRow(UiFrame& ui, const Rect& rect, const SliderRow& row, const Settings& settings,
                   SliderState& state) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const SettingInfo& info = *row.info;
  const bool changed = IsChanged(row);
  const float middle = rect.centre().y;
  if (changed) {
    FillRect(Canvas(), {rect.x, std::round(middle - s.Px(12)), s.Px(4), s.Px(24)}, p.white_mark);
  }
  const float up = row.note.empty() ? 0 : s.Px(8);
  DrawText(ui, changed ? s.medium : s.body, changed ? p.text1 : p.text2, rect.x + s.Px(16),
           middle - up, info.label);
  DrawText(ui, s.caption, p.text2, rect.x + s.Px(16), middle + s.Px(9), row.note);
  const bool narrow = rect.w < s.Px(380);
  const Rect field{rect.right() - s.Px(narrow ? 106 : 112), std::round(middle - s.Px(13)),
                   s.Px(narrow ? 76 : 80), s.Px(26)};
  const float track_right = field.x - s.Px(narrow ? 12 : 18);
  const float track_left = std::max(rect.x + s.Px(narrow ? 150 : 160), track_right - s.Px(120));
  const Rect track{track_left, std::round(middle - s.Px(2)), track_right - track_left, s.Px(4)};
  if (!info.words.empty()) {
    DrawWords(ui, {track.x, field.y, field.right() - track.x, field.h}, row, state);
  } else {
    const Interaction in = RunTrack(ui, track, row, state);
    if (ShowsRefusal(ui, state, info)) {
      DrawText(ui, s.caption, p.caution, track.right(), middle,
               state.refusal.substr(state.refusal.find(", ") == std::string::npos
                                        ? 0
                                        : state.refusal.find(", ") + 2),
               Align::kRight);
    } else {
      DrawTrack(ui, track, row, in.held);
    }
    DrawValueField(ui, field, row, settings, state, FieldKeys::kOfSlider);
  }
  if (changed) {
    DrawReset(ui, {rect.right() - s.Px(26), std::round(middle - s.Px(10)), s.Px(20), s.Px(20)},
              row);
  }
}

}  // namespace palace
