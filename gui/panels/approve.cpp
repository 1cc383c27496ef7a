#include <algorithm>
#include <cmath>

#include "engine/core/units.h"
#include "engine/model/mission/approve_offer.h"
#include "engine/model/site_standing.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/session_words.h"
#include "gui/widgets/button.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr double kAnswered_s = 2;  // the engine answers within a frame, or refuses

HoldButtonView ButtonOf(const EngineSnapshot& snap, const ApproveState& state, const UiFrame& ui) {
  const MissionStatus& m = snap.flight->mission;
  HoldButtonView view;
  view.subject = m.armed ? m.armed->id : 0;
  const std::string letter = m.armed ? m.armed->letter : std::string();
  view.label = "Hold to approve " + letter;
  if (m.armed && !m.armed->confirmed) {
    view.label += ", provisional";
  }
  using Phase = MissionStatus::ApprovalPhase;
  if (FollowsRecord(snap.session->role) || HasPicturesOnly(snap.session->role)) {
    view.phase = HoldPhase::kNoVehicle;
    view.reason = WhyNoLink(snap);
  } else if (m.approval_phase == Phase::kSent) {
    view.phase = HoldPhase::kRequested;
    view.label = "Sent to vehicle";
    view.reason = "Waiting " + Duration(m.approval_answer_s);
  } else if (m.approval_phase == Phase::kAccepted) {
    view.phase = HoldPhase::kAccepted;
    view.label = "Approved " + letter;
    view.reason = "Vehicle accepted in " + Duration(m.approval_answer_s);
  } else if (m.approval_phase == Phase::kRefused) {
    view.phase = HoldPhase::kRefused;
    view.reason = m.approval_answer;
  } else if (m.armed && state.asked_site == m.armed->id &&
             ui.ui_time_s - state.asked_at_s < kAnswered_s) {
    view.phase = HoldPhase::kRequested;
    view.label = "Approving " + letter;
    view.reason = "Held in full, let go";
  } else if (snap.terrain->preview) {
    view.phase = HoldPhase::kBlocked;
    view.reason = "Maps are a preview";
  } else if (!m.can_approve) {
    view.phase = HoldPhase::kBlocked;
    view.reason = m.cannot_approve_reason.empty()
                      ? (m.armed ? std::string("A check fails") : "Select a site first")
                      : m.cannot_approve_reason;
  } else if (const std::string why = WhyScreenOld(ui.silent_s); !why.empty()) {
    view.phase = HoldPhase::kBlocked;
    view.reason = why;
  }
  return view;
}

/// A person reads it where a site would be selected.
std::string WhyNotSelectable(const EngineSnapshot& snap) {
  const AuthorityStatus& authority = snap.session->authority;
  const bool view_only = authority.standing != AuthorityStanding::kNone && !authority.commands();
  return view_only ? authority.why_not + "." : "Sites cannot be selected here.";
}

/// The site that follows when the armed one is refused.
std::string NextLetter(const EngineSnapshot& snap) {
  if (!snap.flight->mission.armed || !snap.terrain->applied) {
    return {};
  }
  for (const LandingSite& site : snap.terrain->applied->selection.sites) {
    if (site.id != snap.flight->mission.armed->id && IsNamedSite(site.id) &&
        !snap.flight->mission.IsRefused(site.id)) {
      return site.letter;
    }
  }
  return {};
}

/// The armed site on the newest map; null where it is not listed.
const LandingSite* ArmedNow(const EngineSnapshot& snap) {
  const TerrainDecision* map = snap.terrain->applied.get();
  if (map == nullptr || !snap.flight->mission.armed) {
    return nullptr;
  }
  for (const LandingSite& site : map->selection.sites) {
    if (site.id == snap.flight->mission.armed->id) {
      return &site;
    }
  }
  return nullptr;
}

/// What the list says of the armed site is said where it is approved, too.
std::string WhyShaken(const EngineSnapshot& snap) {
  const LandingSite* now = ArmedNow(snap);
  return now != nullptr && std::isfinite(now->called_unsafe_s)
             ? "A map called it unsafe " + Fixed(now->called_unsafe_s, 0) + " s ago"
             : std::string();
}

