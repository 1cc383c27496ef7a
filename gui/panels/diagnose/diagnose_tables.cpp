// Tables of Diagnose: the guards of approval, and the candidate sites.
#include <cmath>

#include "engine/core/units.h"
#include "engine/model/cell_explanation.h"
#include "engine/model/mission/alarm_text.h"
#include "engine/model/size_words.h"
#include "gui/panels/alarm_look.h"
#include "gui/panels/diagnose/diagnose.h"
#include "gui/panels/session_words.h"
#include "gui/panels/terrain_views.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

/// Most guards ask of the selected site: without one they neither pass nor fail.
bool IsAsked(const GuardResult& guard, const MissionStatus& mission) {
  return mission.armed || guard.pass || guard.reason != "Select a site first";
}

}  // namespace

void DrawGuards(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const std::vector<GuardResult>& guards = snap.flight->mission.guards;
  std::size_t passing = 0;
  for (const GuardResult& guard : guards) {
    passing += guard.pass ? 1 : 0;
  }
  const std::string fact =
      guards.empty() ? std::string("no site selected")
                     : std::to_string(passing) + " of " + std::to_string(guards.size()) + " pass";
  const Rect content = DrawPanelFrame(ui, rect, "Guards of approval", {{fact, 0, false, false}});
  float y = content.y + s.Px(14);
  if (guards.empty()) {
    DrawText(ui, s.body, p.text2, content.x + s.Px(12), y,
             FitWords(s.body, "Select a site: its guards are checked at every frame.",
                      content.w - s.Px(24)));
    return;
  }
  const float name_x = content.x + s.Px(74);
  const float pitch = RowPitch(s, rect.bottom() - s.Px(4) - content.y, guards.size());
  for (const GuardResult& guard : guards) {
    if (y + s.Px(10) > rect.bottom()) {
      return;
    }
    const bool asked = IsAsked(guard, snap.flight->mission);
    const bool fails = asked && !guard.pass;
    DrawIcon(Canvas(),
             fails   ? Icon::kFails
             : asked ? Icon::kDone
                     : Icon::kOff,
             {content.x + s.Px(20), y}, s.Px(12), fails ? p.text1 : p.text2);
    DrawText(ui, s.caption, p.text3, content.x + s.Px(36), y, GuardName(guard.id));
    const float width =
        DrawText(ui, fails ? s.medium : s.body, fails ? p.text1 : p.text2, name_x, y, guard.name);
    ui.items.Add(std::string("guard/") + GuardName(guard.id),
                 {content.x, y - pitch / 2, content.w, pitch}, guard.pass,
                 guard.name + (guard.pass ? " passes"
                               : asked    ? " fails: " + guard.reason
                                          : ": " + guard.reason));
    const std::string words = guard.pass ? std::string("Passes") : guard.reason;
    const float room = content.right() - s.Px(12) - name_x - width - s.Px(16);
    if (TextWidth(s.body, words) <= room) {
      DrawText(ui, s.body, fails ? p.text1 : p.text3, content.right() - s.Px(12), y, words,
               Align::kRight);
      y += pitch;
      continue;
    }
    // A long reason has lines of its own.
    y += s.Px(20);
    for (const std::string& line :
         WrapText(s.caption, words, content.right() - s.Px(12) - name_x)) {
      if (y + s.Px(10) > rect.bottom()) {
        return;
      }
      DrawText(ui, s.caption, p.text1, name_x, y, line);
      y += s.Px(18);
    }
    y += s.Px(6);
  }
}

void DrawAlarmTable(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const std::vector<Alarm>& alarms = snap.flight->mission.alarms;
  const Rect content = DrawPanelFrame(ui, rect, "Alarms", {{AlarmCountWords(alarms)}});
  float y = content.y + s.Px(12);
  if (alarms.empty()) {
    DrawText(ui, s.body, p.text2, content.x + s.Px(12), y,
             "No alarm stands or waits for an answer.");
  }
  for (const Alarm& alarm : alarms) {
    if (y + s.Px(10) > rect.bottom()) {
      return;
    }
    const bool warning = alarm.level == AlarmLevel::kWarning;
    const bool caution = alarm.level == AlarmLevel::kCaution;
    DrawIcon(Canvas(),
             warning   ? Icon::kWarning
             : caution ? Icon::kCaution
                       : Icon::kAdvisory,
             {content.x + s.Px(20), y}, s.Px(12),
             warning   ? p.warning
             : caution ? p.caution
                       : p.advisory);
    const float x = content.x + s.Px(36);
    const float time_w = DrawText(ui, s.mono, p.text2, x, y, ClockText(alarm.since)) + s.Px(14);
    const std::string state = !alarm.active        ? "Cleared"
                              : alarm.acknowledged ? "Acknowledged"
                                                   : "Stands";
    const float right = content.right() - s.Px(12);
    const float state_w = DrawText(ui, s.caption, p.text2, right, y, state, Align::kRight);
    for (const std::string& line :
         WrapText(s.body, AlarmWords(alarm, FollowsRecord(snap.session->role)),
                  right - state_w - s.Px(12) - x - time_w)) {
      if (y + s.Px(10) > rect.bottom()) {
        return;
      }
      DrawText(ui, s.body, p.text1, x + time_w, y, line);
      y += s.Px(20);
    }
    y += s.Px(6);
  }
}

