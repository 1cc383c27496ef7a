#include "engine/mission/alarms/alarm_words.h"

#include "engine/mission/wording.h"

namespace palace {
namespace {

bool IsOld(double age_s) { return !(age_s <= StaleLimits::sensor_s); }

/// Nothing of it where no vehicle can be stopped, or so low that nothing is.
std::string Outside(const AlarmFacts& f) {
  if (!f.has_vehicle) {
    return f.pictures_only ? "Maps stand still." : "In the record.";
  }
  if (!f.committed) {
    return {};
  }
  return f.on_vision ? "Without vision the vehicle stops, and climbs after " +
                           LimitWords({f.max_vision_outage_s, "s"}) + "."
                     : "So low the descent goes on.";
}

std::string Consequence(const AlarmFacts& f, const std::string& after) {
  const std::string outside = Outside(f);
  return !outside.empty()                       ? outside
         : f.state == MissionState::kDescending ? "Descent holds" + after
         : f.state == MissionState::kApproved   ? "Approval ends" + after
         : f.state == MissionState::kArmed      ? "Approve is blocked, the selection ends" + after
                                                : "Approve is blocked.";
}

}  // namespace

std::string StaleConsequence(const AlarmFacts& f) {
  return Consequence(f, " after " + LimitWords({StaleLimits::sensor_s, "s", 0}) + ".");
}

std::string StopConsequence(const AlarmFacts& f, double after_s) {
  return Consequence(f, " after " + LimitWords({after_s, "s"}) + ".");
}

std::string StopConsequence(const AlarmFacts& f) { return Consequence(f, "."); }

std::string StaleText(const char* what, double age_s, const std::string& limit) {
  return what + (" " + words::Age(age_s)) + ", limit " + limit + ". ";
}

bool IsSilent(const AlarmFacts& f) {
  return f.heard_vehicle && IsOld(f.link_age_s) && IsOld(f.pose_age_s) &&
         IsOld(f.left_camera_age_s) && IsOld(f.right_camera_age_s);
}

const char* LinkWords(const AlarmFacts& f) { return IsSilent(f) ? "Vehicle" : "Vehicle status"; }

}  // namespace palace