/// Distance, height, time and heading, in sentences.
std::string Consequence(const EngineSnapshot& snap, bool narrow) {
  const MissionStatus& m = snap.flight->mission;
  std::string text =
      Fixed(m.distance_to_site_m, 1) + " m away, " + Fixed(m.height_above_site_m, 1) + " m down";
  if (std::isfinite(m.time_to_touchdown_s)) {
    text += (narrow ? ", touchdown in about " : ". Touchdown in about ") +
            Fixed(m.time_to_touchdown_s, 0) + " s";
  }
  const std::string shaken = WhyShaken(snap);
  if (!shaken.empty()) {
    return narrow ? shaken + "." : shaken + ". " + text + ".";
  }
  const std::string doubt =
      m.armed ? WhyProvisional(*m.armed, snap.session->settings.slad) : std::string();
  if (!narrow && !doubt.empty()) {
    return text + ". Provisional: " + doubt + ".";
  }
  if (!narrow && m.approach) {
    double heading = Deg(m.approach->heading_rad);
    heading += heading < -0.5 ? 360 : 0;
    text += ", heading " + Fixed(heading, 0) + "° at " + Fixed(m.approach->descent_rate_mps, 1) +
            " m/s. Vision steers; wave-off stays available";
  }
  return text + ".";
}

constexpr double kToldCut_s = 5;

/// The first reason against approve, as the button gives it: of a check, then of the screen.
std::string WhyNotNow(const EngineSnapshot& snap, const UiFrame& ui) {
  const MissionStatus& m = snap.flight->mission;
  if (snap.terrain->preview) {
    return "Maps are a preview";
  }
  for (const GuardResult& guard : m.guards) {
    if (!guard.pass) {
      return guard.reason.empty() ? guard.name : guard.reason;
    }
  }
  return WhyScreenOld(ui.silent_s);
}

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

