#include "engine/mission/alarms/alarms.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/mission/alarms/alarm_words.h"
#include "engine/mission/descent_limits.h"
#include "engine/mission/wording.h"

namespace palace {
namespace {

using Facts = AlarmFacts;

const AlarmRow kRows[] = {
    {.id = AlarmId::kCameraLeft,
     .level = AlarmLevel::kCaution,
     .limit = {GuardLimits::camera_s, "s"},
     .value = &Facts::left_camera_age_s,
     .present = [](const Facts& f,
                   double limit) { return f.has_source && !(f.left_camera_age_s <= limit); },
     .text =
         [](const Facts& f, const std::string& limit) {
           return StaleText("Left camera", f.left_camera_age_s, limit) + StaleConsequence(f);
         },
     .stop =
         [](const Facts& f) {
           return words::Older("Left camera", f.left_camera_age_s, StaleLimits::sensor_s);
         },
     .hold = {LimitId::kLeftCameraAge, "Left camera age", &Facts::left_camera_age_s,
              StaleLimits::sensor_s}},
    {.id = AlarmId::kCameraRight,
     .level = AlarmLevel::kCaution,
     .limit = {GuardLimits::camera_s, "s"},
     .value = &Facts::right_camera_age_s,
     .present = [](const Facts& f,
                   double limit) { return f.has_source && !(f.right_camera_age_s <= limit); },
     .text =
         [](const Facts& f, const std::string& limit) {
           return StaleText("Right camera", f.right_camera_age_s, limit) + StaleConsequence(f);
         },
     .stop =
         [](const Facts& f) {
           return words::Older("Right camera", f.right_camera_age_s, StaleLimits::sensor_s);
         },
     .hold = {LimitId::kRightCameraAge, "Right camera age", &Facts::right_camera_age_s,
              StaleLimits::sensor_s}},
    {.id = AlarmId::kPose,
     .level = AlarmLevel::kCaution,
     .limit = {GuardLimits::pose_s, "s"},
     .value = &Facts::pose_age_s,
     .present =
         [](const Facts& f, double limit) {
           return f.has_vehicle && f.heard_vehicle && !(f.pose_age_s <= limit);
         },
     .text =
         [](const Facts& f, const std::string& limit) {
           return StaleText("Vehicle pose", f.pose_age_s, limit) + StaleConsequence(f);
         },
     .stop =
         [](const Facts& f) {
           return words::Older("Vehicle pose", f.pose_age_s, StaleLimits::sensor_s);
         },
     .hold = {LimitId::kPoseAge, "Vehicle pose age", &Facts::pose_age_s, StaleLimits::sensor_s}},
    {.id = AlarmId::kNoPose,
     .level = AlarmLevel::kAdvisory,
     .present =
         [](const Facts& f, double) {
           return f.pictures_only && f.left_camera_age_s >= 0 && std::isnan(f.pose_age_s);
         },
     .text =
         [](const Facts&, const std::string&) {
           return std::string(
               "Attitude and height unknown: no map, no sites. Add [pose] to RIG.toml.");
         }},
    {.id = AlarmId::kLink,
     .level = AlarmLevel::kCaution,
     .limit = {GuardLimits::link_s, "s"},
     .value = &Facts::link_age_s,
     .present =
         [](const Facts& f, double limit) {
           return f.has_vehicle && f.heard_vehicle && !(f.link_age_s <= limit);
         },
     .text =
         [](const Facts& f, const std::string& limit) {
           return StaleText(LinkWords(f), f.link_age_s, limit) + "It should hold by itself.";
         },
     .grave = [](const Facts& f) { return f.link_age_s > StaleLimits::link_s; },
     .stop =
         [](const Facts& f) {
           return words::Older("Vehicle status", f.link_age_s, StaleLimits::link_s);
         },
     .hold = {.id = LimitId::kStatusAge,
              .label = "Vehicle status age",
              .value = &Facts::link_age_s,
              .limit = StaleLimits::link_s,
              .committed = true}},
    {.id = AlarmId::kGpsError,
     .level = AlarmLevel::kCaution,
     .limit = {AlarmLimits::gps_error_m, "m"},
     .value = &Facts::gps_error_m,
     .present = [](const Facts& f, double limit) { return f.gps_error_m > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("GPS horizontal error %.1f m, limit ", f.gps_error_m) + limit +
                  (f.on_vision ? ". Landing on vision, not GPS."
                               : ". Vision takes over for the descent.");
         }},
    {.id = AlarmId::kCameraFrozen,
     .level = AlarmLevel::kCaution,
     .immediate = true,  // three pairs said so
     .present = [](const Facts& f, double) { return f.pictures.frozen(); },
     .text =
         [](const Facts& f, const std::string&) {
           return f.pictures.frozen_words() + ". " + StopConsequence(f);
         },
     .stop = [](const Facts& f) { return f.pictures.frozen_words(); }},
    {.id = AlarmId::kCamerasSwapped,
     .level = AlarmLevel::kWarning,
     .immediate = true,  // three pairs said so
     .present = [](const Facts& f, double) { return f.pictures.swapped; },
     .text =
         [](const Facts& f, const std::string&) {
           return "Left and right camera look exchanged. " + StopConsequence(f) +
                  " Exchange the cables or the entries of RIG.toml.";
         },
     .stop = [](const Facts& f) -> std::string {
       return f.pictures.swapped ? "Left and right camera look exchanged" : "";
     }},
    {.id = AlarmId::kRowError,
     .level = AlarmLevel::kCaution,
     .immediate = true,  // three pairs said so
     .limit = {AlarmLimits::row_error_px, "px", 2},
     .value = &Facts::row_error_px,
     .present = [](const Facts& f, double limit) { return f.row_error_px > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Rows of the two pictures are %.2f px apart, limit ",
                              f.row_error_px) +
                  limit + ": not calibrated, or not exposed together.";
         }},
    {.id = AlarmId::kExposure,
     .level = AlarmLevel::kAdvisory,
     .limit = {AlarmLimits::exposure},
     .value = &Facts::exposure_factor,
     .present = [](const Facts& f, double limit) { return f.exposure_factor > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Right picture is %.1f times as bright as the left, limit %.1f to ",
                              f.exposure_ratio, 1 / AlarmLimits::exposure) +
                  limit + ". Check the exposure.";
         }},
    {.id = AlarmId::kRangeScale,
     .level = AlarmLevel::kCaution,
     .limit = {AlarmLimits::scale_percent, "%", 0},
     .value = &Facts::scale_error_percent,
     .present = [](const Facts& f, double limit) { return f.scale_error_percent > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Stereo reads %.1f %% ", f.scale_error_percent) +
                  (f.reads_far ? "far" : "near") + " against the laser, limit " + limit +
                  ". Focal length or baseline is wrong: calibrate.";
         }},
    {.id = AlarmId::kHeightMismatch,
     .level = AlarmLevel::kAdvisory,
     .limit = {AlarmLimits::laser_mismatch_m, "m"},
     .value = &Facts::laser_mismatch_m,
     .present = [](const Facts& f, double limit) { return f.laser_mismatch_m > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Laser and map disagree by %.1f m, limit ", f.laser_mismatch_m) +
                  limit + ". Check the cameras.";
         }},
    {.id = AlarmId::kRecorder,
     .level = AlarmLevel::kCaution,
     .present = [](const Facts& f, double) { return f.has_vehicle && !f.recorder_ok; },
     .text =
         [](const Facts& f, const std::string&) {
           const std::string why = f.record.problem.empty() ? "" : ": " + f.record.problem;
           return "Recording is not running" + why + ". Acknowledge to fly without a record.";
         }},
    {.id = AlarmId::kRecordThinned,
     .level = AlarmLevel::kCaution,
     .present = [](const Facts& f,
                   double) { return f.recorder_ok && f.record.pictures_every != 1; },
     .text =
         [](const Facts& f, const std::string&) {
           return "The disk is nearly full: " + ThinningWords(f.record.pictures_every) +
                  WithNumbers(", %.0f min are left", f.record.minutes_left) + ". Free space.";
         }},
    {.id = AlarmId::kEngineStopped,
     .level = AlarmLevel::kWarning,
     .immediate = true,
     .present = [](const Facts& f, double) { return !f.engine_stop.empty(); },
     .text = [](const Facts& f,
                const std::string&) { return f.engine_stop + " Nothing is selected any more."; }},
    {.id = AlarmId::kLogDamaged,
     .level = AlarmLevel::kAdvisory,
     .present = [](const Facts& f, double) { return !f.source_damage.empty(); },
     .text =
         [](const Facts& f, const std::string&) {
           return "The log is cut or damaged: " + f.source_damage +
                  ". palacectl log verify tells where.";
         }},
    {.id = AlarmId::kNoSite,
     .level = AlarmLevel::kAdvisory,
     .of_mission = true,
     .present = [](const Facts& f, double) { return f.no_site; },
     .text =
         [](const Facts& f, const std::string&) {
           return "No safe site: " + f.no_site_reason +
                  (f.pictures_only
                       ? ". The maps show which limit decides."
                       : ". Fly on, or look again from another height or heading; the maps show "
                         "which limit decides.");
         }},
    {.id = AlarmId::kWaveOff,
     .level = AlarmLevel::kWarning,
     .of_mission = true,
     .immediate = true,
     .present = [](const Facts& f, double) { return f.state == MissionState::kAborting; },
     .text =
         [](const Facts& f, const std::string&) {
           return "Wave-off: " + f.why + words::WaveOffTold(f.wave_off);
         }},
    {.id = AlarmId::kHold,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .immediate = true,
     .present = [](const Facts& f, double) { return f.state == MissionState::kHold; },
     .text =
         [](const Facts& f, const std::string&) {
           return "Descent on hold: " + f.why + ". " + f.alternative +
                  (f.alternative.empty() ? "" : " ") +
                  "A site can be selected again when the vehicle has stopped, or wave off.";
         }},
    {.id = AlarmId::kSiteDegraded,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .immediate = true,
     .present = [](const Facts& f, double) { return f.site_degraded; },
     .text =
         [](const Facts& f, const std::string&) {
           return std::string("Site ") + f.letter + " degraded: " + f.site_reason +
                  (f.state == MissionState::kArmed ? ". Look again before you approve."
                                                   : ". Watch it, hold or wave off.");
         }},
    {.id = AlarmId::kVisionLost,
     .level = AlarmLevel::kWarning,
     .of_mission = true,
     .limit = {AlarmLimits::vision_late_s, "s"},
     .value = &Facts::vision_outage_s,
     .present = [](const Facts& f, double limit) { return f.vision_outage_s > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Vision lost for %.1f s, limit ", f.vision_outage_s) + limit +
                  ". The descent holds or climbs after " +
                  LimitWords({f.max_vision_outage_s, "s"}) + ".";
         },
     .hold = {.id = LimitId::kVisionOutage,
              .label = "Vision outage",
              .value = &Facts::vision_outage_s,
              .limit_from = &Facts::max_vision_outage_s,
              .committed = true}},
    {.id = AlarmId::kCoherenceLow,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .limit = {NAN, "", 2},
     .limit_from = &Facts::min_coherence,
     .value = &Facts::coherence,
     .less_is_worse = true,
     .present = [](const Facts& f, double limit) { return f.tracked && !(f.coherence >= limit); },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Tracker coherence %.2f, limit ", f.coherence) + limit +
                  ". Watch the site.";
         }},
    {.id = AlarmId::kApprovalUnanswered,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .limit = {AlarmLimits::answer_s, "s", 0},
     .value = &Facts::waiting_s,
     .present = [](const Facts& f, double limit) { return f.waiting_s > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Vehicle has not answered the approval for %.0f s, limit ",
                              f.waiting_s) +
                  limit + ". Wave off or wait.";
         }},
    {.id = AlarmId::kApprovalRefused,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .immediate = true,
     .present = [](const Facts& f, double) { return !f.refusal.empty(); },
     .text = [](const Facts& f,
                const std::string&) { return f.refusal + ". Select a site again."; }},
    {.id = AlarmId::kForeignDescent,
     .level = AlarmLevel::kWarning,
     .of_mission = true,
     .present = [](const Facts& f, double) { return f.foreign_descent; },
     .text =
         [](const Facts&, const std::string&) {
           return std::string("Vehicle flies an approval that is not ours. Wave-off is available.");
         }},
    {.id = AlarmId::kPicturesReplaced,
     .level = AlarmLevel::kCaution,
     .limit = {AlarmLimits::least_pairs_hz, "Hz"},
     .value = &Facts::looked_at_hz,
     .less_is_worse = true,
     .present = [](const Facts& f,
                   double limit) { return f.has_vehicle && f.looked_at_hz < limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           const std::string seen =
               f.looked_at_hz < 0.05
                   ? "This station is slow: no stereo pair is looked at, limit "
                   : WithNumbers(
                         "This station is slow: %.1f stereo pairs a second are looked at, "
                         "limit ",
                         TenthsDown(f.looked_at_hz));
           return seen + limit +
                  WithNumbers(
                      "; newer ones overtook %.1f a second. Close other programs or make "
                      "fewer maps.",
                      f.losses.replaced_hz);
         }},
    {.id = AlarmId::kUndecodable,
     .level = AlarmLevel::kCaution,
     .present = [](const Facts& f, double) { return f.losses.undecodable > 0; },
     .text =
         [](const Facts& f, const std::string&) {
           return WithNumbers("%.0f messages of the last %.0f s could not be read: ",
                              f.losses.undecodable, LossWatch::kWindow_s) +
                  f.losses.channels + " in all. The sender errs, or the way to it damages bytes.";
         }},
    {.id = AlarmId::kRecordsDropped,
     .level = AlarmLevel::kCaution,
     .present = [](const Facts& f, double) { return f.losses.unrecorded > 0; },
     .text =
         [](const Facts& f, const std::string&) {
           return WithNumbers(
               "%.0f frames of the last %.0f s are not in the record: the disk is "
               "too slow. Free it, or record elsewhere.",
               f.losses.unrecorded, LossWatch::kWindow_s);
         }},
    {.id = AlarmId::kMessagesUnsent,
     .level = AlarmLevel::kCaution,
     .present = [](const Facts& f, double) { return f.losses.unsent > 0; },
     .text =
         [](const Facts& f, const std::string&) {
           return WithNumbers(
               "%.0f messages of the last %.0f s could not be sent. Check the "
               "network link.",
               f.losses.unsent, LossWatch::kWindow_s);
         }},
    {.id = AlarmId::kOffPath,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .limit = {DescentLimits::off_path_m, "m"},
     .value = &Facts::off_path_m,
     .present = [](const Facts& f, double limit) { return f.off_path_m > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Off the path by %.1f m, limit ", f.off_path_m) + limit +
                  ". Hold or wave off.";
         }},
    {.id = AlarmId::kOffCentre,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .limit = {NAN, "m", 2},
     .limit_from = &Facts::nav_error_m,
     .value = &Facts::off_centre_m,
     .present = [](const Facts& f, double limit) { return f.off_centre_m > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Sinks %.2f m off the site's centre, limit ", f.off_centre_m) +
                  limit + ". Wave off unless the ground around is clear.";
         }},
    {.id = AlarmId::kDescentRate,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .limit = {NAN, "m/s", 2},
     .limit_from = &Facts::max_descent_rate_mps,
     .value = &Facts::descent_rate_mps,
     .present = [](const Facts& f, double limit) { return f.descent_rate_mps > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Sinks at %.2f m/s, limit ", f.descent_rate_mps) + limit +
                  ". Hold or wave off.";
         }},
    {.id = AlarmId::kVisionResidual,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .limit = {NAN, "σ", 2},
     .limit_from = &Facts::max_residual_sigma,
     .value = &Facts::residual_sigma,
     .present = [](const Facts& f, double limit) { return f.residual_sigma > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Vision is %.2f σ off the estimate, limit ", f.residual_sigma) +
                  limit + ": measurement refused. Watch the estimate.";
         }},
    {.id = AlarmId::kWind,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .limit = {NAN, "m/s"},
     .limit_from = &Facts::max_wind_mps,
     .value = &Facts::wind_mps,
     .present = [](const Facts& f, double limit) { return f.wind_mps > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Wind %.1f m/s, limit ", f.wind_mps) + limit +
                  ". Watch the descent, hold or wave off.";
         }},
    {.id = AlarmId::kForeignCommand,
     .level = AlarmLevel::kWarning,
     .immediate = true,
     .present = [](const Facts& f, double) { return f.foreign.age_s < AlarmLimits::foreign_s; },
     .text =
         [](const Facts& f, const std::string&) {
           return words::ForeignCommand(f.foreign) +
                  ". This station did not send it: find the sender.";
         }},
    {.id = AlarmId::kViewOnly,
     .level = AlarmLevel::kCaution,
     .present = [](const Facts& f, double) { return !f.view_only.empty(); },
     .text = [](const Facts& f,
                const std::string&) { return f.view_only + ". Wave-off is available."; }},
};

