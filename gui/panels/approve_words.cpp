#include "gui/panels/approve_words.h"

#include <cctype>
#include <cmath>
#include <numbers>

#include "engine/core/units.h"
#include "engine/model/approach_side.h"
#include "engine/model/cell_explanation.h"
#include "engine/model/find_site.h"
#include "engine/model/mission/approve_offer.h"
#include "engine/model/mission/refused_lately.h"
#include "engine/model/site_standing.h"
#include "engine/model/thinnest_seen.h"
#include "gui/panels/session_words.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

constexpr double kAnswered_s = 2;  // the engine answers within a frame, or refuses

/// A person reads it where a site would be selected.
std::string WhyNotSelectable(const EngineSnapshot& snap) {
  const AuthorityStatus& authority = snap.session->authority;
  const bool view_only = authority.standing != AuthorityStanding::kNone && !authority.commands();
  return view_only ? authority.why_not + "." : "Sites cannot be selected here.";
}

/// What the list says of the armed site is said where it is approved, too: how long ago a map
/// called it unsafe, also while no newer map comes; NaN: none did.
double ShakenFor_s(const EngineSnapshot& snap) {
  const auto& armed = snap.flight->mission.armed;
  const LandingSite* now = armed ? FindSite(snap.terrain->applied.get(), armed->id) : nullptr;
  return now != nullptr && std::isfinite(now->called_unsafe_s)
             ? now->called_unsafe_s + SecondsBetween(now->map_time, snap.time)
             : NAN;
}

/// "Flies to another hover: 12.3 m and 40° to go, over 6 m of ground that no map showed."
std::string WayWords(const EngineSnapshot& snap) {
  constexpr double kTold_m = 0.1, kTold_deg = 1;
  const Going& going = *snap.flight->mission.going;
  const std::optional<VehiclePose>& pose = snap.sensors->pose;
  const double turn_deg =
      pose ? std::abs(Deg(WrapAngle(going.heading_rad - EulerFromRotation(pose->X_WB.R).yaw_rad)))
           : 0;
  const std::string way = going.to_go_m >= kTold_m ? Fixed(going.to_go_m, 1) + " m" : "";
  const std::string turn = turn_deg >= kTold_deg ? Fixed(turn_deg, 0) + "°" : "";
  const std::string left = way + (way.empty() || turn.empty() ? "" : " and ") + turn;
  return std::string("Flies to another hover") + (left.empty() ? "" : ": " + left + " to go") +
         (going.unseen_m >= kTold_m
              ? ", over " + Fixed(going.unseen_m, 1) + " m of ground that no map showed."
              : ".");
}

/// " Look right 45°: shows 240 m² that were not looked at yet."
std::string LookWords(const MissionStatus& m) {
  if (!m.next_look) {
    return m.why_no_look.empty() || !m.why_not_go.empty() ? "" : " " + m.why_no_look + ".";
  }
  return " " + LookLabel(*m.next_look) + ": " + m.next_look->why + ".";
}

/// "Seen in 1 of the 3 frames that it takes." of what stands after a colon elsewhere.
std::string AsSentence(std::string words) {
  words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words + ".";
}

}  // namespace

std::string LookLabel(const ProposedLook& look) { return "Look " + look.words; }

std::string WhyNotApprove(const EngineSnapshot& snap, double silent_s) {
  const MissionStatus& m = snap.flight->mission;
  if (snap.terrain->preview) {
    return "Maps are a preview";
  }
  for (const GuardResult& guard : m.guards) {
    if (!guard.pass) {
      return guard.reason.empty() ? guard.name : guard.reason;
    }
  }
  return WhyScreenOld(silent_s);
}

