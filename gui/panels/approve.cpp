#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/model/approach_side.h"
#include "engine/model/cell_explanation.h"
#include "engine/model/mission/alarm_text.h"
#include "engine/model/mission/approve_offer.h"
#include "engine/model/mission/refused_lately.h"
#include "gui/panels/approve_words.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/session_words.h"
#include "gui/widgets/button.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr double kToldCut_s = 5;

void DrawGuardList(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const float row = s.Px(22);
  const auto count = static_cast<float>(snap.flight->mission.guards.size());
  const Rect list{rect.x, rect.y - row * count - s.Px(24), rect.w, row * count + s.Px(16)};
  BeginOverlay("##checks", list);
  Interact(ui, "panel/Checks", list, kNoTab);
  FillRect(Canvas(), list, p.control, s.Fine(4));
  StrokeRect(Canvas(), list, p.strong_line, s.Fine(1), s.Fine(4));
  float y = list.y + s.Px(8) + row / 2;
  for (const GuardResult& guard : snap.flight->mission.guards) {
    DrawIcon(Canvas(), guard.pass ? Icon::kDone : Icon::kCaution, {list.x + s.Px(20), y}, s.Px(12),
             guard.pass ? p.text2 : p.caution);
    const std::string words = guard.pass || guard.reason.empty() ? guard.name : guard.reason;
    DrawText(ui, s.body, p.text1, list.x + s.Px(36), y, FitWords(s.body, words, list.w - s.Px(90)));
    DrawText(ui, s.caption, p.text2, list.right() - s.Px(12), y, GuardName(guard.id),
             Align::kRight);
    y += row;
  }
  EndOverlay();
}

/// What blocks nothing and speaks against the approval all the same; empty: nothing does.
std::string CautionToApprove(const MissionStatus& m) {
  for (const Alarm& alarm : m.alarms) {
    const bool of_it = alarm.kind == AlarmId::kTailwind || alarm.kind == AlarmId::kUnusualLimits;
    if (of_it && alarm.active) {
      const std::string subject = AlarmSubject(alarm.text);
      return subject.substr(0, subject.find(" ("));
    }
  }
  return {};
}

/// Until the arm window closes; NaN when nothing runs.
double SecondsLeft(const EngineSnapshot& snap) {
  return snap.flight->mission.arm_expires
             ? SecondsBetween(snap.time, *snap.flight->mission.arm_expires)
             : NAN;
}

void DrawChecks(const EngineSnapshot& snap, const Rect& rect, float y, bool narrow,
                ApproveState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const MissionStatus& m = snap.flight->mission;
  if (m.guards.empty()) {
    return;
  }
  const std::string why_not = WhyNotApprove(snap, ui.silent_s);
  const bool pass = why_not.empty();
  const std::string no_look = snap.session->events
                                  ? WhyRefusedLately(*snap.session->events, "Look", snap.time)
                                  : std::string();
  const std::string no_turn =
      snap.session->events ? WhyRefusedLately(*snap.session->events, "Turn approach", snap.time)
                           : std::string();
  const SiteStanding standing = ArmedStanding(m, snap.session->settings.slad);
  // Passed checks do not make a confirmed site.
  const bool confirmed = standing == SiteStanding::kConfirmed;
  const std::string all = std::to_string(m.guards.size()) + " checks pass";
  const std::string told = pass ? CautionToApprove(m) : std::string();
  const std::string words = !pass ? why_not
                            : ui.ui_time_s < state.hold_cut_told_until_s
                                ? "Hold cut: " + state.hold_cut_by
                            : !no_look.empty() ? "Not flown: " + no_look
                            : !no_turn.empty() ? "Not turned: " + no_turn
                            : !told.empty()    ? told + "; all " + all
                            : confirmed        ? "All " + all
                                        : std::string(StandingWord(standing)) + "; all " + all;
  const bool done = pass && confirmed && told.empty();
  DrawIcon(Canvas(), done ? Icon::kDone : Icon::kCaution, {rect.x + s.Px(18), y}, s.Px(12),
           done ? p.text1 : p.caution);
  const float text_x = rect.x + s.Px(32);
  const float room = rect.w - s.Px(110);
  const std::string shown = FitClauses(s.body, words, room);
  DrawText(ui, s.body, p.text1, text_x, y, shown);
  const Rect line{rect.x + s.Px(8), y - s.Px(10), rect.w - s.Px(16), s.Px(20)};
  const float right = rect.right() - s.Px(12);
  if (narrow) {
    const double left = SecondsLeft(snap);
    if (std::isfinite(left)) {
      DrawText(ui, s.medium, p.text1, right, y, Fixed(left, 0) + " s left", Align::kRight);
    }
  } else {
    DrawText(ui, s.body, p.text2, right, y, state.show_guards ? "Hide" : "Show", Align::kRight);
  }
  const Interaction in = Interact(ui, "show_checks", line, 0, words);
  if (in.clicked) {
    state.show_guards = !state.show_guards;
  }
  if (in.hovered && shown != words && !state.show_guards) {
    DrawTooltip(ui, words, &line);
  }
}

