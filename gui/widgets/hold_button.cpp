#include "gui/widgets/hold_button.h"

#include <algorithm>

#include "gui/widgets/button.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr double kReleaseMessage_s = 3.0;

struct Words {
  std::string title;
  std::string second;
};

/// `down`: a press that lasts from before it could begin a hold, or after it ended one.
Words WordsOf(const HoldButtonView& view, const HoldState& state, bool down, double now_s) {
  switch (view.phase) {
    case HoldPhase::kBlocked:
    case HoldPhase::kNoVehicle:
      return {"Cannot approve", view.reason};
    case HoldPhase::kRequested:
      return {view.label, view.reason};
    case HoldPhase::kAccepted:
      return {view.label, view.reason};
    case HoldPhase::kRefused:
      return {"Vehicle refused", view.reason};
    case HoldPhase::kReady:
      break;
  }
  const std::string full = Fixed(view.duration_s, 1) + " s";
  if (state.holding) {
    const double left = std::max(0.0, view.duration_s - HeldSeconds(state, now_s));
    return {"Keep holding", Fixed(left, 1) + " s left"};
  }
  if (down) {
    return {view.label, "Release first, then hold"};
  }
  if (now_s - state.released_at_s < kReleaseMessage_s) {
    return {view.label,
            "Released at " + Fixed(state.released_after_s, 1) + " s. Hold the full " + full + "."};
  }
  return {view.label, view.reason.empty() ? full + " · mouse or Enter" : view.reason};
}

void DrawBody(UiFrame& ui, const Rect& rect, const HoldButtonView& view, float progress) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  ImDrawList* dl = Canvas();
  ImU32 fill = p.control;
  ImU32 border = p.strong_line;
  switch (view.phase) {
    case HoldPhase::kReady:
      fill = p.go;
      border = p.safe;
      break;
    case HoldPhase::kNoVehicle:
      fill = p.panel;
      border = p.line;
      break;
    case HoldPhase::kRefused:
      fill = p.caution_fill;
      border = p.caution;
      break;
    case HoldPhase::kRequested:
    case HoldPhase::kAccepted:
      border = p.safe;
      break;
    case HoldPhase::kBlocked:
      break;
  }
  FillRect(dl, rect, fill, s.Fine(4));
  if (progress > 0) {
    const float width = rect.w * progress;
    FillRect(dl, {rect.x, rect.y, width, rect.h}, p.bar, s.Fine(4));
    FillRect(dl, {rect.x + width - s.Px(2), rect.y, s.Px(2), rect.h}, picture::kWhite);
  }
  if (view.phase == HoldPhase::kRequested) {
    DashedRect(dl, rect, border, s.Fine(2), s.Fine(8), s.Fine(5));
  } else {
    StrokeRect(dl, rect, border, s.Fine(2), s.Fine(4));
  }
}

}  // namespace

double HeldSeconds(const HoldState& state, double now_s) {
  return state.holding ? now_s - state.started_s : 0;
}

bool AdvanceHold(HoldState& state, const HoldInput& in) {
  const bool allowed = !in.blocked && !in.popup && !in.cancelled && in.window_focused;
  if (state.holding) {
    const bool kept =
        state.by_key ? in.key_down && in.has_focus : in.mouse_down && in.pointer_inside;
    const double held = HeldSeconds(state, in.now_s);
    if (!allowed || !kept || in.subject != state.subject) {
      state.holding = false;
      if (allowed && in.subject == state.subject) {
        state.released_at_s = in.now_s;
        state.released_after_s = held;
      }
      return false;
    }
    if (held >= in.duration_s) {
      state.holding = false;
      return true;
    }
    return false;
  }
  const bool mouse_starts = in.mouse_pressed && in.pointer_inside;
  const bool key_starts = in.key_pressed && in.has_focus;
  if (allowed && (mouse_starts || key_starts)) {
    state.holding = true;
    state.by_key = !mouse_starts;
    state.started_s = in.now_s;
    state.subject = in.subject;
  }
  return false;
}

bool DrawHoldButton(UiFrame& ui, std::string_view name, const Rect& rect,
                    const HoldButtonView& view, HoldState& state) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const bool ready = view.phase == HoldPhase::kReady;
  const Interaction in = Interact(ui, name, rect, kKeepsStop | (ready ? 0U : unsigned{kDisabled}));
  HoldInput input;
  input.now_s = ui.ui_time_s;
  input.pointer_inside = in.hovered;
  input.mouse_pressed = in.pressed;
  input.mouse_down = in.held;
  input.has_focus = in.focused;
  input.key_pressed = in.key_pressed;
  input.key_down = in.key_held;
  input.window_focused = ui.window_focused;
  input.popup = ui.blocked_by_popup;
  input.cancelled = state.holding && EscapePressed();
  input.blocked = !ready;
  input.subject = view.subject;
  input.duration_s = view.duration_s;
  if (input.cancelled) {
    ui.focus.TakeEscape();
  }
  const bool fired = AdvanceHold(state, input);

  const double held = HeldSeconds(state, ui.ui_time_s);
  DrawBody(ui, rect, view, static_cast<float>(std::min(1.0, held / view.duration_s)));
  const bool down = ready && !state.holding && !fired &&
                    ((in.hovered && ImGui::IsMouseDown(ImGuiMouseButton_Left)) || in.key_held);
  const Words words = WordsOf(view, state, down, ui.ui_time_s);
  ui.items.Last(name).text = words.title + " | " + words.second;
  const bool quiet = view.phase == HoldPhase::kBlocked || view.phase == HoldPhase::kNoVehicle;
  const ImU32 title = ready ? p.on_go : (quiet ? p.text2 : p.text1);
  const ImU32 second = ready ? p.on_go : (view.phase == HoldPhase::kBlocked ? p.text1 : p.text2);
  const float x = rect.centre().x;
  const float y = rect.centre().y;
  const bool has_second = !words.second.empty();
  ImFont* font = TextWidth(s.button, words.title) < rect.w - s.Px(20)    ? s.button
                 : TextWidth(s.section, words.title) < rect.w - s.Px(12) ? s.section
                                                                         : s.medium;
  DrawText(ui, font, title, x, has_second ? y - s.Px(rect.h > s.Px(60) ? 10 : 9) : y, words.title,
           Align::kCentre);
  const std::string shown = FitClauses(s.caption, words.second, rect.w - s.Px(12));
  DrawText(ui, s.caption, second, x, y + s.Px(12), shown, Align::kCentre);
  if (in.hovered && shown != words.second) {
    DrawTooltip(ui, words.second, &rect);
  }
  if (view.phase == HoldPhase::kAccepted || view.phase == HoldPhase::kRefused) {
    DrawIcon(Canvas(), view.phase == HoldPhase::kAccepted ? Icon::kDone : Icon::kCaution,
             {rect.x + s.Px(24), y}, s.Px(14),
             view.phase == HoldPhase::kAccepted ? p.text1 : p.caution);
  }
  return fired;
}

}  // namespace palace
