// What the guards look at, out of the mission's memory.
#include <algorithm>
#include <cstddef>

#include "engine/mission/descent_limits.h"
#include "engine/mission/geometry.h"
#include "engine/mission/guards.h"
#include "engine/mission/wording.h"
#include "engine/model/settings/sound_settings.h"

namespace palace {
namespace {

/// Above the site. Lower, ground that has left the view comes back from above only.
constexpr double kGroundLeavesView_m = 10;

/// Why this source can never be approved on; empty when it can.
std::string WhyNotThisSource(const MissionFacts& facts) {
  if (!MaySelect(facts.role)) {
    return facts.why_no_vehicle;
  }
  return MustBeLabelled(facts.role) && !facts.simulated_vehicle
             ? "This simulation is not labelled so"
             : "";
}

/// Fills what speaks of the armed site.
void JudgeArmedSite(const MissionMemory& m, Timestamp now, GuardInputs& in) {
  const ArmedFacts& armed = m.armed;
  if (armed.first_sequence) {
    in.shown_for_s = SecondsBetween(armed.shown_since, now);
  }
  in.armed_for_s = SecondsBetween(m.status.armed_at, now);
  in.lander_problem = WhyNotLandable(m.facts.settings.slad.lander);
  in.hashes_unchanged = m.facts.settings_hash == armed.settings_hash &&
                        m.facts.terrain_settings_hash == armed.terrain_settings_hash &&
                        m.facts.calibration_hash == armed.calibration_hash;
  in.boot_unchanged = m.watch.heard_vehicle() && m.watch.boot_id() == armed.boot_id;
  in.site_letter = m.status.armed->letter;
  in.site_holds = m.site.evaluated() && m.site.newest().holds();
  in.site_reason = m.site.newest().reason;
  const auto& vehicle = m.watch.vehicle();
  if (vehicle && vehicle->on_ground) {
    in.site_holds = false;
    in.site_reason = "Vehicle on the ground: a descent begins in a hover";
    return;
  }
  if (in.site_holds && !m.site.newest().old_ground.empty()) {
    in.site_holds = false;
    in.site_reason = m.site.newest().old_ground;
    if (HeightAboveSite(m) < kGroundLeavesView_m) {
      in.site_reason = words::LookFromAbove(in.site_reason);
    }
  }
  if (in.site_holds && !armed.air_shown && !m.site.newest().low_air.empty()) {
    in.site_holds = false;
    in.site_reason = m.site.newest().low_air + ": look from higher up";
  }
  if (in.site_holds && !m.site.newest().approach_clear) {
    // What is approved is the way that is planned.
    in.site_holds = false;
    const LandingSite& newest = m.newest ? *m.newest : *m.status.armed;
    in.site_reason =
        words::ApproachBlocked(in.site_letter, newest.clear_approaches != 0 &&
                                                   OverSeenGround(m, newest).clear_approaches == 0);
  }
  if (in.site_holds && m.status.area) {
    const std::string why =
        words::WayToSiteLeavesArea(*m.status.area, m.status.way_W, in.site_letter);
    in.site_holds = why.empty();
    in.site_reason = why.empty() ? in.site_reason : why;
  }
  if (in.site_holds && !armed.course_judged) {
    in.site_holds = false;
    in.site_reason = words::kCourseNotJudged;
  }
  if (in.site_holds && !armed.confirmed && !(HeightAboveSite(m) > GuardLimits::confirm_height_m)) {
    in.site_holds = false;
    in.site_reason = words::ConfirmHigher(in.site_letter);
  }
}

}  // namespace

GuardInputs GuardInputsAt(const MissionMemory& m, Timestamp now) {
  GuardInputs in;
  in.link_age_s = m.watch.LinkAge(now);
  in.pose_age_s = m.watch.PoseAge(now);
  in.left_camera_age_s = m.watch.LeftCameraAge(now);
  in.right_camera_age_s = m.watch.RightCameraAge(now);
  in.pair_age_s = m.watch.PairAge(now);
  in.camera_problem = m.pictures.standing().words();
  in.attitude_invalid = std::isfinite(m.watch.PosesInvalidFor(now));
  in.lost_share = m.lost_share;
  in.losers = m.losers;
  in.map_age_s =
      m.facts.map_hash != 0 && now >= m.map_seen_at ? SecondsBetween(m.map_seen_at, now) : NAN;
  in.position_healthy = m.facts.position_healthy;
  in.image_time = words::ImageTimeOff(m.facts.navigation);
  in.gravity = words::GravityOff(m.facts.navigation.gravity);
  in.gps = words::GpsOff(m.facts.navigation.gps_agreement);
  in.laser = m.facts.navigation.laser;
  in.height_m = HeightAboveSite(m);
  in.tracker_locked = m.facts.tracker_locked;
  in.why_not_locked = m.facts.why_not_locked;
  in.coherence = m.facts.coherence;
  in.min_coherence = m.facts.settings.tracking.min_coherence;
  in.clock_continuous = m.watch.clock_continuous();
  in.can_transmit = m.facts.can_transmit;
  in.commands = m.facts.authority.commands();
  in.why_not_commanding = m.facts.authority.why_not;
  in.foreign_approval = FliesForeignApproval(m);
  in.unacknowledged_warning = m.alarms.UnacknowledgedWarning();
  in.recorder_ok = m.facts.recorder_ok;
  in.recorder_loss_acknowledged = m.alarms.IsAcknowledged(AlarmId::kRecorder);
  in.source_reason = WhyNotThisSource(m.facts);
  in.arm_window_s = m.facts.settings.mission.arm_window_s;
  in.wind_mps = KnownWind(m, now);
  in.max_wind_mps = m.facts.settings.mission.max_wind_mps;
  if (m.status.armed) {
    JudgeArmedSite(m, now, in);
  }
  return in;
}

}  // namespace palace
