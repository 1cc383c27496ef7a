#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/model/site_standing.h"
#include "gui/panels/approve_words.h"
#include "gui/panels/arrival.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/session_words.h"
#include "gui/widgets/button.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr float kStopShare = 0.28f;  // of the width; the rest is where approve was

/// With the age of the word that it rests on: a vehicle that falls silent goes on being quoted.
std::string WaveOffHeadline(const WaveOffReport& report, double silent_s) {
  using Phase = WaveOffReport::Phase;
  const double age_s = report.age_s + silent_s;
  switch (report.phase) {
    case Phase::kDone:
      return Heard("Waved off, hovering", age_s);
    case Phase::kStands:
      return Heard("Waved off, on the ground", age_s);
    case Phase::kFlies:
      return Heard("Wave-off under way", age_s);
    case Phase::kClimbs:
      return Heard("Waved off, climbing", age_s);
    case Phase::kAccepted:
      return "Wave-off: accepted " + AgeText(age_s) + " ago";
    case Phase::kUnanswered:
      return "Wave-off: no answer";
    default:
      return "Wave-off: sent";
  }
}

/// `heard_s`: since the vehicle was heard, whose deed a hold is. `brief`: without why the approach
/// comes from another side.
std::string Headline(const MissionStatus& m, double silent_s, double heard_s, bool brief) {
  const std::string site = m.armed ? std::string("site ") + m.armed->letter : std::string("a site");
  switch (m.state) {
    case MissionState::kApproved:
      return (m.IsLook() ? "Approved: look at " : "Approved: ") + site +
             (brief ? SideOnlyWords(m) : SideWords(m));
    case MissionState::kHold:
      return Heard("Holding on the way to " + site, heard_s);
    case MissionState::kAborting:
      return WaveOffHeadline(m.wave_off, silent_s);
    default:
      return m.IsLook() ? "Looking at " + site + " from " + Fixed(m.stop_height_m, 0) + " m"
                        : "Landing on " + site;
  }
}

std::string Record(const EngineSnapshot& snap) {
  const MissionStatus& m = snap.flight->mission;
  if (m.state == MissionState::kHold || m.state == MissionState::kAborting) {
    // What caused a hold may be over since; that it was told is so.
    const bool is_hold = m.state == MissionState::kHold && snap.time >= m.since &&
                         !FollowsRecord(snap.session->role);
    const std::string when =
        is_hold ? AgeText(SecondsBetween(m.since, snap.time)) + " ago: " : std::string();
    const std::string why =
        m.why.empty() ? std::string("The approval is over.") : when + m.why + ".";
    const auto is_lost = [](const SiteRecheck& c) { return c.verdict == SiteVerdict::kLost; };
    const bool checked = m.state == MissionState::kHold && !m.rechecks.empty();
    const bool lost = checked && is_lost(m.rechecks.back());
    // Maps say nothing of a hold for something else, though the site may have come and gone since.
    const bool of_site =
        checked && std::any_of(m.rechecks.begin(), m.rechecks.end(), [&](const SiteRecheck& c) {
          return is_lost(c) && c.reason == m.why;
        });
    if (of_site && m.rechecks.back().verdict == SiteVerdict::kHolds) {
      return why + " No newer map shows it.";
    }
    const LandingSite* other =
        lost && m.rechecks.back().alternative ? &*m.rechecks.back().alternative : nullptr;
    return other == nullptr ? why
                            : why + " Alternative: site " + other->letter + ", " +
                                  ClearWords(*other) + ", not approved.";
  }
  if (!m.approval) {
    return "";
  }
  std::string text = "Approved " + ClockText(m.approval->approved_at) +
                     (m.approved_by.empty() ? "" : " by " + m.approved_by);
  if (m.approval_phase == MissionStatus::ApprovalPhase::kAccepted) {
    return text + ", accepted in " + Duration(m.approval_answer_s) + ".";
  }
  text += ".";
  if (m.approval_phase == MissionStatus::ApprovalPhase::kSent) {
    text += " Waiting for the vehicle.";
  } else if (m.approval_phase == MissionStatus::ApprovalPhase::kRefused) {
    text += " Vehicle refused: " + m.approval_answer;
  }
  return text;
}

