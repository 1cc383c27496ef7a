// The list below the alarm strip: what stands, what is over and waits, in whole sentences.
#include <algorithm>

#include "gui/panels/alarm_look.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"

namespace palace {
namespace {

constexpr float kRow = 28, kLine = 20;
constexpr float kAnswers = 132;  ///< for the button, or what was answered

struct AlarmRow {
  const Alarm* alarm = nullptr;
  std::vector<std::string> lines;
  float height = 0;
};

std::vector<AlarmRow> RowsOf(const EngineSnapshot& snap, float width, const Style& s) {
  std::vector<AlarmRow> rows;
  const bool of_record = FollowsRecord(snap.session->role);
  for (const Alarm& alarm : snap.flight->mission.alarms) {
    AlarmRow row{&alarm, WrapText(s.body, AlarmWords(alarm, of_record), width), 0};
    row.height = s.Px(kRow) + s.Px(kLine) * static_cast<float>(row.lines.size() - 1);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Ids of those among the first `shown`, in full to be read, that are over and wait for an answer.
std::vector<std::string> OverAndWaiting(const std::vector<AlarmRow>& rows, std::size_t shown) {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < shown; ++i) {
    if (!rows[i].alarm->active && WaitsForAnswer(*rows[i].alarm)) {
      ids.push_back(rows[i].alarm->id);
    }
  }
  return ids;
}

void DrawRow(const AlarmRow& row, bool of_record, const FrameState& state, const Rect& rect,
             UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Alarm& alarm = *row.alarm;
  const AlarmLook look = LookOf(p, alarm.level);
  float y = rect.y + s.Px(kRow / 2);
  DrawIcon(Canvas(), look.icon, {rect.x + s.Px(25), y}, s.Px(12), look.colour);
  if (!of_record && WaitsForAnswer(alarm)) {
    const Rect button{rect.right() - s.Px(27 + 112), y - s.Px(12), s.Px(112), s.Px(24)};
    if (DrawButton(ui, "acknowledge/" + alarm.id, button, "Acknowledge")) {
      ui.intents.push_back(CommandAction(AcknowledgeAlarm{alarm.id}));
    }
  } else {
    const char* status = IsShelved(state, alarm) ? "Shelved"
                         : alarm.acknowledged    ? "Acknowledged"
                                                 : "";
    DrawText(ui, s.caption, p.text2, rect.right() - s.Px(27), y, status, Align::kRight);
  }
  for (const std::string& line : row.lines) {
    DrawText(ui, s.body, p.text1, rect.x + s.Px(40), y, line);
    y += s.Px(kLine);
  }
}

}  // namespace

void DrawAlarmList(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                   UiFrame& ui) {
  if (!state.history_open || snap.flight->mission.alarms.empty()) {
    return;
  }
  const Style& s = ui.style;
  const Rect& strip = layout.alarm_strip;
  const std::vector<AlarmRow> rows = RowsOf(snap, strip.w - s.Px(40 + 27 + kAnswers), s);
  const float most = layout.body.h * 0.6f;
  float height = s.Px(16);
  std::size_t shown = 0;
  for (; shown < rows.size() && height + rows[shown].height <= most; ++shown) {
    height += rows[shown].height;
  }
  const bool more = shown < rows.size();
  const std::vector<std::string> over = OverAndWaiting(rows, shown);
  const bool together = over.size() > 1 && !FollowsRecord(snap.session->role);
  const Rect list{strip.x, strip.bottom(), strip.w, height + (more || together ? s.Px(kRow) : 0)};
  BeginOverlay("##alarm_history", list);
  ui.items.Add("panel/Alarm list", list, true, "");
  FillRect(Canvas(), list, s.palette.control);
  StrokeRect(Canvas(), list, s.palette.strong_line, s.Fine(1));
  float y = list.y + s.Px(8);
  for (std::size_t i = 0; i < shown; ++i) {
    const Rect rect{list.x, y, list.w, rows[i].height};
    DrawRow(rows[i], FollowsRecord(snap.session->role), state, rect, ui);
    y = rect.bottom();
  }
  if (more) {
    DrawText(ui, s.body, s.palette.text2, list.x + s.Px(40), y + s.Px(kRow / 2),
             "And " + std::to_string(rows.size() - shown) + " more alarms, on Diagnose");
  }
  if (together) {
    const std::string words = "Acknowledge the " + std::to_string(over.size()) + " that are over";
    const float width = TextWidth(s.body, words) + s.Px(24);
    const Rect button{list.right() - s.Px(27) - width, y + s.Px(2), width, s.Px(24)};
    if (DrawButton(ui, "acknowledge_over", button, words)) {
      for (const std::string& id : over) {
        ui.intents.push_back(CommandAction(AcknowledgeAlarm{id}));
      }
    }
  }
  const bool on_list = Interact(ui, "alarm_history", list, kPassive).hovered;
  Interact(ui, "alarm_history", list, kNoTab);  // nothing below it is clicked
  EndOverlay();
  const bool on_strip = Interact(ui, "alarm", strip, kPassive).hovered;
  if (ImGui::IsMouseClicked(0) && !on_list && !on_strip) {
    state.history_open = false;
  }
}

}  // namespace palace