/// "26 s" until the arm window closes; empty when nothing runs.
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
  const std::string why_not = WhyNotNow(snap, ui);
  const bool pass = why_not.empty();
  const std::string words = !pass ? why_not
                            : ui.ui_time_s < state.hold_cut_told_until_s
                                ? "Hold cut: " + state.hold_cut_by
                                : "All " + std::to_string(m.guards.size()) + " checks pass";
  DrawIcon(Canvas(), pass ? Icon::kDone : Icon::kCaution, {rect.x + s.Px(18), y}, s.Px(12),
           pass ? p.text1 : p.caution);
  const float text_x = rect.x + s.Px(32);
  const float room = rect.w - s.Px(110);
  const std::string_view shown = FitClauses(s.body, words, room);
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
  if (in.hovered && shown.size() < words.size() && !state.show_guards) {
    DrawTooltip(ui, words);
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
  const std::string next = NextLetter(snap);
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

/// Takes the selection back, in the panel's head: away from the buttons that commit.
void DrawDeselect(const LandingSite& site, const Rect& panel, UiFrame& ui) {
  const Style& s = ui.style;
  const std::string words = "Deselect site " + std::string(site.letter);
  const float width = TextWidth(s.caption, words) + s.Px(20);
  ButtonLook look;
  look.flat = true;
  look.font = s.caption;
  if (DrawButton(ui, "deselect",
                 {panel.right() - s.Px(8) - width, panel.y + s.Px(3), width, s.Px(22)}, words,
                 look)) {
    ui.intents.push_back(CommandAction(DisarmSite{}));
  }
}

/// What a person may do, and why not: while nothing is armed.
std::string WhatNow(const EngineSnapshot& snap) {
  const MissionStatus& m = snap.flight->mission;
  const bool sites = snap.terrain->applied && !snap.terrain->applied->selection.sites.empty();
  if (!m.may_select && sites) {
    return WhyNotSelectable(snap);
  }
  if (m.state == MissionState::kNoLive && !m.why.empty()) {
    return m.why + ".";
  }
  if (!sites) {
    return "Waiting for a site inside all limits.";
  }
  switch (m.state) {
    case MissionState::kProposed:
      return "Click a site, or press Tab and Enter, to select it.";
    case MissionState::kSearch:
      return "Selectable once one site has led for " +
             Duration(snap.session->settings.mission.propose_after_s) + ".";
    default:
      return "No site can be selected now.";
  }
}

/// Why the last selection ended, and what now; above the buttons, in small letters where it is
/// long.
void DrawWhatNow(const EngineSnapshot& snap, const Rect& from, float bottom, UiFrame& ui) {
  const Style& s = ui.style;
  const std::string& ended = snap.flight->mission.selection_ended;
  const std::string now = WhatNow(snap);
  const auto lines_of = [&](const ImFont* font) {
    std::vector<std::pair<std::string, bool>> lines;
    for (const std::string& line : WrapText(font, ended, from.w)) {
      lines.emplace_back(line, true);
    }
    for (const std::string& line : WrapText(font, now, from.w)) {
      lines.emplace_back(line, false);
    }
    return lines;
  };
  ImFont* font = s.body;
  float pitch = s.Px(20);
  auto lines = lines_of(font);
  if (from.y + pitch * static_cast<float>(lines.size()) > bottom) {
    font = s.caption;
    pitch = s.Px(17);
    lines = lines_of(font);
  }
  float y = from.y;
  for (const auto& [line, strong] : lines) {
    if (y + pitch > bottom) {
      if (Interact(ui, "what_now", {from.x, from.y, from.w, bottom - from.y}, kPassive).hovered) {
        DrawTooltip(ui, ended + (ended.empty() ? "" : " ") + now);
      }
      break;
    }
    DrawText(ui, font, strong ? s.palette.text1 : s.palette.text2, from.x, y + pitch / 2, line);
    y += pitch;
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
  const HoldButtonView view = ButtonOf(snap, state, ui);
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

}  // namespace

void DrawApprovePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow,
                      ApproveState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const MissionStatus& m = snap.flight->mission;
  const std::string fact = m.armed ? std::string("Site ") + m.armed->letter + " selected" : "";
  const bool armed = m.state == MissionState::kArmed && m.armed && m.may_select;
  DrawPanelFrame(ui, rect, "Approve", {{narrow || armed ? std::string() : fact}});
  if (armed) {
    DrawDeselect(*m.armed, rect, ui);
  }
  const float x = rect.x + s.Px(12);
  const float width = rect.w - s.Px(24);
  if (m.armed) {
    DrawText(ui, narrow ? s.medium : s.section, p.text1, x, rect.y + s.Px(narrow ? 42 : 46),
             std::string("Commits the vehicle to land on site ") + m.armed->letter + ".");
    float y = rect.y + s.Px(narrow ? 64 : 73);
    const std::string words = Consequence(snap, narrow);
    std::vector<std::string> lines = WrapText(s.body, words, width);
    ImFont* font = s.body;
    if (narrow) {
      font = TextWidth(s.body, words) <= width + s.Px(4) ? s.body : s.caption;
      lines = {words};
    }
    lines.resize(std::min<std::size_t>(lines.size(), 2));
    for (const std::string& line : lines) {
      DrawText(ui, font, p.text2, x, y, line);
      y += s.Px(19);
    }
    DrawChecks(snap, rect, rect.y + s.Px(narrow ? 88 : 132), narrow, state, ui);
    if (!narrow) {
      DrawExpiry(snap, rect, rect.y + s.Px(166), ui);
    }
  } else {
    DrawText(ui, narrow ? s.medium : s.section, p.text1, x, rect.y + s.Px(narrow ? 42 : 46),
             "Nothing is committed yet.");
    DrawWhatNow(snap, {x, rect.y + s.Px(narrow ? 54 : 63), width, 0}, ButtonsTop(rect, narrow, s),
                ui);
  }
  DrawButtons(snap, rect, narrow, state, ui);
  if (state.show_guards && !m.guards.empty()) {
    DrawGuardList(snap, rect, ui);
  }
}

}  // namespace palace