/// Nothing is approved on ground that was not seen lately, and from near the ground little is;
/// while a check of what is measured fails, nothing is anyhow.
std::string WhatToDoOnHold(const EngineSnapshot& snap) {
  constexpr std::array kOfInputs = {GuardId::kLink, GuardId::kAttitude, GuardId::kCameras,
                                    GuardId::kMap};
  for (const GuardResult& guard : snap.flight->mission.guards) {
    const bool of_inputs =
        std::find(kOfInputs.begin(), kOfInputs.end(), guard.id) != kOfInputs.end();
    if (of_inputs && !guard.pass) {
      return guard.reason + ": no site can be selected.";
    }
  }
  const TerrainDecision* map = snap.terrain->applied.get();
  return map != nullptr && IsAnyInView(map->selection.sites)
             ? "Select a site once the vehicle has stopped."
             : "No site in view: wave off to look from above.";
}

float HoldWordsAt(const Rect& button, const Style& s) { return button.bottom() - s.Px(8); }

/// What stops or ends it, below. The stop stands where Refuse stood: a second press where approve
/// was does nothing.
void DrawActions(const EngineSnapshot& snap, const Rect& button, UiFrame& ui) {
  const Style& s = ui.style;
  const MissionStatus& m = snap.flight->mission;
  ButtonLook look;
  look.font = s.section;
  look.flat = true;
  if (m.state == MissionState::kAborting) {
    look.enabled = snap.session->can_transmit && m.wave_off.over;
    look.reason =
        snap.session->can_transmit ? "Not before the vehicle is heard to hover" : WhyNoLink(snap);
    if (DrawButton(ui, "acknowledge_wave_off", button, "Wave-off complete, search again", look)) {
      ui.intents.push_back(CommandAction(AcknowledgeWaveOff{}));
    }
    return;
  }
  if (m.state == MissionState::kHold) {
    DrawText(ui, s.body, s.palette.text1, button.x, HoldWordsAt(button, s),
             FitClauses(s.body, WhatToDoOnHold(snap), button.w));
    return;
  }
  look.enabled = IsFlying(m.state) && snap.session->can_transmit;
  look.reason = snap.session->can_transmit ? "Nothing to stop" : WhyNoLink(snap);
  const Rect left{button.x, button.y, std::round(button.w * kStopShare), button.h};
  if (DrawButton(ui, "hold_here", left, "Hold here", look)) {
    ui.intents.push_back(CommandAction(HoldHere{}));
  }
}

/// "12 m", or "0" on the ground.
std::string HeightLabel(double height_m) { return height_m > 0 ? Fixed(height_m, 0) + " m" : "0"; }

/// Height flown, with ticks where the evidence is asked again; of a look down to where it ends.
void DrawLadder(const EngineSnapshot& snap, const Rect& bar, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const MissionStatus& m = snap.flight->mission;
  const double end_m = m.stop_height_m;
  double top_m = std::isfinite(m.height_above_site_m) ? m.height_above_site_m : 0;
  for (const SiteRecheck& recheck : m.rechecks) {
    top_m = std::max(top_m, recheck.height_above_site_m);
  }
  FillRect(Canvas(), bar, p.hover, s.Fine(1));
  if (!(top_m > end_m)) {
    return;
  }
  const auto at = [&](double height_m) {
    const double flown = (top_m - height_m) / (top_m - end_m);
    return bar.x + bar.w * static_cast<float>(std::clamp(flown, 0.0, 1.0));
  };
  if (std::isfinite(m.height_above_site_m)) {
    FillRect(Canvas(), {bar.x, bar.y, at(m.height_above_site_m) - bar.x, bar.h}, p.bar, s.Fine(1));
  }
  float free_from = bar.x;
  const float end = bar.right() - TextWidth(s.caption, HeightLabel(end_m)) - s.Px(8);
  const std::vector<double> ticks =
      m.IsLook() ? std::vector{top_m, end_m}
                 : std::vector{top_m, m.confirm_height_m,
                               snap.session->settings.slad.fusion.commit_height_m, end_m};
  for (const double height_m : ticks) {
    const float x = std::min(at(height_m), bar.right() - s.Px(2));
    FillRect(Canvas(), {x, bar.y - s.Px(4), s.Px(2), bar.h + s.Px(8)}, p.text1);
    const std::string label = HeightLabel(height_m);
    const float width = TextWidth(s.caption, label);
    const bool is_end = height_m == end_m;
    const float from = is_end ? bar.right() - width : std::max(bar.x, x - width / 2);
    const bool fits = is_end || (from >= free_from && from + width <= end);
    if (fits) {
      DrawText(ui, s.caption, p.text2, from, bar.bottom() + s.Px(14), label);
      free_from = from + width + s.Px(8);
    }
  }
}