HoldButtonView ApproveButton(const EngineSnapshot& snap, const ApproveState& state,
                             double ui_time_s, double silent_s) {
  const MissionStatus& m = snap.flight->mission;
  HoldButtonView view;
  view.subject = m.armed ? m.armed->id : 0;
  const std::string letter = m.armed ? m.armed->letter : std::string();
  view.label = "Hold to approve " + letter;
  if (m.armed) {
    view.label += StandingMark(m, snap.session->settings.slad);
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
             ui_time_s - state.asked_at_s < kAnswered_s) {
    view.phase = HoldPhase::kRequested;
    view.label = "Approving " + letter;
    view.reason = "Held in full, let go";
  } else if (snap.terrain->preview) {
    view.phase = HoldPhase::kBlocked;
    view.reason = "Maps are a preview";
  } else if (!m.can_approve) {
    view.phase = HoldPhase::kBlocked;
    const bool searches = m.state == MissionState::kSearch && !m.armed;
    view.reason = searches && !m.search_stopped.empty() ? m.search_stopped
                  : searches                            ? "No site is proposed yet"
                  : m.cannot_approve_reason.empty()
                      ? (m.armed ? "A check fails" : "Select a site first")
                      : m.cannot_approve_reason;
  } else if (const std::string why = WhyScreenOld(silent_s); !why.empty()) {
    view.phase = HoldPhase::kBlocked;
    view.reason = why;
  } else if (snap.session->events) {
    const std::string refused = WhyRefusedLately(*snap.session->events, "Approve", snap.time);
    view.reason = refused.empty() ? "" : "Not approved: " + refused;
  }
  return view;
}

std::string SideOnlyWords(const MissionStatus& m) {
  return m.approach && m.approach->turned()
             ? std::string(", from the ") +
                   DirectionWord(m.approach->heading_rad + std::numbers::pi)
             : std::string();
}

std::string SideWords(const MissionStatus& m) {
  const std::string side = SideOnlyWords(m);
  return side.empty() || m.approach->why.empty() ? side : side + ", " + m.approach->why;
}

namespace {

/// By the newest pictures that ranges were made of; NaN where there are none.
double ThinnestSeenAt(const EngineSnapshot& snap, const Eigen::Vector3d& p_W) {
  const auto& range = snap.terrain->range;
  return range ? ThinnestSeen_m(range->camera, snap.sensors->X_WC, p_W) : NAN;
}

/// What no map is sure of, whatever the site's standing; empty where it is not known.
std::string ThinWords(const EngineSnapshot& snap, bool narrow) {
  const MissionStatus& m = snap.flight->mission;
  const double thin_m = m.armed ? ThinnestSeenAt(snap, m.armed->p_WS) : NAN;
  return std::isnan(thin_m)
             ? ""
             : std::string(narrow ? " Nothing" : " From here nothing") + " thinner than " +
                   Fixed(100 * thin_m, 0) + " cm is sure to be seen.";
}

/// The level way to where the slope begins, which pictures need not have shown; empty: it begins
/// here.
std::string LevelFirstWords(const MissionStatus& m) {
  constexpr double kTold_m = 1;
  if (m.way_W.size() < 2) {
    return {};
  }
  const auto way_m = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return (to - from).head<2>().norm();
  };
  const Eigen::Vector3d &here = m.way_W[0], &slope = m.way_W[1];
  const double level_m = way_m(here, slope);
  if (!(level_m >= kTold_m)) {
    return {};
  }
  const bool backs = way_m(slope, m.site_p_WS) > way_m(here, m.site_p_WS);
  const bool turned = m.approach && m.approach->turned();
  return (backs && !turned ? ", backs " : ", flies ") + Fixed(level_m, 1) + " m level first";
}

}  // namespace

