// Alarms about what arrives from the vehicle, and when: clock, stalls, losses, what is no number.
#include <cmath>

#include "engine/core/text.h"
#include "engine/mission/alarms/alarm_words.h"
#include "engine/mission/wording.h"

namespace palace {
namespace {

using Facts = AlarmFacts;

const AlarmRow kRows[] = {
    {.id = AlarmId::kClock,
     .level = AlarmLevel::kWarning,
     .immediate = true,
     .present = [](const Facts& f, double) { return f.has_vehicle && f.clock_stepped; },
     .text =
         [](const Facts& f, const std::string&) {
           return words::ClockStepped(f.clock_step_s) +
                  ". What was selected is dropped, a descent holds: select again.";
         },
     .stop =
         [](const Facts& f) {
           return f.clock_stepped ? words::ClockStepped(f.clock_step_s) : std::string();
         }},
    {.id = AlarmId::kReboot,
     .level = AlarmLevel::kWarning,
     .immediate = true,
     .present = [](const Facts& f, double) { return f.has_vehicle && f.rebooted; },
     .text =
         [](const Facts&, const std::string&) {
           return std::string("Vehicle restarted. Every approval is void, select again.");
         },
     .stop = [](const Facts& f) -> std::string { return f.rebooted ? words::kRestarted : ""; }},
    {.id = AlarmId::kStalled,
     .level = AlarmLevel::kAdvisory,
     .immediate = true,
     .present = [](const Facts& f, double) { return f.stalled_s > 0; },
     .text =
         [](const Facts& f, const std::string&) {
           return WithNumbers(
               "This computer stood still for %.1f s; what came meanwhile was read afterwards. "
               "Close other programs.",
               f.stalled_s);
         }},
    {.id = AlarmId::kStampsRefused,
     .level = AlarmLevel::kCaution,
     // While the clock itself steps, the messages that show it are refused too: that is no news.
     .present =
         [](const Facts& f, double) {
           return f.losses.stamps_refused > 0 && !(f.since_clock_step_s <= LossWatch::kWindow_s);
         },
     .text =
         [](const Facts& f, const std::string&) {
           return WithNumbers(
                      "%.0f messages of the last %.0f s were refused, stamped ahead of the "
                      "vehicle's "
                      "clock or long before it: ",
                      f.losses.stamps_refused, LossWatch::kWindow_s) +
                  f.losses.stamped_channels + " in all. Is there a second sender?";
         }},
    {.id = AlarmId::kAttitudeInvalid,
     .level = AlarmLevel::kWarning,
     .immediate = true,
     .present = [](const Facts& f,
                   double) { return f.has_vehicle && std::isfinite(f.attitude_invalid_s); },
     .text =
         [](const Facts& f, const std::string&) {
           return "Attitude invalid: the vehicle's pose holds what is no number. It is not used. " +
                  StopConsequence(f, StaleLimits::invalid_pose_s);
         },
     .stop = [](const Facts& f) -> std::string {
       return f.attitude_invalid_s > StaleLimits::invalid_pose_s ? "Attitude invalid" : "";
     },
     .hold = {LimitId::kInvalidPose, "Attitude invalid for", &Facts::invalid_for_s,
              StaleLimits::invalid_pose_s}},
    {.id = AlarmId::kMessageLoss,
     .level = AlarmLevel::kCaution,
     .limit = {AlarmLimits::lost_percent, "%", 0},
     .value = &Facts::lost_percent,
     .present = [](const Facts& f,
                   double limit) { return f.has_vehicle && f.lost_percent > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return LossWords(f.lost_percent / 100, limit, f.losers) + ". Check the link; beyond " +
                  LimitWords({GuardLimits::lost_percent, "%", 0}) + " approve is blocked.";
         }},
    {.id = AlarmId::kCameraBlank,
     .level = AlarmLevel::kCaution,
     .immediate = true,  // three pairs said so
     .present = [](const Facts& f, double) { return f.pictures.blank(); },
     .text =
         [](const Facts& f, const std::string&) {
           return f.pictures.blank_words() + ": dark, covered or washed out. " + StopConsequence(f);
         },
     .stop = [](const Facts& f) { return f.pictures.blank_words(); }},
    {.id = AlarmId::kPairing,
     .level = AlarmLevel::kCaution,
     .limit = {GuardLimits::camera_s, "s"},
     .value = &Facts::pair_age_s,
     // Of a camera that is lost its own alarm speaks.
     .present =
         [](const Facts& f, double limit) {
           return f.has_vehicle && f.pair_age_s > limit &&
                  f.left_camera_age_s <= GuardLimits::camera_s &&
                  f.right_camera_age_s <= GuardLimits::camera_s;
         },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Pictures of both cameras come but do not pair for %.1f s, limit ",
                              f.pair_age_s) +
                  limit + ": partners are lost, or their stamps differ. " + StaleConsequence(f);
         },
     .stop =
         [](const Facts& f) {
           return words::Older("Stereo pair", f.pair_age_s, StaleLimits::sensor_s);
         },
     .hold = {LimitId::kPairAge, "Stereo pair age", &Facts::pair_age_s, StaleLimits::sensor_s}},
    {.id = AlarmId::kOldGround,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .immediate = true,
     .limit = {StaleLimits::ground_s, "s"},
     .value = &Facts::ground_age_s,
     .present = [](const Facts& f, double limit) { return f.ground_age_s > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return words::GroundNotMeasured(f.letter, f.ground_age_s) + ", limit " + limit + ". " +
                  StopConsequence(f);
         },
     .stop =
         [](const Facts& f) {
           return f.ground_age_s > StaleLimits::ground_s
                      ? words::GroundNotMeasured(f.letter, f.ground_age_s)
                      : std::string();
         },
     .hold = {LimitId::kGroundAge, "Ground age at the site", &Facts::ground_age_s,
              StaleLimits::ground_s}},
};

}  // namespace

std::span<const AlarmRow> ArrivalAlarms() { return kRows; }

}  // namespace palace