void DrawExpiry(const EngineSnapshot& snap, const Rect& rect, float y, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const double left = SecondsLeft(snap);
  if (!std::isfinite(left)) {
    return;
  }
  DrawIcon(Canvas(), Icon::kStale, {rect.x + s.Px(18), y}, s.Px(12), p.text2);
  float x = rect.x + s.Px(32);
  x += DrawText(ui, s.body, p.text2, x, y, "Selection expires in") + s.Px(6);
  x += DrawText(ui, s.medium, p.text1, x, y, Fixed(left, 0) + " s") + s.Px(12);
  const Rect track{x, std::round(y) - s.Px(2), rect.right() - s.Px(12) - x, s.Px(4)};
  const double share = left / std::max(snap.session->settings.mission.arm_window_s, 1.0);
  FillRect(Canvas(), track, p.hover, s.Fine(2));
  FillRect(Canvas(),
           {track.x, track.y, track.w * static_cast<float>(std::clamp(share, 0.0, 1.0)), track.h},
           p.text2, s.Fine(2));
}

/// While nothing is armed who commands a live vehicle may change.
bool OffersCommand(const EngineSnapshot& snap) {
  const AuthorityStatus& authority = snap.session->authority;
  return snap.session->source.kind == SourceKind::kLive && !snap.flight->mission.armed &&
         (authority.can_ask || authority.commands());
}

/// In place of Refuse. Taking over from a station that is heard asks for a hold.
void DrawCommandButton(const EngineSnapshot& snap, const Rect& rect, ApproveState& state,
                       UiFrame& ui) {
  const AuthorityStatus& authority = snap.session->authority;
  ButtonLook look;
  look.flat = true;
  if (authority.commands()) {
    look.enabled = !IsFlying(snap.flight->mission.state);
    look.sub = "another station may ask";
    if (DrawButton(ui, "release_command", rect, "Release command", look)) {
      ui.intents.push_back(CommandAction(ReleaseCommand{}));
    }
  } else if (authority.holder.empty() || authority.holder_is_silent) {
    look.sub = authority.holder.empty() ? "nobody has it" : "who has it is silent";
    if (DrawButton(ui, "ask_for_command", rect, "Ask for command", look)) {
      ui.intents.push_back(CommandAction(AskForCommand{}));
    }
  } else {
    HoldButtonView view;
    view.label = "Hold to take over";
    if (DrawHoldButton(ui, "take_over", rect, view, state.take_over)) {
      ui.intents.push_back(CommandAction(AskForCommand{true}));
    }
  }
}

void DrawRefuseButton(const EngineSnapshot& snap, const Rect& rect, bool narrow, UiFrame& ui) {
  const std::string next = NextSiteLetter(snap);
  const std::string then = next.empty() ? next : "then site " + next;
  ButtonLook look;
  look.font = narrow ? ui.style.medium : ui.style.section;
  look.flat = true;
  look.enabled = snap.flight->mission.armed.has_value() && snap.session->can_transmit &&
                 snap.flight->mission.state == MissionState::kArmed;
  look.sub = then;
  look.reason = snap.session->can_transmit ? "Select a site first" : WhyNoLink(snap);
  if (DrawButton(ui, "refuse", rect, "Refuse", look)) {
    ui.intents.push_back(CommandAction(RefuseSite{snap.flight->mission.armed->id}));
  }
}

