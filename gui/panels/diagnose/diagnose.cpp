#include "gui/panels/diagnose/diagnose.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "engine/model/channel_age.h"
#include "engine/model/mission/approve_offer.h"
#include "gui/widgets/button.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

const char* KindWord(EventKind kind) {
  switch (kind) {
    case EventKind::kState:
      return "State";
    case EventKind::kSite:
      return "Site";
    case EventKind::kDecision:
      return "Decision";
    case EventKind::kSetting:
      return "Limit";
    case EventKind::kAlarm:
      return "Alarm";
    case EventKind::kBookmark:
      return "Bookmark";
    case EventKind::kVehicle:
      return "Vehicle";
    case EventKind::kFault:
      return "Fault";
  }
  return "";
}

void DrawEvents(const EngineSnapshot& snap, const Rect& rect, DiagnoseState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const int count = snap.session->events ? static_cast<int>(snap.session->events->size()) : 0;
  const Rect content =
      DrawPanelFrame(ui, rect, "Events", {{Fixed(count, 0) + ", newest first", 0, false, false}});
  if (count == 0) {
    DrawText(ui, s.body, p.text2, content.x + s.Px(12), content.y + s.Px(14),
             "Nothing has happened yet.");
    return;
  }
  const float row_h = s.Px(26);
  const int rows = static_cast<int>((rect.bottom() - content.y - s.Px(4)) / row_h);
  const Interaction in = Interact(ui, "events", content, kAllSteps);
  state.event_offset -= static_cast<int>(in.wheel * 3) + in.step_up;
  state.event_offset = std::clamp(state.event_offset, 0, std::max(0, count - rows));
  for (int i = 0; i < rows && i + state.event_offset < count; ++i) {
    const Event& event =
        (*snap.session->events)[static_cast<std::size_t>(count - 1 - i - state.event_offset)];
    const float y = content.y + row_h * (static_cast<float>(i) + 0.5f);
    float x = content.x + s.Px(12);
    x += DrawText(ui, s.mono, p.text2, x, y, ClockText(event.time)) + s.Px(14);
    DrawText(ui, s.caption, p.text3, x, y, KindWord(event.kind));
    x += s.Px(66);
    const float room = rect.right() - s.Px(12) - x;
    DrawText(ui, s.body, event.kind == EventKind::kAlarm ? p.text1 : p.text2, x, y,
             FitWords(s.body, event.text, room));
    const bool cut = TextWidth(s.body, event.text) > room;
    if (cut && in.hovered && std::abs(in.pointer.y - y) < row_h / 2) {
      DrawTooltip(ui, event.text);
    }
  }
}

Icon IconOf(ChannelHealth::State state) {
  switch (state) {
    case ChannelHealth::State::kFresh:
      return Icon::kNormal;
    case ChannelHealth::State::kNever:
      return Icon::kOff;
    default:
      return Icon::kStale;
  }
}

void DrawChannels(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect content =
      DrawPanelFrame(ui, rect, "Channels", {{WhyScreenOld(ui.silent_s), 0, false, true}});
  const bool wide = rect.w > s.Px(500);
  const char* heads[] = {"Age", "Rate", "Expected", "Lost", "Note"};
  const int columns = wide ? 5 : 3;
  const float left = content.x + s.Px(156);
  const float step = (content.right() - s.Px(12) - left) / static_cast<float>(columns);
  const auto column = [&](int i) { return left + step * static_cast<float>(i + 1); };
  float y = content.y + s.Px(12);
  DrawText(ui, s.caption, p.text2, content.x + s.Px(34), y, "Channel");
  for (int i = 0; i < columns; ++i) {
    DrawText(ui, s.caption, p.text2, column(i), y, heads[i], Align::kRight);
  }
  y += s.Px(22);
  const float pitch =
      RowPitch(s, rect.bottom() - s.Px(6) - y + s.Px(13), snap.sensors->channels.size());
  if (snap.sensors->channels.empty()) {
    DrawText(ui, s.body, p.text2, content.x + s.Px(12), y, "Nothing has arrived yet.");
  }
  for (const ChannelHealth& published : snap.sensors->channels) {
    const ChannelHealth c = After(published, ui.silent_s);
    if (y + s.Px(10) > rect.bottom()) {
      break;
    }
    const bool fresh = c.state == ChannelHealth::State::kFresh;
    const bool late = c.state == ChannelHealth::State::kLate;
    DrawIcon(Canvas(), IconOf(c.state), {content.x + s.Px(20), y}, s.Px(12),
             fresh ? p.text3 : (late ? p.caution : p.text1));
    DrawText(ui, fresh ? s.body : s.medium, fresh ? p.text2 : p.text1, content.x + s.Px(34), y,
             ChannelName(c.id));
    const std::string cells[] = {AgeText(c.age_s), Fixed(c.rate_hz, 1) + " Hz",
                                 Fixed(c.expected_hz, 0) + " Hz",
                                 Fixed(static_cast<double>(c.lost), 0), c.note};
    for (int i = 0; i < columns; ++i) {
      DrawText(ui, s.body, p.text1, column(i), y, cells[i], Align::kRight);
    }
    const std::string name = ChannelName(c.id);
    ui.items.Add("channel/" + name, {content.x, y - s.Px(10), content.w, s.Px(20)}, true,
                 name + " " + cells[0]);
    y += pitch;
  }
}

