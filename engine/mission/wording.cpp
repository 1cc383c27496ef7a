#include "engine/mission/wording.h"

#include <cctype>
#include <cmath>
#include <numbers>

#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/mission/limits.h"
#include "engine/model/cell_explanation.h"
#include "engine/model/mission/alarm_text.h"
#include "engine/model/mission/approve_offer.h"
#include "engine/model/site_standing.h"

namespace palace::words {
namespace {

std::string Site(const std::string& letter) { return "Site " + letter; }

std::string ConfirmHeight() { return LimitWords({GuardLimits::confirm_height_m, "m", 0}); }

}  // namespace

std::string Commands(const std::string& fingerprint) {
  return "This station commands the vehicle, key " + fingerprint;
}
std::string ForeignCommand(const ForeignTraffic& foreign) {
  return "Foreign command from " + (foreign.from.empty() ? "an unknown sender" : foreign.from) +
         ": " + foreign.what + ", " + std::to_string(foreign.count) + " in all";
}
std::string AskedForCommand(const AskForCommand& action, const std::string& holder) {
  return action.take_over && !holder.empty() ? "Asked to take command over from " + holder
                                             : "Asked for command of the vehicle";
}
std::string CommandLostTo(const std::string& why) { return "Command lost: " + why; }
std::string VehicleAborts(const std::string& reason) {
  return reason.empty() ? kVehicleAborts : kVehicleAborts + (": " + reason);
}

std::string Because(const std::string& what, std::string why) {
  why.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(why.front())));
  return what + " (" + why + ")";
}

std::string VehicleHolds(const std::string& reason) {
  return reason.empty() ? kVehicleHolds : kVehicleHolds + (": " + reason);
}

std::string Acknowledged(const std::string& text) { return "Acknowledged: " + AlarmSubject(text); }
std::string NotStanding(const std::string& text) {
  return text.empty() ? "No such alarm stands"
                      : "\"" + AlarmSubject(text) + "\" does not stand any more";
}
std::string AlarmOver(const Alarm& alarm, Timestamp now) {
  return WithNumbers("Over after %.1f s: ", SecondsBetween(alarm.since, now)) +
         AlarmSubject(alarm.text);
}

std::string CannotSelectIn(MissionState state) {
  return std::string("No site can be selected in state ") + MissionStateWord(state);
}

std::string CannotGoIn(MissionState state) {
  return std::string("Nowhere is flown to in state ") + MissionStateWord(state);
}

std::string SentTo(const Eigen::Vector3d& way_W, double heading_rad, double unseen_m,
                   const char* who) {
  constexpr double kTold_m = 0.5;
  const double far_m = way_W.head<2>().norm(), up_m = -way_W.z();
  std::vector<std::string> parts;
  if (far_m >= kTold_m) {
    parts.push_back(WithNumbers("%.1f m ", far_m) +
                    DirectionWord(std::atan2(way_W.y(), way_W.x())));
  }
  if (up_m >= kTold_m) {
    parts.push_back(WithNumbers("%.1f m up", up_m));
  }
  const long degrees = (std::lround(Deg(WrapAngle(heading_rad))) + 360) % 360;
  parts.push_back(WithNumbers("to look along %03.0f°", static_cast<double>(degrees)));
  if (unseen_m >= kTold_m) {
    parts.push_back(WithNumbers("over %.1f m of ground that no map showed", unseen_m));
  }
  return "Sent " + Joined(parts) + ", by " + who;
}

