// What the alarms look at, out of the mission's memory and the inputs of this step.
#include <cmath>

#include "engine/mission/alarms/alarms.h"
#include "engine/mission/descent_limits.h"
#include "engine/mission/geometry.h"
#include "engine/mission/wave_off.h"
#include "engine/mission/wording.h"
#include "engine/model/mission/landed_place.h"
#include "engine/model/wind.h"

namespace palace {
namespace {

/// Laser and stereo are compared only while neither is known to be wrong for another reason: that
/// reason has an alarm of its own.
bool ComparesRanges(const AlarmFacts& f) {
  return !f.laser.lies() && !f.pictures.frozen() && !f.pictures.blank() && !f.pictures.swapped &&
         std::isnan(f.image_time_ms);
}

/// Of the camera that is off by more; NaN while the motion shows neither.
double ImageOffset(const NavigationStatus& navigation) {
  return std::fmax(std::abs(navigation.image_time_left.offset_s),
                   std::abs(navigation.image_time_right.offset_s));
}

void FillSensors(const MissionMemory& m, const MissionInputs& in, AlarmFacts& f) {
  const Timestamp now = in.session.now;
  f.silence_s = std::fmin(std::fmin(f.link_age_s, f.pose_age_s),
                          std::fmin(f.left_camera_age_s, f.right_camera_age_s));
  f.clock_stepped = m.watch.clock_stepped();
  f.clock_step_s = m.watch.clock_step_s();
  f.since_clock_step_s = m.watch.SinceClockStep(now);
  f.stalled_s = m.watch.SinceStall(now) <= AlarmLimits::told_s ? m.watch.stalled_s() : NAN;
  f.lost_percent = 100 * LostShare(in.vehicle.channels);
  f.unusual_settings = m.facts.unusual_settings;
  f.losers = LosersWords(in.vehicle.channels);
  f.rebooted = m.watch.rebooted();
  f.gps_error_m = m.watch.gps() ? 3 * m.watch.gps()->sigma_horizontal_m : NAN;
  f.pictures = m.pictures.standing();
  const ChannelHealth* gps = FindChannel(in.vehicle.channels, ChannelId::kGps);
  f.gps_age_s = gps != nullptr ? gps->age_s : NAN;
  if (m.status.state != MissionState::kLanded) {  // it stands: the prediction means nothing more
    f.gps_agreement = in.navigation.navigation.gps_agreement;
  }
  f.laser = in.navigation.navigation.laser;
  const auto& vehicle = m.watch.vehicle();
  if (vehicle && !vehicle->on_ground) {
    f.energy_min = m.status.energy.lasts_s / 60;
    f.energy_percent = 100 * m.status.energy.share;
  }
  f.energy_reserve_min = m.facts.settings.mission.energy_reserve_s / 60;
  const ImageTime* wrong_time = in.navigation.navigation.WrongImageTime();
  f.image_time_ms = wrong_time != nullptr ? 1000 * std::abs(wrong_time->offset_s) : NAN;
  f.image_time = words::ImageTimeOff(in.navigation.navigation);
  f.exposure_ratio = in.navigation.stereo.exposure_ratio;
  f.reads_far = in.navigation.range_agreement.ratio > 1;
  f.laser_mismatch_m = ComparesRanges(f) ? LaserMismatch(in) : NAN;
}

/// Of the approach as it was armed: the wind may have turned since. NaN where none is to be flown
/// any more, and while the wind is unknown or comes from nowhere.
double Tailwind(const MissionMemory& m, Timestamp now) {
  const MissionState state = m.status.state;
  const bool ahead = state == MissionState::kArmed || state == MissionState::kApproved ||
                     (state == MissionState::kDescending && !IsCommitted(m));
  const double wind_mps = KnownWind(m, now);
  if (!ahead || !m.status.approach || !WindHasDirection(wind_mps)) {
    return NAN;
  }
  return -wind_mps * std::cos(m.status.approach->heading_rad - m.watch.vehicle()->wind_from_rad);
}

void FillMission(const MissionMemory& m, const MissionInputs& in, AlarmFacts& f) {
  const Timestamp now = in.session.now;
  const MissionState state = m.status.state;
  const TerrainDecision* decision = in.terrain.decision;
  f.approve_ahead = state <= MissionState::kArmed;
  f.letter = m.status.armed ? m.status.armed->letter : "?";
  f.why = m.status.why;
  f.wave_off = WaveOffNow(m, now);
  f.alternative = SiteLost(m, now) ? words::Alternative(m) : "";
  f.site_degraded = (IsFlying(state) || state == MissionState::kArmed) &&
                    m.site.VerdictAt(now) == SiteVerdict::kDegraded &&
                    !(state == MissionState::kDescending && IsCommitted(m));
  f.site_reason = m.site.reason();
  f.not_on_site = state == MissionState::kLanded && MissedSite(m.status);
  f.no_site = decision != nullptr && decision->selection.sites.empty() &&
              !decision->selection.waits && state <= MissionState::kProposed;
  f.no_site_reason = decision != nullptr ? decision->selection.none_reason : "";
  f.tracked = WatchesSite(m) && m.facts.tracker_locked;
  // Near the ground features leave the picture one after the other: fewer are left to agree.
  f.trackers_apart = f.tracked && !f.committed ? m.facts.trackers_apart : "";
  f.coherence = m.facts.coherence;
  f.min_coherence = m.facts.settings.tracking.min_coherence;
  const bool waiting = state == MissionState::kApproved &&
                       m.status.approval_phase == MissionStatus::ApprovalPhase::kSent;
  f.tailwind_mps = Tailwind(m, now);
  f.max_tailwind_mps = m.facts.settings.mission.max_tailwind_mps;
  f.waiting_s = waiting ? SecondsBetween(m.approved_at, now) : NAN;
  f.refusal = m.refusal;
  f.foreign = in.session.authority.foreign;
  const bool other = in.session.authority.standing == AuthorityStanding::kOther;
  f.view_only = other ? in.session.authority.why_not : "";
  f.foreign_descent =
      state < MissionState::kHold && !FollowsRecord(in.session.role) && FliesForeignApproval(m);
}

/// The rows that people see are the ones that raise the alarms.
void FillFromLimits(const MissionMemory& m, Timestamp now, AlarmFacts& f) {
  const auto take = [&](LimitId id, double& value, double* limit = nullptr) {
    const LimitRow* row = FindLimit(m.status.limits, id);
    if (row != nullptr && row->enforced_by == EnforcedBy::kAlarm) {
      value = row->value;
      if (limit != nullptr) {
        *limit = row->limit;
      }
    }
  };
  take(LimitId::kOffPath, f.off_path_m);
  take(LimitId::kFromCentre, f.off_centre_m, &f.nav_error_m);
  take(LimitId::kDescentRate, f.descent_rate_mps, &f.max_descent_rate_mps);
  take(LimitId::kResidual, f.residual_sigma, &f.max_residual_sigma);
  take(LimitId::kWind, f.wind_mps, &f.max_wind_mps);
  // In a hover a guard refuses by it: a person is to know before the hold is pressed.
  const auto& vehicle = m.watch.vehicle();
  if (f.approve_ahead && vehicle && !vehicle->on_ground) {
    f.wind_mps = KnownWind(m, now);
    f.max_wind_mps = m.facts.settings.mission.max_wind_mps;
  }
  take(LimitId::kExposure, f.exposure_factor);
  // These two are over only when it is not by chance.
  const LimitRow* scale = FindLimit(m.status.limits, LimitId::kRangeScale);
  f.scale_error_percent =
      scale != nullptr && scale->over && ComparesRanges(f) ? 100 * scale->value : NAN;
  const LimitRow* rows = FindLimit(m.status.limits, LimitId::kRowError);
  f.row_error_px = rows != nullptr && rows->over ? rows->value : NAN;
}

}  // namespace

AlarmFacts HoldFactsAt(const MissionMemory& m, Timestamp now) {
  AlarmFacts f;
  f.state = m.status.state;
  const bool descends = f.state == MissionState::kDescending;
  f.committed = descends && IsCommitted(m);
  f.left_camera_age_s = m.watch.LeftCameraAge(now);
  f.right_camera_age_s = m.watch.RightCameraAge(now);
  f.pose_age_s = m.watch.PoseAge(now);
  f.link_age_s = m.watch.LinkAge(now);
  f.pair_age_s = m.watch.PairAge(now);
  f.attitude_invalid_s = m.watch.PosesInvalidFor(now);
  f.invalid_for_s = std::isnan(f.attitude_invalid_s) ? 0 : f.attitude_invalid_s;
  f.ground_age_s = descends && !f.committed ? SecondsBetween(m.ground_seen_at, now) : NAN;
  f.image_offset_ms = 1000 * ImageOffset(m.facts.navigation);
  f.gravity = m.facts.navigation.gravity;
  f.tilt_deg = f.gravity.tilt_deg;
  f.on_vision = m.facts.navigation.OnVision();
  f.vision_outage_s = descends && f.on_vision ? SecondsBetween(m.vision_good_at, now) : NAN;
  f.max_vision_outage_s = m.facts.settings.mission.max_vision_outage_s;
  const bool unconfirmed =
      m.status.approval && m.status.approval->provisional && !m.armed.confirmed;
  f.unconfirmed_height_m = descends && unconfirmed ? HeightAboveSite(m) : NAN;
  const bool nearly_down = f.committed && HeightAboveSite(m) < DescentLimits::last_height_m;
  f.beside_m = nearly_down ? TouchdownMiss(m).value_or(NAN) : NAN;
  f.most_beside_m = DescentLimits::grave_share * m.facts.settings.slad.lander.nav_error_m;
  return f;
}

AlarmFacts AlarmFactsAt(const MissionMemory& m, const MissionInputs& in) {
  AlarmFacts f = HoldFactsAt(m, in.session.now);
  f.has_source = HasSource(in.session.role);
  f.has_vehicle = HasVehicle(in.session.role);
  f.pictures_only = HasPicturesOnly(in.session.role);
  f.heard_vehicle = m.watch.heard_vehicle();
  f.recorder_ok = in.session.recorder_ok;
  f.record = in.session.record;
  f.engine_stop = in.session.engine_stop;
  f.source_damage = in.session.source_damage;
  f.losses = m.losses.recent();
  f.refused_hz = f.losses.refused_hz;
  f.bus_load = f.losses.bus_load;
  f.looked_at_hz = f.losses.replaced_hz > 0 ? f.losses.pairs_hz : NAN;
  FillSensors(m, in, f);
  FillMission(m, in, f);
  FillFromLimits(m, in.session.now, f);
  return f;
}

}  // namespace palace