/// One press: what it commits to is a hover. It asks for all that an approval asks for. In the
/// panel's head, where no button that commits to more ever stands. Right end of what it draws.
float DrawLookButton(const EngineSnapshot& snap, const Rect& panel, UiFrame& ui) {
  const Style& s = ui.style;
  const MissionStatus& m = snap.flight->mission;
  const std::string why_not = WhyNotApprove(snap, ui.silent_s);
  const std::string words = "Look from " + Fixed(m.look_from_m, 0) + " m";
  const Rect rect{panel.x + s.Px(18) + TextWidth(s.medium, "Approve"), panel.y + s.Px(3),
                  TextWidth(s.caption, words) + s.Px(20), s.Px(22)};
  ButtonLook look;
  look.font = s.caption;
  look.flat = true;
  look.enabled = m.can_approve && why_not.empty();
  look.reason = why_not.empty() ? m.cannot_approve_reason : why_not;
  look.hint = "Flies down the approach, hovers there and looks again; nothing is approved to land";
  if (DrawButton(ui, "look", rect, words, look)) {
    ui.intents.push_back(CommandAction(LookAtSite{m.armed->id, snap.sequence, m.look_from_m}));
  }
  return rect.right();
}

/// Takes the selection back, in the panel's head: away from the buttons that commit.
/// Left end of what it draws.
float DrawDeselect(const LandingSite& site, const Rect& panel, bool narrow, UiFrame& ui) {
  const Style& s = ui.style;
  const std::string words = (narrow ? "Deselect " : "Deselect site ") + site.letter;
  const float width = TextWidth(s.caption, words) + s.Px(20);
  ButtonLook look;
  look.flat = true;
  look.font = s.caption;
  if (DrawButton(ui, "deselect",
                 {panel.right() - s.Px(8) - width, panel.y + s.Px(3), width, s.Px(22)}, words,
                 look)) {
    ui.intents.push_back(CommandAction(DisarmSite{}));
  }
  return panel.right() - s.Px(8) - width;
}

/// "straight" or "from the north-east".
std::string SideName(int side) {
  return side == kStraightApproach
             ? std::string("straight")
             : std::string("from the ") + DirectionWord(HeadingFromSector(side) + std::numbers::pi);
}

/// One press: the next clear side, clockwise. Beside Deselect; the short word where the other is
/// too long to stand between `from` and `to`.
void DrawTurnButton(const MissionStatus& m, float from, float to, float y, UiFrame& ui) {
  const Style& s = ui.style;
  const std::vector<int>& sides = m.approach_sides;
  const auto now = std::find(sides.begin(), sides.end(), m.approach->side);
  const int next = now == sides.end() || now + 1 == sides.end() ? sides.front() : now[1];
  const char* words = "Turn approach";
  if (TextWidth(s.caption, words) + s.Px(36) > to - from) {
    words = "Turn";
  }
  const float width = TextWidth(s.caption, words) + s.Px(20);
  ButtonLook look;
  look.flat = true;
  look.font = s.caption;
  // Short: what it changes stands below it.
  const std::string hint = "Now " + SideName(m.approach->side) + "; next " + SideName(next);
  look.hint = hint;
  if (DrawButton(ui, "turn", {to - s.Px(8) - width, y, width, s.Px(22)}, words, look)) {
    ui.intents.push_back(CommandAction(TurnApproach{m.armed->id, next}));
  }
}