std::string ApprovalConsequence(const EngineSnapshot& snap, bool narrow) {
  const MissionStatus& m = snap.flight->mission;
  const std::string thin = ThinWords(snap, narrow);
  const std::string side = SideWords(m);
  const bool brief = narrow && !side.empty();  // one line has no room for all
  std::string text = Fixed(m.distance_to_site_m, 1) + " m away";
  if (!brief) {
    text += ", " + Fixed(m.height_above_site_m, 1) + " m down";
  }
  text += side;
  const std::string heading =
      m.approach ? ", heading " + HeadingText(m.approach->heading_rad) : std::string();
  text += side.empty() ? heading : "";
  text += brief ? "" : LevelFirstWords(m);
  if (std::isfinite(m.time_to_touchdown_s)) {
    text +=
        (narrow ? ", down in " : ". Touchdown in about ") + Fixed(m.time_to_touchdown_s, 0) + " s";
  }
  const double shaken_s = ShakenFor_s(snap);
  const SladSettings& limits = snap.session->settings.slad;
  const std::string why = m.armed ? WhyProvisional(ArmedAsKnown(m), limits) : "";
  const std::string doubt =
      why.empty() ? "" : StandingWord(ArmedStanding(m, limits)) + (": " + why) + ".";
  if (!std::isnan(shaken_s)) {
    // That a map called it unsafe goes before how far away it is: there is room for three lines, or
    // for a short one.
    const std::string shaken = "A map called it unsafe " + Fixed(shaken_s, 0) + " s ago";
    if (narrow && !side.empty()) {
      return "Called unsafe " + Fixed(shaken_s, 0) + " s ago" + side + "." + thin;
    }
    const std::string flown =
        side.empty() ? shaken + "." : shaken + ". Flown" + side.substr(1) + ".";
    return (narrow ? flown : flown + " " + (doubt.empty() ? text + "." : doubt)) + thin;
  }
  if (!doubt.empty() && (!narrow || side.empty())) {
    // Where there is room for one, the button names the standing and the list the way.
    return (narrow ? AsSentence(why) : text + ". " + doubt) + thin;
  }
  if (!narrow && m.approach) {
    text +=
        (side.empty() ? "" : heading) + " at " + Fixed(m.approach->descent_rate_mps, 1) + " m/s";
  }
  return text + "." + thin;
}

std::string WhatToDoUnarmed(const EngineSnapshot& snap) {
  const MissionStatus& m = snap.flight->mission;
  const bool sites = snap.terrain->applied && !snap.terrain->applied->selection.sites.empty();
  if (!m.may_select && sites) {
    return WhyNotSelectable(snap);
  }
  if (m.going) {
    return WayWords(snap) + " Hold here stops it.";
  }
  if (snap.sensors->vehicle && snap.sensors->vehicle->mode == VehicleMode::kGo) {
    return "The vehicle flies to another hover.";  // another's order, or a record after a jump
  }
  if (m.state == MissionState::kNoLive && !m.why.empty()) {
    return m.why + ".";
  }
  if (!sites) {
    const bool waits = snap.terrain->applied && snap.terrain->applied->selection.waits;
    return (waits ? "Waiting for the first list of sites."
                  : "Waiting for a site inside all limits.") +
           LookWords(m);
  }
  switch (m.state) {
    case MissionState::kProposed:
      return "Click a letter or a row, or press Tab and Enter, to select.";
    case MissionState::kSearch:
      if (!m.search_stopped.empty()) {
        return m.search_stopped + ": no site is proposed.";
      }
      return "Selectable once one site has led for " +
             Duration(snap.session->settings.mission.propose_after_s) + "." + LookWords(m);
    default:
      return "No site can be selected now.";
  }
}

std::string NextSiteLetter(const EngineSnapshot& snap) {
  if (!snap.flight->mission.armed || !snap.terrain->applied) {
    return {};
  }
  for (const LandingSite& site : snap.terrain->applied->selection.sites) {
    if (site.id != snap.flight->mission.armed->id && IsNamedSite(site.id) && IsReached(site) &&
        IsInView(site) && !snap.flight->mission.IsRefused(site.id)) {
      return site.letter;
    }
  }
  return {};
}

}  // namespace palace
