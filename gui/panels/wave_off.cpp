#include "engine/model/mission/approve_offer.h"
#include "engine/model/mission/wave_off_offer.h"
#include "gui/panels/arrival.h"
#include "gui/panels/frame_bar.h"
#include "gui/panels/session_words.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr double kAnswerTime_s = 1.0;

bool JustPressed(const FrameState& state, double now_s) {
  return now_s - state.wave_off_sent_s < kAnswerTime_s;
}

/// What the vehicle said since the press, and how long ago; nothing that it said before.
std::string SecondLine(const EngineSnapshot& snap, const FrameState& state, const UiFrame& ui) {
  using Phase = WaveOffReport::Phase;
  const MissionStatus& m = snap.flight->mission;
  if (!snap.session->can_transmit) {
    return WhyNoLink(snap);
  }
  if (const std::string why = WhyNoWaveOff(snap, ui.silent_s); !why.empty()) {
    return why;
  }
  const double age_s = m.wave_off.age_s + ui.silent_s;
  switch (m.wave_off.phase) {
    case Phase::kNone:
      break;
    case Phase::kSent:
      return "Sent";
    case Phase::kUnanswered:
      return "No answer, " + AgeText(age_s);
    case Phase::kAccepted:
      return "Accepted " + AgeText(age_s) + " ago";
    case Phase::kFlies:
      return Heard("Under way", age_s);
    case Phase::kClimbs:
      return Heard("Climbing", age_s);
    case Phase::kDone:
      return Heard("Hovering", age_s);
    case Phase::kStands:
      return Heard("On the ground", age_s);
  }
  if (JustPressed(state, ui.ui_time_s)) {
    return "Sent";
  }
  if (const std::string why = WhyScreenOld(ui.silent_s); !why.empty()) {
    return why;  // nobody knows whether the vehicle is silent
  }
  const Arrival status = ArrivalOf(snap, ChannelId::kVehicleStatus, ui.silent_s);
  return status.state == ChannelHealth::State::kStale ? "Silent for " + status.age
                                                      : "One press · Shift+Esc";
}

/// Pressed, and the vehicle has not done with it.
bool IsUnderWay(const EngineSnapshot& snap, const FrameState& state, double now_s) {
  using Phase = WaveOffReport::Phase;
  const Phase phase = snap.flight->mission.wave_off.phase;
  return JustPressed(state, now_s) ||
         (phase != Phase::kNone && phase != Phase::kDone && phase != Phase::kStands);
}

}  // namespace

void DrawWaveOffPanel(const EngineSnapshot& snap, const Rect& rect, FrameState& state,
                      UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const bool enabled = snap.session->can_transmit && WhyNoWaveOff(snap, ui.silent_s).empty();
  ui.items.Add("panel/WAVE OFF", rect, true, "");
  // A popup never stands in its way; from the keyboard it has a key of its own that works anywhere.
  const Interaction in = Interact(
      ui, "wave_off", rect, kOnPress | kOverPopup | kNoTab | (enabled ? 0U : unsigned{kDisabled}));
  if (in.pressed) {
    ui.intents.push_back(CommandAction(WaveOff{}));
  }
  const std::string second = SecondLine(snap, state, ui);
  ui.items.Last("wave_off").text = "WAVE OFF | " + second;
  const bool latched = enabled && IsUnderWay(snap, state, ui.ui_time_s);
  ImU32 fill = p.wave_off;
  if (latched) {
    fill = p.white_mark;
  } else if (enabled && in.hovered) {
    fill = Mix(p.wave_off, p.white_mark, 0.08f);
  }
  ImDrawList* dl = Canvas();
  FillRect(dl, rect, fill);
  const Rect stripes{rect.x + s.Px(2), rect.y, s.Px(16), rect.h - s.Px(2)};
  Stripes(dl, stripes, enabled ? p.white_mark : p.text3, enabled ? p.on_white : p.window, s.Px(6));
  FillRect(dl, {rect.x, rect.y, s.Px(2), rect.h}, enabled ? p.white_mark : p.line);
  FillRect(dl, {rect.x, rect.bottom() - s.Px(2), rect.w, s.Px(2)}, enabled ? p.white_mark : p.line);
  const ImU32 text = latched ? p.on_white : (enabled ? p.text1 : p.text3);
  const float x = rect.x + s.Px(34);
  DrawText(ui, s.wave_off, text, x, rect.y + s.Px(28), "WAVE OFF");
  const float room = rect.right() - s.Px(8) - x;
  ImFont* font = TextWidth(s.body, second) <= room ? s.body : s.caption;
  DrawText(ui, font, text, x, rect.y + s.Px(56), FitClauses(font, second, room));
}

}  // namespace palace
