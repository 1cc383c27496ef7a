// Alarms about pictures, pose and link: how old they are, and whether the pair of cameras and its
// scale are right.
#include <cmath>

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
                  (f.on_vision ? ". Vision steers, not GPS."
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
};

}  // namespace

std::span<const AlarmRow> CaptureAlarms() { return kRows; }

}  // namespace palace
