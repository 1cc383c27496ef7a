// The list below the alarm strip: what stands, what is over and waits, in whole sentences.
#include <algorithm>

#include "engine/model/mission/alarm_text.h"
#include "gui/panels/alarm_look.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"

namespace palace {
namespace {

constexpr float kRow = 28, kLine = 20;
constexpr float kAnswers = 132;  ///< for the button, or what was answered

struct AlarmRow {
  const Alarm* alarm = nullptr;
  bool gone = false;
  std::vector<std::string> lines;
  float height = 0;
};

/// While the list is open a row keeps its place: what comes is added below, and what is gone stays
/// as it was told last, past answering. A button that moved would be pressed for another.
void Follow(const std::vector<Alarm>& alarms, std::vector<ListedAlarm>& listed) {
  for (ListedAlarm& row : listed) {
    row.gone = true;
    row.alarm.active = false;
  }
  for (const Alarm& alarm : alarms) {
    const auto row = std::find_if(listed.begin(), listed.end(),
                                  [&](const ListedAlarm& old) { return old.alarm.id == alarm.id; });
    if (row == listed.end()) {
      listed.push_back({alarm});
    } else {
      *row = {alarm};
    }
  }
}

bool WaitsForAnswer(const AlarmRow& row) { return !row.gone && WaitsForAnswer(*row.alarm); }

std::vector<AlarmRow> RowsOf(const std::vector<ListedAlarm>& listed, bool of_record, float width,
                             const Style& s) {
  std::vector<AlarmRow> rows;
  for (const auto& [alarm, gone] : listed) {
    AlarmRow row{&alarm, gone, WrapText(s.body, AlarmWords(alarm, of_record), width), 0};
    row.height = s.Px(kRow) + s.Px(kLine) * static_cast<float>(row.lines.size() - 1);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Ids of those among the first `shown`, in full to be read, that are over and wait for an answer.
std::vector<std::string> OverAndWaiting(const std::vector<AlarmRow>& rows, std::size_t shown) {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < shown; ++i) {
    if (!rows[i].alarm->active && WaitsForAnswer(rows[i])) {
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
  if (!of_record && WaitsForAnswer(row)) {
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

/// The head never moves: how many stand, what has no room, and one answer for all that are over.
void DrawHead(const EngineSnapshot& snap, const std::vector<AlarmRow>& rows, std::size_t shown,
              const Rect& head, UiFrame& ui) {
  const Style& s = ui.style;
  const float y = head.centre().y;
  const std::vector<Alarm>& alarms = snap.flight->mission.alarms;
  std::string words = alarms.empty() ? "No alarms" : AlarmCountWords(alarms);
  if (shown < rows.size()) {
    words += "; " + std::to_string(rows.size() - shown) + " more below these, on Diagnose";
  }
  DrawText(ui, s.medium, s.palette.text1, head.x + s.Px(40), y, words);
  const std::vector<std::string> over = OverAndWaiting(rows, shown);
  if (over.size() < 2 || FollowsRecord(snap.session->role)) {
    return;
  }
  const std::string all = "Acknowledge the " + std::to_string(over.size()) + " that are over";
  const float width = TextWidth(s.body, all) + s.Px(24);
  const Rect button{head.right() - s.Px(27) - width, y - s.Px(12), width, s.Px(24)};
  if (DrawButton(ui, "acknowledge_over", button, all)) {
    for (const std::string& id : over) {
      ui.intents.push_back(CommandAction(AcknowledgeAlarm{id}));
    }
  }
}

}  // namespace

void DrawAlarmList(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                   UiFrame& ui) {
  if (!state.history_open) {
    state.listed.clear();
    return;
  }
  Follow(snap.flight->mission.alarms, state.listed);
  const Style& s = ui.style;
  const Rect& strip = layout.alarm_strip;
  const bool of_record = FollowsRecord(snap.session->role);
  const std::vector<AlarmRow> rows =
      RowsOf(state.listed, of_record, strip.w - s.Px(40 + 27 + kAnswers), s);
  const float most = layout.body.h * 0.6f;
  float height = s.Px(kRow + 16);
  std::size_t shown = 0;
  for (; shown < rows.size() && height + rows[shown].height <= most; ++shown) {
    height += rows[shown].height;
  }
  const Rect list{strip.x, strip.bottom(), strip.w, height};
  BeginOverlay("##alarm_history", list);
  ui.items.Add("panel/Alarm list", list, true, "");
  FillRect(Canvas(), list, s.palette.control);
  StrokeRect(Canvas(), list, s.palette.strong_line, s.Fine(1));
  const Rect head{list.x, list.y + s.Px(8), list.w, s.Px(kRow)};
  DrawHead(snap, rows, shown, head, ui);
  float y = head.bottom();
  for (std::size_t i = 0; i < shown; ++i) {
    const Rect rect{list.x, y, list.w, rows[i].height};
    DrawRow(rows[i], of_record, state, rect, ui);
    y = rect.bottom();
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