void DrawTimings(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  double total_ms = 0, longest_ms = 1;
  for (const StageTiming& t : snap.session->timings) {
    total_ms += t.milliseconds;
    longest_ms = std::max(longest_ms, t.milliseconds);
  }
  const Rect content =
      DrawPanelFrame(ui, rect, "Stages", {{Fixed(total_ms, 1) + " ms a frame", 0, false, false}});
  float y = content.y + s.Px(10);
  const float pitch =
      RowPitch(s, rect.bottom() - s.Px(6) - y + s.Px(13), snap.session->timings.size());
  for (const StageTiming& t : snap.session->timings) {
    if (y + s.Px(10) > rect.bottom()) {
      break;
    }
    DrawText(ui, s.body, p.text2, content.x + s.Px(12), y, t.stage);
    const Rect bar{content.x + s.Px(150), std::round(y - s.Px(4)), content.w - s.Px(250), s.Px(8)};
    FillRect(Canvas(), bar, p.hover, s.Fine(1));
    FillRect(Canvas(),
             {bar.x, bar.y, bar.w * static_cast<float>(t.milliseconds / longest_ms), bar.h}, p.bar,
             s.Fine(1));
    DrawText(ui, s.medium, p.text1, content.right() - s.Px(12), y, Fixed(t.milliseconds, 1) + " ms",
             Align::kRight);
    y += pitch;
  }
}

void DrawNotes(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect content = DrawPanelFrame(ui, rect, "Diagnostics of this frame");
  float y = content.y + s.Px(12);
  if (snap.session->diagnostics.empty()) {
    DrawText(ui, s.body, p.text2, content.x + s.Px(12), y, "Every stage did its work.");
    return;
  }
  for (const Diagnostic& d : snap.session->diagnostics) {
    const ImU32 colour = d.level == DiagnosticLevel::kError     ? p.warning
                         : d.level == DiagnosticLevel::kWarning ? p.caution
                                                                : p.advisory;
    const Icon icon = d.level == DiagnosticLevel::kError     ? Icon::kWarning
                      : d.level == DiagnosticLevel::kWarning ? Icon::kCaution
                                                             : Icon::kAdvisory;
    const std::string text = d.stage + ": " + d.message;
    bool first = true;
    for (const std::string& line : WrapText(s.body, text, content.w - s.Px(46))) {
      if (y + s.Px(10) > rect.bottom()) {
        return;
      }
      if (first) {
        DrawIcon(Canvas(), icon, {content.x + s.Px(20), y}, s.Px(12), colour);
        first = false;
      }
      DrawText(ui, s.body, p.text1, content.x + s.Px(34), y, line);
      y += s.Px(20);
    }
    y += s.Px(4);
  }
}

std::string Hex(std::uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

void DrawHashes(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect content = DrawPanelFrame(ui, rect, "Hashes");
  const struct {
    const char* name;
    std::string value;
  } rows[] = {{"Limits in force", Hex(snap.session->settings_hash)},
              {"Limits previewed", Hex(snap.session->preview_hash)},
              {"Newest map", snap.terrain->applied ? Hex(snap.terrain->applied->map_hash) : "––"},
              {"Decision", Hex(snap.decision_hash)},
              {"Snapshot", Fixed(static_cast<double>(snap.sequence), 0)}};
  float y = content.y + s.Px(10);
  const float pitch = RowPitch(s, rect.bottom() - s.Px(6) - y + s.Px(13), std::size(rows));
  for (const auto& row : rows) {
    if (y + s.Px(10) > rect.bottom()) {
      break;
    }
    DrawText(ui, s.body, p.text2, content.x + s.Px(12), y, row.name);
    DrawText(ui, s.mono, p.text1, content.right() - s.Px(12), y, row.value, Align::kRight);
    y += pitch;
  }
}

}  // namespace