namespace {

/// "NW".
const char* CompassPoint(double bearing_rad) {
  constexpr const char* kPoints[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  const long eighth = std::lround(WrapAngle(bearing_rad) / Rad(45));
  return kPoints[(eighth + 8) % 8];
}

}  // namespace

std::string WayInShort(const Eigen::Vector3d& way_W, double turn_rad) {
  constexpr double kTold_m = 0.5;
  const double far_m = way_W.head<2>().norm(), up_m = -way_W.z();
  if (far_m >= kTold_m) {
    return WithNumbers("%.0f m ", far_m) + CompassPoint(std::atan2(way_W.y(), way_W.x()));
  }
  if (up_m >= kTold_m) {
    return WithNumbers("up %.0f m", up_m);
  }
  const double degrees = std::round(std::abs(Deg(turn_rad)));
  return (degrees >= 180 ? "round "
          : turn_rad < 0 ? "left "
                         : "right ") +
         WithNumbers("%.0f°", degrees);
}

std::string NotTheArmedOne(const MissionStatus& status) {
  return "Selected is " + SiteName(status) + ", not the site that was asked for";
}

std::string Age(double age_s) {
  return std::isfinite(age_s) ? WithNumbers("stale, %.1f s", age_s) : "never received";
}

std::string Older(const char* what, double age_s, double limit_s) {
  return age_s <= limit_s ? std::string() : std::string(what) + " " + Age(age_s);
}

std::string Approved(const MissionStatus& status) {
  return (status.IsLook() ? "a look at " : "") + SiteName(status);
}

std::string SiteName(const MissionStatus& status) {
  return status.armed ? std::string("site ") + status.armed->letter : std::string("the site");
}

std::string SiteSelected(const std::string& letter) { return Site(letter) + " selected"; }

std::string SelectionEnded(std::string_view site, std::string_view why) {
  return "Selection of " + std::string(site) + " ended: " + std::string(why) + ".";
}

std::string DescentStopped(const MissionStatus& status, std::string_view why) {
  return (status.IsLook() ? "Look at " : "Landing on ") + SiteName(status) +
         " stopped: " + std::string(why) + ".";
}

std::string SiteWon(const std::string& letter, int maps) {
  return Site(letter) + " won " + std::to_string(maps) + " maps";
}

std::string SiteLeads(const std::string& letter) {
  return Site(letter) + " leads, not for long enough yet";
}

std::string SiteRefused(const std::string& letter) { return Site(letter) + " refused"; }

std::string RefusedAndNext(const std::string& letter, const LandingSite* next) {
  return SiteRefused(letter) +
         (next != nullptr ? std::string(", next is ") + next->letter : ", no other site");
}

std::string SiteTold(const MissionMemory& m, SiteVerdict verdict) {
  const std::string name = Site(m.status.armed->letter);
  switch (verdict) {
    case SiteVerdict::kHolds:
      return name + " holds again";
    case SiteVerdict::kDegraded:
      return name + " degraded: " + m.site.reason();
    case SiteVerdict::kLost:
      break;
  }
  return name + " lost: " + m.site.reason() + ". " + Alternative(m);
}

std::string SiteConfirmed(const std::string& letter, double height_m) {
  return Site(letter) + " confirmed" +
         (std::isnan(height_m) ? "" : WithNumbers(", %.1f m above it", height_m));
}

std::string Alternative(const MissionMemory& m) {
  if (!m.alternative) {
    return "No alternative is kept.";
  }
  return std::string("Alternative: site ") + m.alternative->letter + ", " +
         ClearWords(*m.alternative) + ".";
}

std::string OffTheMap(const std::string& letter) {
  return Site(letter) + " is not on the newest map";
}

std::string NotConfirmed(const std::string& letter) {
  return Site(letter) + " is not confirmed by " + ConfirmHeight() + " above it";
}

std::string ConfirmHigher(const std::string& letter) {
  return Site(letter) + " is provisional, confirm it above " + ConfirmHeight();
}

std::string LookFromAbove(const std::string& why) { return why + ": wave off to look from above"; }

std::string NothingToLookAt(const std::string& letter) {
  return "No height is known from which site " + letter + " would be sure";
}

std::string LookedAt(const MissionMemory& m, double height_m) {
  const std::string found = m.armed.confirmed         ? "confirmed"
                            : m.site.newest().holds() ? "not confirmed yet"
                                                      : m.site.newest().reason;
  return Site(m.status.armed->letter) +
         WithNumbers(" was looked at from %.1f m above it: ", height_m) + found;
}

std::string ApproachBlocked(const std::string& letter, bool round_unseen) {
  return std::string("Approach to site ") + letter + " is blocked" +
         (round_unseen ? ", and under the ways round it ground was not looked at: look there first"
                       : "");
}

std::string InApproach(const std::optional<ApproachObstacle>& obstacle) {
  using Kind = ApproachObstacle::Kind;
  if (!obstacle) {
    return "Something stands in the approach";
  }
  const double top_m = obstacle->top_m;
  std::string what;
  switch (obstacle->kind) {
    case Kind::kOnLevelWay:
      return "Something on the level way to the approach is as high as the vehicle";
    case Kind::kThin:
      what = "A thin structure " +
             (std::isfinite(top_m) ? WithNumbers("%.1f m up", top_m) : "of unknown height") +
             " hangs";
      break;
    case Kind::kStands:
      what = WithNumbers("Something %.1f m high stands", top_m);
      break;
  }
  return what + " in the approach, " + WithNumbers("%.1f m ", obstacle->distance_m) +
         DirectionWord(obstacle->bearing_rad) + " of the site";
}

std::string ApproachTurned(const std::optional<ApproachPlan>& plan) {
  if (!plan || !plan->turned()) {
    return {};
  }
  return std::string(", approached from the ") +
         DirectionWord(plan->heading_rad + std::numbers::pi) + ": the straight way is blocked";
}

std::string ApproachTurnedBy(const MissionStatus& status, const char* who) {
  const ApproachPlan& plan = *status.approach;
  return "Approach of " + SiteName(status) + " turned by " + who + ": " +
         (plan.turned() ? "from the " : "straight, from the ") +
         DirectionWord(plan.heading_rad + std::numbers::pi);
}

std::string ApprovalGiven(const MissionStatus& status, const SladSettings& limits,
                          std::uint64_t counter) {
  return "Approval " + std::to_string(counter) + " of " + Approved(status) +
         (status.IsLook() ? WithNumbers(" from %.0f m above it", status.stop_height_m)
                          : StandingMark(status, limits)) +
         " given";
}

std::string ApprovedBy(const char* who) {
  return std::string("Approved by ") + who + ", sent to the vehicle";
}

std::string ApprovalEnded(std::string_view site, std::string_view why) {
  return "Approval of " + std::string(site) + " ended: " + std::string(why);
}

std::string Withdrawn(std::string_view why) { return "Approval withdrawn: " + std::string(why); }

std::string VehicleAccepted(std::string_view site) {
  return "Vehicle accepted the approval of " + std::string(site);
}

std::string VehicleRefusedApproval(std::string_view site, std::string_view why) {
  return "Vehicle refused the approval of " + std::string(site) + ": " + std::string(why);
}

std::string VehicleRefused(std::string_view site, std::string_view why) {
  return "Vehicle refused " + std::string(site) + ": " + std::string(why);
}

std::string Descends(std::string_view site) { return "Vehicle descends to " + std::string(site); }

std::string OnTheGround(std::string_view site) {
  return "Vehicle is on the ground at " + std::string(site);
}

std::string NotAtSite(std::string_view site, double miss_m, double height_m) {
  const std::string above = std::isnan(height_m) ? std::string()
                            : height_m < 0       ? WithNumbers(" and %.1f m below it", -height_m)
                                                 : WithNumbers(" and %.1f m above it", height_m);
  return WithNumbers("Vehicle says it is on the ground, %.1f m from the centre of ", miss_m) +
         std::string(site) + above;
}

std::string WaveOffTold(const WaveOffReport& report) {
  using Phase = WaveOffReport::Phase;
  const bool old = report.age_s > GuardLimits::link_s;
  const std::string ago = WithNumbers(", %.1f s ago.", report.age_s);
  switch (report.phase) {
    case Phase::kNone:
      return ".";
    case Phase::kSent:
      return ". Waiting for the vehicle to confirm.";
    case Phase::kUnanswered:
      return WithNumbers(". No answer from the vehicle for %.1f s.", report.age_s);
    case Phase::kAccepted:
      return ". The vehicle accepted it" + (old ? ago + " Its state does not show it." : ".");
    case Phase::kFlies:
      return old ? ". The vehicle was waving off when it was heard last" + ago
                 : ". Vehicle waves off. When it hovers, confirm \"Wave-off complete\".";
    case Phase::kClimbs:
      return old ? ". The vehicle climbed when it was heard last" + ago
                 : ". Vehicle climbs. When it hovers, confirm \"Wave-off complete\".";
    case Phase::kStands:
      return old ? ". The vehicle said that it is on the ground when it was heard last" + ago
                 : ". Vehicle says that it is on the ground.";
    case Phase::kDone:
      break;
  }
  return old ? ". The vehicle hovered when it was heard last" + ago
             : ". Vehicle hovers. Confirm \"Wave-off complete\" to search again.";
}

std::string GroundNotMeasured(const std::string& letter, double age_s) {
  return "Ground of site " + letter + WithNumbers(" not measured for %.1f s", age_s);
}

std::string VisionLost(double outage_s, double limit_s) {
  return WithNumbers("Vision lost for %.1f s, limit %.1f s", outage_s, limit_s);
}

std::string Beside(std::string_view site, double miss_m, double limit_m) {
  return WithNumbers("%.2f m beside ", ShownBeyond(miss_m, limit_m, 2)) + std::string(site) +
         WithNumbers(", limit %.2f m: nobody judged the ground there", limit_m);
}

}  // namespace palace::words