/// Why the last selection ended, and what now; above the buttons, in small letters where it is
/// long.
void DrawWhatNow(const EngineSnapshot& snap, const Rect& from, float bottom, UiFrame& ui) {
  const Style& s = ui.style;
  const std::string& ended = snap.flight->mission.selection_ended;
  const std::string now = WhatToDoUnarmed(snap);
  ImFont* font = s.body;
  float pitch = s.Px(20);
  const auto all_lines = [&] {
    return WrapText(font, ended, from.w).size() + WrapText(font, now, from.w).size();
  };
  const auto room = [&] {
    return static_cast<std::size_t>(std::max(1.0F, std::floor((bottom - from.y) / pitch)));
  };
  if (all_lines() > room()) {
    font = s.caption;
    pitch = s.Px(17);
  }
  if (all_lines() > room() &&
      Interact(ui, "what_now", {from.x, from.y, from.w, bottom - from.y}, kPassive).hovered) {
    DrawTooltip(ui, ended + (ended.empty() ? "" : " ") + now);
  }
  float y = from.y;
  const auto draw = [&](const std::vector<std::string>& lines, ImU32 ink) {
    for (const std::string& line : lines) {
      DrawText(ui, font, ink, from.x, y + pitch / 2, line);
      y += pitch;
    }
    return lines.size();
  };
  // What to do now keeps a line.
  const std::size_t first =
      ended.empty() ? 0
                    : draw(WrapText(font, ended, from.w, std::max<std::size_t>(1, room() - 1)),
                           s.palette.text1);
  if (first < room()) {
    draw(WrapText(font, now, from.w, room() - first), s.palette.text2);
  }
}

/// Narrow: a line, or two of small letters.
void DrawConsequence(const std::string& words, const Rect& rect, bool narrow, UiFrame& ui) {
  const Style& s = ui.style;
  const float width = rect.w - s.Px(24);
  const bool small = narrow && TextWidth(s.body, words) > width;
  ImFont* font = small ? s.caption : s.body;
  float y = rect.y + s.Px(!narrow ? 73 : small ? 58 : 64);
  const std::vector<std::string> lines = WrapText(font, words, width, small ? 2 : 3);
  for (const std::string& line : lines) {
    DrawText(ui, font, s.palette.text2, rect.x + s.Px(12), y, line);
    y += s.Px(small ? 15 : 19);
  }
  if (lines.size() < WrapText(font, words, width).size() &&
      Interact(ui, "consequence", {rect.x, rect.y + s.Px(48), rect.w, s.Px(small ? 32 : 60)},
               kPassive)
          .hovered) {
    DrawTooltip(ui, words);
  }
}

float ButtonHeight(bool narrow, const Style& s) { return s.Px(narrow ? 52 : 68); }
float ButtonsTop(const Rect& rect, bool narrow, const Style& s) {
  return rect.bottom() - s.Px(12) - ButtonHeight(narrow, s);
}

void DrawButtons(const EngineSnapshot& snap, const Rect& rect, bool narrow, ApproveState& state,
                 UiFrame& ui) {
  const Style& s = ui.style;
  const float height = ButtonHeight(narrow, s), y = ButtonsTop(rect, narrow, s);
  const float gap = narrow ? s.Px(8) : s.Px(12);
  const bool command = OffersCommand(snap);
  // While nothing can be approved, who commands is as much of a question.
  const float width =
      command ? std::round((rect.w - s.Px(24) - gap) / 2) : s.Px(narrow ? 228 : 268);
  const Rect hold{rect.right() - s.Px(12) - width, y, width, height};
  const Rect left{rect.x + s.Px(12), y, hold.x - gap - rect.x - s.Px(12), height};
  if (command) {
    DrawCommandButton(snap, left, state, ui);
  } else {
    DrawRefuseButton(snap, left, narrow, ui);
  }
  const HoldButtonView view = ApproveButton(snap, state, ui.ui_time_s, ui.silent_s);
  const bool was_held = state.hold.holding;
  const bool approved = DrawHoldButton(ui, "approve", hold, view, state.hold);
  if (was_held && !state.hold.holding && view.phase == HoldPhase::kBlocked) {
    state.hold_cut_by = view.reason;
    state.hold_cut_told_until_s = ui.ui_time_s + kToldCut_s;
  }
  if (approved) {
    state.asked_site = view.subject;
    state.asked_at_s = ui.ui_time_s;
    ui.intents.push_back(CommandAction(ApproveSite{view.subject, snap.sequence}));
  }
}