std::vector<AlarmRow> AllRows() {
  std::vector<AlarmRow> rows(std::begin(kRows), std::end(kRows));
  const std::span<const AlarmRow> of_bus = BusAlarms(), of_arrival = ArrivalAlarms(),
                                  of_sensors = SensorAlarms();
  rows.insert(rows.end(), of_bus.begin(), of_bus.end());
  rows.insert(rows.end(), of_arrival.begin(), of_arrival.end());
  rows.insert(rows.end(), of_sensors.begin(), of_sensors.end());
  std::sort(rows.begin(), rows.end(),
            [](const AlarmRow& a, const AlarmRow& b) { return a.id < b.id; });
  return rows;
}

}  // namespace

std::span<const AlarmRow> AlarmTable() {
  static const std::vector<AlarmRow> rows = AllRows();
  return rows;
}

std::string WhyStopped(const AlarmFacts& facts) {
  if (IsSilent(facts)) {
    return "Vehicle fell silent";
  }
  for (const AlarmRow& row : AlarmTable()) {
    std::string why = row.stop != nullptr ? row.stop(facts) : std::string();
    if (!why.empty()) {
      return why;
    }
  }
  return {};
}

Limit LimitOf(const AlarmRow& row, const AlarmFacts& facts) {
  Limit limit = row.limit;
  limit.value = row.limit_from != nullptr ? facts.*row.limit_from : limit.value;
  return limit;
}

std::vector<AlarmCondition> EvaluateAlarms(const AlarmFacts& facts) {
  std::vector<AlarmCondition> conditions;
  for (const AlarmRow& row : AlarmTable()) {
    const Limit limit = LimitOf(row, facts);
    const bool present = row.present(facts, limit.value);
    const bool grave = row.grave != nullptr && row.grave(facts);
    conditions.push_back({row.id, grave ? AlarmLevel::kWarning : row.level, present,
                          present ? row.text(facts, LimitWords(limit)) : std::string(),
                          row.immediate});
    if (present && row.value != nullptr) {
      AlarmCondition& condition = conditions.back();
      condition.figure = facts.*row.value;
      condition.less_is_worse = row.less_is_worse;
      condition.figure_words = LimitWords({condition.figure, limit.unit, limit.decimals});
    }
  }
  return conditions;
}

}  // namespace palace