/// Between ladder and buttons; in small letters where one size up has no room.
void DrawRecord(const EngineSnapshot& snap, const Rect& rect, bool tall, const Rect& button,
                UiFrame& ui) {
  const Style& s = ui.style;
  const std::string record = Record(snap);
  // A hold has one line of words where else buttons stand.
  const bool held = snap.flight->mission.state == MissionState::kHold;
  const float bottom = held ? HoldWordsAt(button, s) - s.Px(9) : button.y;
  const float top = rect.y + s.Px(tall ? 106 : 92);
  const auto lines_of = [&](const ImFont* font, float from, float pitch) {
    const float most = std::max(1.0F, std::floor((bottom - from) / pitch));
    return WrapText(font, record, button.w, static_cast<std::size_t>(most));
  };
  ImFont* font = s.body;
  float pitch = s.Px(19), y = top + s.Px(tall ? 4 : 1);
  std::vector<std::string> lines = lines_of(font, y, pitch);
  const bool is_cut = lines.size() < WrapText(font, record, button.w).size();
  if (is_cut || (lines.size() > 1 && TextWidth(s.caption, record) <= button.w)) {
    font = s.caption;
    pitch = s.Px(15);
    lines = lines_of(font, top, pitch);
    y = top + (lines.size() > 1 ? 0 : s.Px(4));
  }
  for (const std::string& line : lines) {
    DrawText(ui, font, s.palette.text2, button.x, y + pitch / 2, line);
    y += pitch;
  }
  const Rect told{button.x, rect.y, button.w, button.y - rect.y};
  if (lines.size() < WrapText(font, record, button.w).size() &&
      Interact(ui, "landing_record", told, kPassive).hovered) {
    DrawTooltip(ui, record);
  }
}

}  // namespace

std::string TimeToGo(const EngineSnapshot& snap) {
  const auto& vehicle = snap.sensors->vehicle;
  const std::string seconds = Fixed(snap.flight->mission.time_to_touchdown_s, 0);
  return (vehicle && vehicle->mode == VehicleMode::kSettle ? "over " : "") + seconds;
}

void DrawLandingPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const MissionStatus& m = snap.flight->mission;
  const bool tall = rect.h >= s.Px(184);
  DrawPanelFrame(ui, rect, m.IsLook() ? "Look" : "Landing");
  if (m.state == MissionState::kHold && m.may_select) {
    // Where no site stands any more there is nothing else to go on with.
    DrawWaysElsewhere(snap, rect, std::nullopt, ui);
  }
  const float x = rect.x + s.Px(12);
  const float width = rect.w - s.Px(24);
  const float head_y = rect.y + s.Px(tall ? 49 : 44);
  const bool counting = std::isfinite(m.time_to_touchdown_s) && IsFlying(m.state);
  float room = width;
  if (counting) {
    room -= DrawText(ui, s.readout, p.text1, rect.right() - s.Px(12), head_y, TimeToGo(snap) + " s",
                     Align::kRight) +
            s.Px(12);
  }
  const double heard_s = ArrivalOf(snap, ChannelId::kVehiclePose, ui.silent_s).age_s;
  std::string headline = Headline(m, ui.silent_s, heard_s, false);
  if (TextWidth(s.medium, headline) > room) {
    // Cut at a clause, "from the south…" might be the south-west.
    headline = Headline(m, ui.silent_s, heard_s, true);
  }
  ImFont* font = TextWidth(s.readout, headline) <= room   ? s.readout
                 : TextWidth(s.section, headline) <= room ? s.section
                                                          : s.medium;
  DrawText(ui, font, p.text1, x, head_y, FitClauses(font, headline, room));
  DrawLadder(snap, {x, rect.y + s.Px(tall ? 75 : 62), width, s.Px(8)}, ui);
  const Rect button{x, rect.bottom() - s.Px(52), width, s.Px(40)};
  DrawRecord(snap, rect, tall, button, ui);
  DrawActions(snap, button, ui);
}

}  // namespace palace