/// "Commits the vehicle to land on site A."
std::string CommitmentWords(const MissionStatus& m) {
  const std::string commits = m.can_approve ? "Commits" : "Would commit";
  return m.IsRefused(m.armed->id)
             ? commits + " to land on " + m.armed->letter + ", which you refused."
             : commits + " the vehicle to land on site " + m.armed->letter + ".";
}

/// With a selection, and with its end, other buttons come into the panel's head. Where the pointer
/// waits there they take no press for a moment: it may be meant for the one that stood there.
std::string_view WhyWithheld(const Rect& panel, bool armed, ApproveState& state,
                             const UiFrame& ui) {
  constexpr double kMoment_s = 1.0;
  const Rect head{panel.x, panel.y, panel.w, ui.style.Px(64)};
  if (state.head_is_armed != armed) {
    state.head_is_armed = armed;
    if (head.Contains(ImGui::GetIO().MousePos)) {
      state.withheld_until_s = ui.ui_time_s + kMoment_s;
    }
  }
  return ui.ui_time_s < state.withheld_until_s ? "This came up under the pointer just now"
                                               : std::string_view();
}

}  // namespace

void DrawApprovePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow,
                      const std::optional<Eigen::Vector2d>& pin, ApproveState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const MissionStatus& m = snap.flight->mission;
  const std::string fact = m.armed ? std::string("Site ") + m.armed->letter + " selected" : "";
  const bool armed = m.state == MissionState::kArmed && m.armed && m.may_select;
  DrawPanelFrame(ui, rect, "Approve", {{narrow || armed ? std::string() : fact}});
  ui.withheld = WhyWithheld(rect, m.armed.has_value(), state, ui);
  float head = rect.x + s.Px(12) + TextWidth(s.medium, "Approve");
  const bool lacks_look = armed && m.next_look;  // without it the site cannot be approved
  if (m.may_select && m.OffersLook() && !lacks_look) {
    head = DrawLookButton(snap, rect, ui);
  }
  if (lacks_look) {
    head = DrawProposedLook(snap, head + s.Px(10), rect.y + s.Px(3), false, ui);
  }
  if (armed) {
    const float end = DrawDeselect(*m.armed, rect, narrow, ui);
    const auto other = [&](int side) { return side != m.approach->side; };
    if (m.approach && std::any_of(m.approach_sides.begin(), m.approach_sides.end(), other)) {
      DrawTurnButton(m, head, end, rect.y + s.Px(3), ui);
    }
  }
  if (!m.armed && m.may_select) {
    DrawWaysElsewhere(snap, rect, pin, ui);
  }
  const float x = rect.x + s.Px(12);
  const float width = rect.w - s.Px(24);
  if (m.armed) {
    DrawText(ui, narrow ? s.medium : s.section, p.text1, x, rect.y + s.Px(narrow ? 42 : 46),
             CommitmentWords(m));
    DrawConsequence(ApprovalConsequence(snap, narrow), rect, narrow, ui);
    DrawChecks(snap, rect, rect.y + s.Px(narrow ? 88 : 137), narrow, state, ui);
    if (!narrow) {
      DrawExpiry(snap, rect, rect.y + s.Px(168), ui);
    }
  } else {
    DrawText(ui, narrow ? s.medium : s.section, p.text1, x, rect.y + s.Px(narrow ? 42 : 46),
             "Nothing is committed yet.");
    if (m.may_select && !m.going) {
      DrawProposedLook(snap, x + width, rect.y + s.Px(narrow ? 31 : 35), true, ui);
    }
    DrawWhatNow(snap, {x, rect.y + s.Px(narrow ? 54 : 63), width, 0}, ButtonsTop(rect, narrow, s),
                ui);
  }
  ui.withheld = {};
  DrawButtons(snap, rect, narrow, state, ui);
  if (state.show_guards && !m.guards.empty()) {
    DrawGuardList(snap, rect, ui);
  }
}

}  // namespace palace