void DrawCameraTable(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect content = DrawPanelFrame(ui, rect, "Cameras");
  const char* heads[] = {"Rate", "Unpaired", "Dropped", "Reopened", "Pictures"};
  const int columns = rect.w > s.Px(500) ? 5 : 4;
  const float left = content.x + s.Px(120);
  const float step = (content.right() - s.Px(12) - left) / static_cast<float>(columns);
  const auto column = [&](int i) { return left + step * static_cast<float>(i + 1); };
  float y = content.y + s.Px(12);
  DrawText(ui, s.caption, p.text2, content.x + s.Px(34), y, "Camera");
  for (int i = 0; i < columns; ++i) {
    DrawText(ui, s.caption, p.text2, column(i), y, heads[i], Align::kRight);
  }
  y += s.Px(22);
  const auto count = [](std::uint64_t n) { return Fixed(static_cast<double>(n), 0); };
  for (const CameraCounters& camera : snap.session->source.cameras) {
    if (y + s.Px(10) > rect.bottom()) {
      return;
    }
    const bool fine = camera.problem.empty();
    DrawIcon(Canvas(), fine ? Icon::kNormal : Icon::kStale, {content.x + s.Px(20), y}, s.Px(12),
             fine ? p.text3 : p.caution);
    DrawText(ui, fine ? s.body : s.medium, fine ? p.text2 : p.text1, content.x + s.Px(34), y,
             camera.name);
    const std::string cells[] = {Fixed(camera.rate_hz, 1) + " Hz", count(camera.unpaired),
                                 count(camera.device_dropped), count(camera.reopens),
                                 count(camera.frames)};
    for (int i = 0; i < columns; ++i) {
      DrawText(ui, s.body, p.text1, column(i), y, cells[i], Align::kRight);
    }
    ui.items.Add("camera/" + camera.name.substr(camera.name.rfind(' ') + 1),
                 {content.x, y - s.Px(10), content.w, s.Px(20)}, true,
                 camera.name + ", unpaired " + cells[1] + ", dropped " + cells[2] + ", reopened " +
                     cells[3] + ", pictures " + cells[4] +
                     (fine ? std::string() : ", " + camera.problem));
    y += s.Px(26);
  }
}

void DrawSiteTable(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const auto& armed_site = snap.flight->mission.armed;
  const std::string landing =
      armed_site ? std::string(LandingWord(snap.flight->mission)) + " " + armed_site->letter
                 : std::string();
  const Rect content = DrawPanelFrame(
      ui, rect, "Sites of the newest map",
      {{landing, 0, true, false},
       {snap.terrain->applied
            ? AgeText(SecondsBetween(snap.terrain->applied->map_time, snap.time) + ui.silent_s) +
                  " old"
            : "",
        0, false, false}});
  float y = content.y + s.Px(12);
  if (!snap.terrain->applied || snap.terrain->applied->selection.sites.empty()) {
    DrawText(ui, s.body, p.text2, content.x + s.Px(12), y,
             snap.terrain->applied ? std::string("No cell is far enough from every hazard.")
                                   : NoMapWords(snap) + ".");
    return;
  }
  const char* heads[] = {"Clear", "Slope", "Rough", "Probability", "North", "East"};
  const int columns = rect.w > s.Px(520) ? 6 : 4;
  const float left = content.x + s.Px(40);
  const float step = (content.right() - s.Px(12) - left) / static_cast<float>(columns);
  for (int i = 0; i < columns; ++i) {
    DrawText(ui, s.caption, p.text2, left + step * static_cast<float>(i + 1), y, heads[i],
             Align::kRight);
  }
  y += s.Px(25);
  for (const LandingSite& site : snap.terrain->applied->selection.sites) {
    if (y + s.Px(10) > rect.bottom()) {
      return;
    }
    const bool armed = snap.flight->mission.armed && snap.flight->mission.armed->id == site.id;
    LetterPlate(ui, {content.x + s.Px(22), y}, site.letter, armed);
    const std::string cells[] = {Fixed(site.safe_distance_m, 1) + " m",
                                 SizeWords(site.slope_rad, kDegPerRad, "°", 1),
                                 SizeWords(site.roughness_m, 100, " cm", 1),
                                 Fixed(site.safe_probability, 3),
                                 Fixed(site.p_WS.x(), 1) + " m",
                                 Fixed(site.p_WS.y(), 1) + " m"};
    for (int i = 0; i < columns; ++i) {
      DrawText(ui, s.body, p.text1, left + step * static_cast<float>(i + 1), y, cells[i],
               Align::kRight);
    }
    y += s.Px(26);
  }
}

}  // namespace palace
