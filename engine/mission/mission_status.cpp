// What the mission publishes: guards, geometry and alarms.
#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "engine/mission/descent_limits.h"
#include "engine/mission/mission.h"

namespace palace {
namespace {

constexpr double kMaxGpsError_m = 2.0;
constexpr double kLateVision_s = 0.3;
constexpr double kAnswerLate_s = 2.0;
constexpr double kLaserMismatch_m = 1.0;

__attribute__((format(printf, 1, 2))) std::string Words(const char* format, ...) {
  char text[320];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

bool Flying(MissionState state) {
  return state == MissionState::kApproved || state == MissionState::kDescending;
}

/// Limits of the descent whose alarm asks the operator to act.
struct LimitAlarm {
  LimitId limit;
  const char* alarm;
  const char* advice;
};
constexpr LimitAlarm kLimitAlarms[] = {
    {LimitId::kOffPath, "off_path", "Hold or wave off."},
    {LimitId::kFromCentre, "off_centre", "Wave off unless the ground around is clear."},
    {LimitId::kDescentRate, "descent_rate", "Hold or wave off."},
    {LimitId::kResidual, "vision_residual", "Measurement refused. Watch the estimate."},
    {LimitId::kWind, "wind", "Watch the descent, hold or wave off."},
};

AlarmCondition ConditionOf(const LimitAlarm& alarm, const std::vector<LimitRow>& limits) {
  const LimitRow* row = FindLimit(limits, alarm.limit);
  if (row == nullptr) {
    return {alarm.alarm, AlarmLevel::kCaution, false, ""};
  }
  return {alarm.alarm, AlarmLevel::kCaution, row->over && row->enforced_by == EnforcedBy::kAlarm,
          std::string(row->label) + " " + ValueWords(*row) + ", limit " + LimitWords(*row) + ". " +
              alarm.advice};
}

std::string AgeWords(double age_s) {
  return std::isfinite(age_s) ? Words("stale, %.1f s", age_s) : std::string("never received");
}

}  // namespace

GuardInputs Mission::MakeGuardInputs(Timestamp now) const {
  GuardInputs in = facts_.guards;
  in.link_age_s = watch_.LinkAge(now);
  in.pose_age_s = watch_.PoseAge(now);
  in.left_camera_age_s = watch_.LeftCameraAge(now);
  in.right_camera_age_s = watch_.RightCameraAge(now);
  in.camera_problem = alarms_.IsActive("camera_frozen")     ? "A camera repeats its picture"
                      : alarms_.IsActive("cameras_swapped") ? "Left and right camera look exchanged"
                      : alarms_.IsActive("row_error") ? "Calibration does not fit the pictures"
                                                      : "";
  in.map_age_s =
      facts_.map_hash != 0 && now >= map_seen_at_ ? SecondsBetween(map_seen_at_, now) : NAN;
  in.clock_continuous = watch_.clock_continuous();
  in.wind_mps = KnownWind(now);
  in.foreign_approval = Executing() && !OwnApproval(watch_.vehicle()->approval_id);
  in.unacknowledged_warning = alarms_.UnacknowledgedWarning();
  in.recorder_loss_acknowledged = alarms_.IsAcknowledged("recorder");
  if (facts_.source_kind == SourceKind::kReplay) {
    in.source_reason = "No link in replay";
  } else if (HasPicturesOnly(facts_.source_kind)) {
    in.source_reason = WhyNoVehicle(facts_.source_kind);
  } else if (facts_.source_kind == SourceKind::kNone) {
    in.source_reason = "No data";
  } else if (facts_.source_kind == SourceKind::kSimulation && !facts_.simulated_vehicle) {
    in.source_reason = "This simulation is not labelled so";
  }
  if (!status_.armed) {
    return in;
  }
  if (armed_.first_sequence) {
    in.shown_for_s = SecondsBetween(armed_.shown_since, now);
  }
  in.armed_for_s = SecondsBetween(status_.armed_at, now);
  in.hashes_unchanged = facts_.settings_hash == armed_.settings_hash &&
                        facts_.terrain_settings_hash == armed_.terrain_settings_hash &&
                        facts_.calibration_hash == armed_.calibration_hash;
  in.boot_unchanged = watch_.heard_vehicle() && watch_.boot_id() == armed_.boot_id;
  in.site_letter = status_.armed->letter;
  in.site_holds = site_.evaluated() && site_.newest().holds();
  in.site_reason = site_.newest().reason;
  if (in.site_holds && !site_.newest().approach_clear) {
    // What is approved is the straight way from where the vehicle is.
    in.site_holds = false;
    in.site_reason = Words("Straight approach to site %c is blocked", in.site_letter);
  }
  const double height_m = HeightAboveSite();
  if (in.site_holds && !armed_.confirmed && !(height_m > GuardLimits::confirm_height_m)) {
    in.site_holds = false;
    in.site_reason = Words("Site %c is provisional, confirm it above 10 m", in.site_letter);
  }
  return in;
}

void Mission::Publish(const MissionInputs& in) {
  PublishGeometry(in);
  PublishLimits(in);
  PublishAlarms(in);
  status_.guards = EvaluateGuards(MakeGuardInputs(in.now));
  const GuardResult* failed = FirstFailure(status_.guards);
  status_.can_approve = status_.state == MissionState::kArmed && failed == nullptr;
  status_.cannot_approve_reason.clear();
  if (!status_.can_approve) {
    const bool source = in.source_kind == SourceKind::kReplay || HasPicturesOnly(in.source_kind);
    status_.cannot_approve_reason =
        source
            ? status_.guards[12].reason
            : (Flying(status_.state) ? "Already approved"
                                     : (status_.state != MissionState::kArmed || failed == nullptr
                                            ? "Select a site first"
                                            : failed->reason));
  }
}

double Mission::LaserMismatch(const MissionInputs& in) const {
  const auto& laser = in.bundle.laser;
  if (laser.empty() || !in.bundle.rig || !in.bundle.pose_at_exposure || in.applied == nullptr ||
      !in.applied->elevation) {
    return NAN;
  }
  // Where the beam meets the ground: p_WL = X_WB X_BC [0 0 range].
  const RigidTransform X_WC = in.bundle.pose_at_exposure->X_WB * in.bundle.rig->X_BC();
  const Eigen::Vector3d p_WL = X_WC * Eigen::Vector3d(0, 0, laser.back().range_m);
  const ElevationMap& map = *in.applied->elevation;
  const auto cell = map.geometry.CellFromPoint(p_WL.x(), p_WL.y());
  if (!p_WL.allFinite() || !cell || map.state.empty() ||
      map.state.at(*cell) != CellState::kMeasured) {
    return NAN;
  }
  return std::abs(HeightFromDown(p_WL.z()) - map.height_m.at(*cell));
}

std::vector<AlarmCondition> Mission::SensorAlarms(const MissionInputs& in) const {
  const bool vehicle =
      in.source_kind == SourceKind::kLive || in.source_kind == SourceKind::kSimulation;
  const double left_s = watch_.LeftCameraAge(in.now), right_s = watch_.RightCameraAge(in.now);
  const double pose_s = watch_.PoseAge(in.now), link_s = watch_.LinkAge(in.now);
  const double gps_m = watch_.gps() ? 3 * watch_.gps()->sigma_horizontal_m : NAN;
  const bool on_vision = in.navigation.handover == NavigationStatus::Handover::kVision;
  const double mismatch_m = LaserMismatch(in);
  const bool heard = watch_.heard_vehicle();
  const bool pictures_only = HasPicturesOnly(in.source_kind);
  const char* blocked = pictures_only           ? "Maps stand still."
                        : Flying(status_.state) ? "Descent holds after 1 s."
                                                : "Approve is blocked.";
  const auto over = [&](LimitId id) {
    const LimitRow* row = FindLimit(status_.limits, id);
    return row != nullptr && row->over;
  };
  return {
      {"camera_left", AlarmLevel::kCaution,
       in.source_kind != SourceKind::kNone && !(left_s <= GuardLimits::camera_s),
       "Left camera " + AgeWords(left_s) + ", limit 0.5 s. " + blocked},
      {"camera_right", AlarmLevel::kCaution,
       in.source_kind != SourceKind::kNone && !(right_s <= GuardLimits::camera_s),
       "Right camera " + AgeWords(right_s) + ", limit 0.5 s. " + blocked},
      {"pose", AlarmLevel::kCaution, vehicle && heard && !(pose_s <= GuardLimits::camera_s),
       "Vehicle pose " + AgeWords(pose_s) + ", limit 0.2 s. " + blocked},
      {"no_pose", AlarmLevel::kAdvisory, pictures_only && left_s >= 0 && std::isnan(pose_s),
       "Attitude and height unknown: no map, no sites. Add [pose] to RIG.toml."},
      {"link", link_s > 5 ? AlarmLevel::kWarning : AlarmLevel::kCaution,
       vehicle && heard && !(link_s <= GuardLimits::link_s),
       "Vehicle status " + AgeWords(link_s) + ", limit 1.0 s. The vehicle holds by itself."},
      {"clock", AlarmLevel::kWarning, vehicle && watch_.clock_stepped(),
       "Vehicle clock stepped. The selection is dropped, select again.", true},
      {"reboot", AlarmLevel::kWarning, vehicle && watch_.rebooted(),
       "Vehicle restarted. Every approval is void, select again.", true},
      {"gps_error", AlarmLevel::kCaution, gps_m > kMaxGpsError_m,
       Words("GPS horizontal error %.1f m, limit %.1f m. %s", gps_m, kMaxGpsError_m,
             on_vision ? "Landing on vision, not GPS." : "Vision takes over for the descent.")},
      // A folder repeats its last pair for ever, and a paused film its picture.
      {"camera_frozen", AlarmLevel::kCaution,
       in.stereo.suspect_frozen && !HasPicturesOnly(in.source_kind),
       std::string("A camera repeats its picture to the last grey level. ") + blocked},
      {"cameras_swapped", AlarmLevel::kWarning, in.stereo.suspect_swapped,
       "Left and right camera look exchanged. Exchange the cables or the entries of RIG.toml."},
      {"row_error", AlarmLevel::kCaution, over(LimitId::kRowError),
       Words("Rows of the two pictures are %.2f px apart, limit %.2f px: calibrate.",
             in.stereo.row_error_px, DescentLimits::row_error_px)},
      {"exposure", AlarmLevel::kAdvisory, over(LimitId::kExposure),
       Words("Right picture is %.1f times as bright as the left, limit %.1f to %.1f. Check the "
             "exposure.",
             in.stereo.exposure_ratio, 1 / DescentLimits::exposure_ratio,
             DescentLimits::exposure_ratio)},
      {"range_scale", AlarmLevel::kCaution, over(LimitId::kRangeScale),
       Words(
           "Stereo reads %.1f %% %s against the laser, limit %.0f %%. Focal length or baseline is "
           "wrong: calibrate.",
           100 * std::abs(in.range_agreement.ratio - 1),
           in.range_agreement.ratio > 1 ? "far" : "near", 100 * DescentLimits::range_scale)},
      {"height_mismatch", AlarmLevel::kAdvisory, mismatch_m > kLaserMismatch_m,
       Words("Laser and map disagree by %.1f m, limit %.1f m. Check the cameras.", mismatch_m,
             kLaserMismatch_m)},
      {"recorder", AlarmLevel::kCaution, vehicle && !in.recorder_ok,
       "Recording is not running. Acknowledge to fly without a record."},
      {"log_damaged", AlarmLevel::kAdvisory, !in.source_damage.empty(),
       "The log is cut or damaged: " + std::string(in.source_damage) +
           ". palacectl log verify tells where."},
      {"no_site", AlarmLevel::kAdvisory,
       in.applied != nullptr && in.applied->selection.sites.empty() &&
           status_.state <= MissionState::kProposed,
       "No safe site: " + (in.applied != nullptr ? in.applied->selection.none_reason : "") +
           (pictures_only ? ". Widen a limit." : ". Fly on or widen a limit.")},
  };
}

std::vector<AlarmCondition> Mission::MissionAlarms(const MissionInputs& in) const {
  using Phase = MissionStatus::ApprovalPhase;
  const MissionState state = status_.state;
  const char letter = status_.armed ? status_.armed->letter : '?';
  const bool on_vision = in.navigation.handover == NavigationStatus::Handover::kVision;
  const double outage_s = SecondsBetween(vision_good_at_, in.now);
  const double min_coherence = in.settings.tracking.min_coherence;
  const double waiting_s = SecondsBetween(approved_now_, in.now);
  const bool watched = WantsTracking();
  const bool foreign =
      Executing() && state < MissionState::kHold && !OwnApproval(watch_.vehicle()->approval_id);
  return {
      {"wave_off", AlarmLevel::kWarning, state == MissionState::kAborting,
       std::string("Wave-off: ") + status_.why +
           (abort_seen_ ? ". Vehicle climbs. Acknowledge when it hovers."
                        : ". Waiting for the vehicle to confirm."),
       true},
      {"hold", AlarmLevel::kCaution, state == MissionState::kHold,
       "Descent on hold: " + status_.why + ". " +
           (SiteLost(in.now) ? AlternativeWords() + " " : std::string()) +
           "Select a site again or wave off.",
       true},
      {"site_degraded", AlarmLevel::kCaution,
       Flying(state) && site_.VerdictAt(in.now) == SiteVerdict::kDegraded &&
           HeightAboveSite() >= facts_.commit_height_m,
       Words("Site %c degraded: ", letter) + site_.reason() + ". Watch it, hold or wave off.",
       true},
      {"vision_lost", AlarmLevel::kWarning,
       state == MissionState::kDescending && on_vision && outage_s > kLateVision_s,
       Words("Vision lost for %.1f s, limit %.1f s. The descent holds or climbs.", outage_s,
             facts_.limits.max_vision_outage_s)},
      {"coherence_low", AlarmLevel::kCaution,
       watched && in.tracker.locked && !(in.tracker.coherence >= min_coherence),
       Words("Tracker coherence %.2f, limit %.2f. Watch the site.", in.tracker.coherence,
             min_coherence)},
      {"approval_unanswered", AlarmLevel::kCaution,
       status_.approval_phase == Phase::kSent && state == MissionState::kApproved &&
           waiting_s > kAnswerLate_s,
       Words("Vehicle has not answered the approval for %.0f s, limit 2 s. Wave off or wait.",
             waiting_s)},
      {"approval_refused", AlarmLevel::kCaution, !refusal_.empty(),
       refusal_ + ". Select a site again.", true},
      {"foreign_descent", AlarmLevel::kWarning, foreign && in.source_kind != SourceKind::kReplay,
       "Vehicle flies an approval that is not ours. Wave-off is available."},
  };
}

void Mission::PublishAlarms(const MissionInputs& in) {
  std::vector<AlarmCondition> conditions = SensorAlarms(in);
  for (AlarmCondition& condition : MissionAlarms(in)) {
    conditions.push_back(std::move(condition));
  }
  for (const LimitAlarm& alarm : kLimitAlarms) {
    conditions.push_back(ConditionOf(alarm, status_.limits));
  }
  alarms_.Update(conditions, in.now);
  for (const Alarm& alarm : alarms_.raised()) {
    AddEvent(in.now, EventKind::kAlarm, alarm.text);
  }
  status_.alarms = alarms_.Shown();
}

}  // namespace palace