float RowPitch(const Style& s, float height, std::size_t rows) {
  const float fits = height / static_cast<float>(std::max<std::size_t>(rows, 1));
  return std::clamp(std::floor(fits), s.Px(19), s.Px(26));
}

void DrawDiagnoseWorkspace(const EngineSnapshot& snap, const Rect& body, DiagnoseState& state,
                           UiFrame& ui) {
  const Style& s = ui.style;
  const float gap = s.Px(8);
  // Three columns: what happened, what was decided from what, what the machine did.
  const float left = std::floor((body.w - 2 * gap) * 0.32f);
  const float middle = std::floor((body.w - 2 * gap) * 0.36f);
  const float health_h = std::min(s.Px(262), std::round(body.h * 0.4f));
  const float losses_h = LossesHeight(snap, s, std::round(body.h * 0.25f));
  const float losses_y = body.bottom() - health_h - gap - losses_h;
  DrawEvents(snap, {body.x, body.y, left, losses_y - gap - body.y}, state, ui);
  DrawLosses(snap, {body.x, losses_y, left, losses_h}, ui);
  DrawStereoHealth(snap, {body.x, body.bottom() - health_h, left, health_h}, ui);
  const float x = body.x + left + gap;
  const auto rows_h = [&](std::size_t rows, float head) {
    return s.Px(head + 26 * static_cast<float>(std::max<std::size_t>(rows, 1)));
  };
  const std::size_t sites =
      snap.terrain->applied ? snap.terrain->applied->selection.sites.size() : 0;
  const float sites_h = std::min(rows_h(sites, 66), std::round(body.h * 0.36f));
  // Guards and sites as tall as they need; what is left lists the alarms.
  const float guards_h =
      std::min(rows_h(std::max(snap.flight->mission.guards.size(), kGuardCount), 40),
               body.h - sites_h - gap);
  const float alarms_y = body.y + guards_h + gap + sites_h + gap;
  const bool alarms = body.bottom() - alarms_y > s.Px(80);
  const float sites_y = alarms ? body.y + guards_h + gap : body.bottom() - sites_h;
  DrawGuards(snap, {x, body.y, middle, sites_y - gap - body.y}, ui);
  DrawSiteTable(snap, {x, sites_y, middle, sites_h}, ui);
  if (alarms) {
    DrawAlarmTable(snap, {x, alarms_y, middle, body.bottom() - alarms_y}, ui);
  }
  const float right_x = x + middle + gap, right = body.right() - right_x;
  const auto share = [&](float wanted, float most) {
    return std::min(s.Px(wanted), std::round(body.h * most));
  };
  const bool cameras = !snap.session->source.cameras.empty();
  const bool bus = !snap.session->losses.bus.channels.empty();
  const float channels_h = share(
      62 + 26 * static_cast<float>(std::max<std::size_t>(snap.sensors->channels.size(), 1)), 0.38f);
  const float stages_h =
      share(40 + 26 * static_cast<float>(std::max<std::size_t>(snap.session->timings.size(), 1)),
            bus ? 0.17f : 0.23f);
  // In a low window the counters of cameras or bus take the place of the hashes.
  const bool hashes = (!cameras && !bus) || body.h > s.Px(bus ? 1000 : 760);
  const float hashes_h = share(170, cameras ? 0.18f : 0.23f);
  float y = body.y;
  DrawChannels(snap, {right_x, y, right, channels_h}, ui);
  y += channels_h + gap;
  if (cameras) {
    const float cameras_h =
        share(62 + 26 * static_cast<float>(snap.session->source.cameras.size()), 0.18f);
    DrawCameraTable(snap, {right_x, y, right, cameras_h}, ui);
    y += cameras_h + gap;
  }
  if (bus) {
    const float bus_h = BusTableHeight(snap, s, std::round(body.h * 0.28f));
    DrawBusTable(snap, {right_x, y, right, bus_h}, ui);
    y += bus_h + gap;
  }
  DrawTimings(snap, {right_x, y, right, stages_h}, ui);
  y += stages_h + gap;
  if (hashes) {
    DrawHashes(snap, {right_x, y, right, hashes_h}, ui);
    y += hashes_h + gap;
  }
  DrawNotes(snap, {right_x, y, right, body.bottom() - y}, ui);
}

}  // namespace palace
