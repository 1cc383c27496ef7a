#include "engine/mission/guards.h"

#include <algorithm>
#include <array>

#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/mission/descent_limits.h"
#include "engine/mission/watch/loss_watch.h"
#include "engine/mission/wording.h"

namespace palace {
namespace {

/// Checks that compare with the moment of selection have nothing to compare without one.
bool NothingArmed(const GuardInputs& in) { return in.site_letter.empty(); }

std::string If(bool fails, const char* why) { return fails ? why : ""; }

std::string WhyCamerasBad(const GuardInputs& in, const Limit& limit) {
  for (const auto& [camera, age_s] : {std::pair{"Left camera", in.left_camera_age_s},
                                      std::pair{"Right camera", in.right_camera_age_s}}) {
    std::string why = words::Older(camera, age_s, limit.value);
    if (!why.empty()) {
      return why;
    }
  }
  std::string why = words::Older("Stereo pair", in.pair_age_s, limit.value);
  return why.empty() ? in.camera_problem : why;
}

/// A laser that lies is worse than none: without one stereo's heights do from high enough.
std::string WhyNoHeight(const GuardInputs& in) {
  if (in.laser.lies()) {
    return words::LaserFault(in.laser);
  }
  const bool lost =
      in.laser.state == LaserHealth::State::kLost || in.laser.state == LaserHealth::State::kNever;
  return lost && !(in.height_m >= GuardLimits::laser_height_m)
             ? words::LaserFault(in.laser) + WithNumbers("; height %.1f m, min ", in.height_m) +
                   LimitWords({GuardLimits::laser_height_m, "m"}) + " without it"
             : "";
}

std::string WhyNotPositioned(const GuardInputs& in, const Limit& limit) {
  if (!in.position_healthy) {
    return "Position estimate not healthy";
  }
  if (!in.gps.empty()) {
    return in.gps;
  }
  if (NothingArmed(in)) {
    return in.laser.lies() ? words::LaserFault(in.laser) : words::kSelectFirst;
  }
  if (const std::string why = WhyNoHeight(in); !why.empty()) {
    return why;
  }
  if (!in.tracker_locked) {
    return "Tracker not locked" + (in.why_not_locked.empty() ? "" : ": " + in.why_not_locked);
  }
  return in.coherence >= limit.value
             ? ""
             : WithNumbers("Coherence %.2f, min ", ShownBeyond(in.coherence, limit.value, 2)) +
                   LimitWords(limit);
}

std::string WhyNotShown(const GuardInputs& in, const Limit& limit) {
  if (NothingArmed(in)) {
    return words::kSelectFirst;
  }
  const double shown_s = std::isfinite(in.shown_for_s) ? in.shown_for_s : 0;
  return shown_s >= limit.value
             ? ""
             : WithNumbers("Site on screen for %.1f s, min ", TenthsDown(shown_s)) +
                   LimitWords(limit);
}

std::string WhySiteLost(const GuardInputs& in, const Limit&) {
  if (in.site_holds) {
    return {};
  }
  if (NothingArmed(in)) {
    return words::kSelectFirst;
  }
  return in.site_reason.empty() ? words::OffTheMap(in.site_letter) : in.site_reason;
}

std::string WhyVehicleChanged(const GuardInputs& in, const Limit&) {
  if (!in.clock_continuous) {
    return "Vehicle clock stepped or is not yet known";
  }
  if (NothingArmed(in)) {
    return words::kSelectFirst;
  }
  return If(!in.boot_unchanged, "Vehicle restarted or is unknown");
}

std::string WhyNotCommanding(const GuardInputs& in, const Limit&) {
  if (!in.can_transmit) {
    return "No link to a vehicle";
  }
  if (!in.commands) {
    return in.why_not_commanding.empty() ? "This station does not command the vehicle"
                                         : in.why_not_commanding;
  }
  return If(in.foreign_approval, "Vehicle executes an approval that is not ours");
}

std::string WhyNotInTime(const GuardInputs& in, const Limit& limit) {
  if (!std::isfinite(in.armed_for_s)) {
    return words::kSelectFirst;
  }
  if (in.armed_for_s < limit.value) {
    return WithNumbers("Site selected %.1f s ago, min ", in.armed_for_s) + LimitWords(limit);
  }
  return If(!(in.armed_for_s <= in.arm_window_s), words::kArmWindowOver);
}

std::string WhyWindy(const GuardInputs& in, const Limit& limit) {
  return WindLimit(in.wind_mps, limit.value, EnforcedBy::kGuard).over
             ? WithNumbers("Wind %.1f m/s, max ", ShownBeyond(in.wind_mps, limit.value, 1)) +
                   LimitWords(limit)
             : "";
}

const std::array<GuardRow, kGuardCount> kGuards = {{
    {.id = GuardId::kLink,
     .words = "Vehicle link fresh",
     .of_station = true,
     .limit = {GuardLimits::link_s, "s"},
     .why =
         [](const GuardInputs& in, const Limit& limit) {
           std::string why = words::Older("Vehicle status", in.link_age_s, limit.value);
           return why.empty() && 100 * in.lost_share > GuardLimits::lost_percent
                      ? LossWords(in.lost_share, LimitWords({GuardLimits::lost_percent, "%", 0}),
                                  in.losers)
                      : why;
         }},
    {.id = GuardId::kAttitude,
     .words = "Attitude fresh and right",
     .limit = {GuardLimits::pose_s, "s"},
     .why =
         [](const GuardInputs& in, const Limit& limit) {
           const std::string old = words::Older("Vehicle pose", in.pose_age_s, limit.value);
           return in.attitude_invalid      ? "Attitude invalid"
                  : !old.empty()           ? old
                  : !in.image_time.empty() ? in.image_time
                                           : in.gravity;
         }},
    {.id = GuardId::kCameras,
     .words = "Both cameras fresh and right",
     .limit = {GuardLimits::camera_s, "s"},
     .why = WhyCamerasBad},
    {.id = GuardId::kMap,
     .words = "Newest map fresh",
     .limit = {GuardLimits::map_s, "s"},
     .why = [](const GuardInputs& in,
               const Limit& limit) { return words::Older("Map", in.map_age_s, limit.value); }},
    {.id = GuardId::kPosition,
     .words = "Position and tracker healthy",
     .limit = {NAN, "", 2},
     .limit_from = &GuardInputs::min_coherence,
     .why = WhyNotPositioned},
    {.id = GuardId::kShown,
     .words = "Site was on screen",
     .limit = {GuardLimits::shown_s, "s"},
     .why = WhyNotShown},
    {.id = GuardId::kUnchanged,
     .words = "Limits and calibration unchanged",
     .why =
         [](const GuardInputs& in, const Limit&) {
           return NothingArmed(in) ? std::string(words::kSelectFirst)
                  : !in.lander_problem.empty()
                      ? in.lander_problem
                      : If(!in.hashes_unchanged,
                           "Limits or calibration changed since the site was selected");
         }},
    {.id = GuardId::kSite, .words = "Site holds on the newest map", .why = WhySiteLost},
    {.id = GuardId::kVehicle, .words = "Vehicle did not restart", .why = WhyVehicleChanged},
    {.id = GuardId::kAuthority,
     .words = "This station commands",
     .of_station = true,
     .why = WhyNotCommanding},
    {.id = GuardId::kWarnings,
     .words = "No warning unacknowledged",
     .why =
         [](const GuardInputs& in, const Limit&) {
           return in.unacknowledged_warning.empty()
                      ? std::string()
                      : "Acknowledge first: " + in.unacknowledged_warning;
         }},
    {.id = GuardId::kRecorder,
     .words = "Recording as asked",
     .of_station = true,
     .why =
         [](const GuardInputs& in, const Limit&) {
           return If(!in.recorder_ok && !in.recorder_loss_acknowledged, "Recording is not running");
         }},
    {.id = GuardId::kSource,
     .words = "Source may be approved on",
     .of_station = true,
     .why = [](const GuardInputs& in, const Limit&) { return in.source_reason; }},
    {.id = GuardId::kInTime,
     .words = "Selected in time",
     .limit = {GuardLimits::arm_to_approve_s, "s"},
     .why = WhyNotInTime},
    {.id = GuardId::kWind,
     .words = "Wind inside limit",
     .of_station = true,
     .limit = {NAN, "m/s"},
     .limit_from = &GuardInputs::max_wind_mps,
     .why = WhyWindy},
}};

const GuardRow& RowOf(GuardId id) { return kGuards[static_cast<std::size_t>(id)]; }

}  // namespace

std::span<const GuardRow> GuardTable() { return kGuards; }

Limit LimitOf(const GuardRow& row, const GuardInputs& in) {
  Limit limit = row.limit;
  limit.value = row.limit_from != nullptr ? in.*row.limit_from : limit.value;
  return limit;
}

std::vector<GuardResult> EvaluateGuards(const GuardInputs& in) {
  std::vector<GuardResult> guards;
  for (const GuardRow& row : kGuards) {
    std::string why = row.why(in, LimitOf(row, in));
    guards.push_back({row.id, row.words, why.empty(), std::move(why)});
  }
  return guards;
}

const GuardResult* FirstFailure(const std::vector<GuardResult>& guards, bool as_recorded) {
  const auto failed = std::find_if(guards.begin(), guards.end(), [&](const GuardResult& guard) {
    return !guard.pass && !(as_recorded && RowOf(guard.id).of_station);
  });
  return failed == guards.end() ? nullptr : &*failed;
}

const GuardResult* FindGuard(const std::vector<GuardResult>& guards, GuardId id) {
  const auto found = std::find_if(guards.begin(), guards.end(),
                                  [&](const GuardResult& result) { return result.id == id; });
  return found == guards.end() ? nullptr : &*found;
}

}  // namespace palace
