#include <algorithm>
#include <cmath>

#include "gui/panels/frame_bar.h"
#include "gui/widgets/button.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"

namespace palace {

namespace {

struct AlarmLook {
  Icon icon;
  ImU32 colour, fill;
  const char* word;
  const char* plural;
};

AlarmLook LookOf(const Palette& p, AlarmLevel level) {
  switch (level) {
    case AlarmLevel::kWarning:
      return {Icon::kWarning, p.warning, p.warning_fill, "WARNING", "warning"};
    case AlarmLevel::kCaution:
      return {Icon::kCaution, p.caution, p.caution_fill, "CAUTION", "caution"};
    case AlarmLevel::kAdvisory:
      break;
  }
  return {Icon::kAdvisory, p.advisory, p.advisory_fill, "ADVISORY", "advisory"};
}

bool IsSame(const ShelvedAlarm& shelved, const Alarm& alarm) {
  return alarm.active && alarm.kind == shelved.kind && alarm.level <= shelved.level &&
         alarm.since == shelved.since;
}

bool IsShelved(const FrameState& state, const Alarm& alarm) {
  return std::any_of(state.shelved.begin(), state.shelved.end(),
                     [&](const ShelvedAlarm& shelved) { return IsSame(shelved, alarm); });
}

/// What ended, worsened or was raised anew is not what was shelved.
void ForgetEnded(const std::vector<Alarm>& alarms, FrameState& state) {
  std::erase_if(state.shelved, [&](const ShelvedAlarm& shelved) {
    return std::none_of(alarms.begin(), alarms.end(),
                        [&](const Alarm& alarm) { return IsSame(shelved, alarm); });
  });
}

/// Says how many are shelved, and brings them back; returns the left edge.
float DrawShelf(FrameState& state, float right, float y, UiFrame& ui) {
  const Style& s = ui.style;
  if (state.shelved.empty()) {
    return right;
  }
  ButtonLook look;
  look.flat = true;
  const std::string words = std::to_string(state.shelved.size()) + " shelved";
  const float width = TextWidth(s.body, words) + s.Px(24);
  const Rect button{right - s.Px(12) - width, y - s.Px(12), width, s.Px(24)};
  if (DrawButton(ui, "unshelve", button, words, look)) {
    state.shelved.clear();
  }
  return button.x + s.Px(12);
}

/// "2 advisories" and the worst shape among them; drawn right-aligned. Returns the left edge.
float DrawRest(const std::vector<const Alarm*>& rest, const char* none, float right, float y,
               UiFrame& ui) {
  const Style& s = ui.style;
  std::string words;
  std::optional<AlarmLook> look;
  if (rest.empty()) {
    words = none;
  } else {
    const AlarmLevel worst = rest.front()->level;
    const auto count = std::count_if(rest.begin(), rest.end(),
                                     [&](const Alarm* alarm) { return alarm->level == worst; });
    look = LookOf(s.palette, worst);
    words = std::to_string(count) + " " +
            (count == 1 ? look->plural
                        : (worst == AlarmLevel::kAdvisory ? std::string("advisories")
                                                          : std::string(look->plural) + "s"));
    const std::size_t others = rest.size() - static_cast<std::size_t>(count);
    if (others > 0) {
      words += ", " + std::to_string(others) + " more";
    }
  }
  float x = right - s.Px(27);
  x -= DrawText(ui, s.body, s.palette.text2, x, y, words, Align::kRight);
  if (look) {
    x -= s.Px(16);
    DrawIcon(Canvas(), look->icon, {x, y}, s.Px(14), look->colour);
    x -= s.Px(6);
  }
  return x;
}

/// Acknowledge and Shelve; returns the left edge. An alarm of a recorded flight is past answering.
float DrawAnswers(const Alarm& alarm, bool of_record, FrameState& state, float right, float y,
                  UiFrame& ui) {
  const Style& s = ui.style;
  const bool advisory = alarm.level == AlarmLevel::kAdvisory;
  if (advisory || of_record) {
    return right;
  }
  ButtonLook look;
  look.flat = true;
  const Rect shelve{right - s.Px(28 + 72), y - s.Px(12), s.Px(72), s.Px(24)};
  // What is over goes by its acknowledgement; there is nothing to put aside.
  if (alarm.active && DrawButton(ui, "shelve", shelve, "Shelve", look)) {
    state.shelved.push_back({alarm.kind, alarm.level, alarm.since});
  }
  const Rect acknowledge{shelve.x - s.Px(8 + 112), shelve.y, s.Px(112), shelve.h};
  if (!alarm.acknowledged && DrawButton(ui, "acknowledge", acknowledge, "Acknowledge", look)) {
    ui.intents.push_back(CommandAction(AcknowledgeAlarm{alarm.id}));
  }
  return alarm.acknowledged ? shelve.x : acknowledge.x;
}

void DrawFirst(const Alarm& alarm, bool of_record, const Rect& rect, float text_right,
               UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const AlarmLook look = LookOf(p, alarm.level);
  const float y = rect.centre().y;
  const bool blink = alarm.level == AlarmLevel::kWarning && !alarm.acknowledged && alarm.active &&
                     std::fmod(ui.ui_time_s, 1.0) >= 0.5;
  if (!alarm.active) {
    StrokeRect(Canvas(), rect, look.colour, s.Fine(1));
  } else if (!blink) {
    FillRect(Canvas(), {rect.x, rect.y, s.Px(4), rect.h}, look.colour);
  }
  if (!blink) {
    DrawIcon(Canvas(), look.icon, {rect.x + s.Px(25), y}, s.Px(14), look.colour);
  }
  float x = rect.x + s.Px(40);
  x += DrawText(ui, s.medium, p.text1, x, y, look.word) + s.Px(10);
  std::string text = of_record ? "In the flight: " : "";
  text += (alarm.active ? "" : "Over now: ") + alarm.text;
  if (alarm.count > 1) {
    text += " ×" + std::to_string(alarm.count);
  }
  DrawText(ui, s.body, p.text1, x, y, FitWords(s.body, text, text_right - x - s.Px(16)));
}

}  // namespace

void DrawAlarmStripPanel(const EngineSnapshot& snap, const Rect& rect, FrameState& state,
                         UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  ForgetEnded(snap.flight->mission.alarms, state);
  std::vector<const Alarm*> alarms;
  for (const Alarm& alarm : snap.flight->mission.alarms) {
    if (!IsShelved(state, alarm)) {
      alarms.push_back(&alarm);
    }
  }
  const bool quiet = alarms.empty();
  const bool filled = !quiet && !alarms.front()->acknowledged && alarms.front()->active;
  FillRect(Canvas(), rect, filled ? LookOf(p, alarms.front()->level).fill : p.panel);
  ui.items.Add("panel/Alarm strip", rect, true, "");
  const float y = rect.centre().y;
  if (quiet) {
    const bool shelved = !state.shelved.empty();
    const char* words = shelved ? "No alarm but what is shelved" : "No alarms";
    DrawShelf(state, rect.right(), y, ui);
    DrawIcon(Canvas(), shelved ? Icon::kOff : Icon::kNormal, {rect.x + s.Px(25), y}, s.Px(14),
             p.text3);
    DrawText(ui, s.medium, p.text1, rect.x + s.Px(40), y, words);
    ui.items.Add("alarm", rect, true, words);
    return;
  }
  const std::vector<const Alarm*> rest(alarms.begin() + 1, alarms.end());
  const char* none =
      alarms.front()->level == AlarmLevel::kAdvisory && state.shelved.empty() ? "No cautions" : "";
  float right = DrawShelf(state, rect.right(), y, ui);
  right = DrawRest(rest, none, right, y, ui);
  const bool of_record = FollowsRecord(snap.session->role);
  right = DrawAnswers(*alarms.front(), of_record, state, right, y, ui);
  DrawFirst(*alarms.front(), of_record, rect, right, ui);
  const Rect words{rect.x, rect.y, right - rect.x, rect.h};
  if (Interact(ui, "alarm", words, 0, alarms.front()->text).clicked) {
    state.history_open = !state.history_open;
  }
}

void DrawFrameOverlay(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                      UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  if (FollowsRecord(snap.session->role)) {
    StrokeRect(Canvas(), layout.window, p.replay, s.Fine(4));
  }
  if (!state.history_open || snap.flight->mission.alarms.empty()) {
    return;
  }
  const float row = s.Px(28);
  const auto count = static_cast<float>(snap.flight->mission.alarms.size());
  const Rect list{layout.alarm_strip.x, layout.alarm_strip.bottom(), layout.alarm_strip.w,
                  std::min(row * count + s.Px(16), layout.body.h / 2)};
  BeginOverlay("##alarm_history", list);
  const bool on_list = Interact(ui, "alarm_history", list, kNoTab).hovered;
  FillRect(Canvas(), list, p.control);
  StrokeRect(Canvas(), list, p.strong_line, s.Fine(1));
  float y = list.y + s.Px(8) + row / 2;
  for (const Alarm& alarm : snap.flight->mission.alarms) {
    if (y + row / 2 > list.bottom()) {
      break;
    }
    const AlarmLook look = LookOf(p, alarm.level);
    DrawIcon(Canvas(), look.icon, {list.x + s.Px(25), y}, s.Px(12), look.colour);
    DrawText(ui, s.body, p.text1, list.x + s.Px(40), y,
             FitWords(s.body, alarm.text, list.w - s.Px(240)));
    const std::string status = IsShelved(state, alarm) ? "Shelved"
                               : alarm.acknowledged    ? "Acknowledged"
                                                       : "";
    DrawText(ui, s.caption, p.text2, list.right() - s.Px(27), y, status, Align::kRight);
    y += row;
  }
  EndOverlay();
  const bool on_strip = Interact(ui, "alarm", layout.alarm_strip, kPassive).hovered;
  if (ImGui::IsMouseClicked(0) && !on_list && !on_strip) {
    state.history_open = false;
  }
}

}  // namespace palace
