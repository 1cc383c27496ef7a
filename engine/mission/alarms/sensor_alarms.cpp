// Alarms about sensors that the vehicle's own motion contradicts: image time, attitude, GPS, laser;
// and about what it still has to fly with.
#include <cmath>

#include "engine/core/text.h"
#include "engine/mission/alarms/alarm_words.h"
#include "engine/mission/wording.h"

namespace palace {
namespace {

using Facts = AlarmFacts;

constexpr const char* kHeightsElsewhere = "Heights come from stereo and vision.";

constexpr double kSilence_s = 0.3;

/// Nothing comes at all: the link's own alarms speak of that.
bool IsSilence(const Facts& f) { return f.silence_s > kSilence_s; }

/// Nothing in a record, where nobody approves, and once something is approved.
std::string Blocks(const Facts& f, const std::string& when = "") {
  return f.has_vehicle && f.approve_ahead ? " Approve is blocked" + when + "." : "";
}

std::string LaserLies(const Facts& f) {
  return words::LaserFault(f.laser) + ". " + kHeightsElsewhere + Blocks(f);
}

bool IsLowWithoutRate(const Facts& f) {
  return std::isnan(f.energy_min) && f.energy_percent < AlarmLimits::energy_percent;
}

bool GoesOnVision(const Facts& f) { return f.on_vision && f.state != MissionState::kHold; }

const AlarmRow kRows[] = {
    {.id = AlarmId::kImageTime,
     .level = AlarmLevel::kWarning,
     .immediate = true,  // three pictures said so
     .limit = {1000 * ImageTime::kLimit_s, "ms", 0},
     .value = &Facts::image_time_ms,
     .present = [](const Facts& f, double limit) { return f.image_time_ms > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return f.image_time + ", limit " + limit + ". " + StopConsequence(f);
         },
     .stop = [](const Facts& f) { return f.image_time; },
     .hold = {.id = LimitId::kImageTime,
              .label = "Image time off",
              .value = &Facts::image_offset_ms,
              .limit = 1000 * ImageTime::kLimit_s,
              .unit = "ms",
              .decimals = 0,
              .lasts = "3 pictures"}},
    {.id = AlarmId::kGravity,
     .level = AlarmLevel::kWarning,
     .immediate = true,  // seconds of fixes said so
     .badness = [](const Facts& f) { return f.gravity.tilt_deg; },
     .present = [](const Facts& f, double) { return f.gravity.off; },
     .text =
         [](const Facts& f, const std::string&) {
           return words::GravityOff(f.gravity) + ". " + StopConsequence(f);
         },
     .stop = [](const Facts& f) { return words::GravityOff(f.gravity); },
     .hold = {.id = LimitId::kTilt,
              .label = "Attitude off gravity",
              .value = &Facts::tilt_deg,
              .limit = GravityAgreement::kLimit_deg,
              .unit = "deg",
              .decimals = 1,
              .lasts = "2 fixes"}},
    {.id = AlarmId::kGpsJump,
     .level = AlarmLevel::kCaution,
     .immediate = true,  // two fixes said so
     // A drift is told without a figure; while either is over, small ones still come.
     .badness =
         [](const Facts& f) {
           return f.gps_agreement.drifts ? GpsAgreement::kJump_m : f.gps_agreement.off_m;
         },
     .present = [](const Facts& f, double) { return f.gps_agreement.off; },
     .text =
         [](const Facts& f, const std::string&) {
           return words::GpsOff(f.gps_agreement) + ". The position does not follow it." +
                  (GoesOnVision(f) ? " Vision goes on steering." : Blocks(f));
         }},
    {.id = AlarmId::kGpsLost,
     .level = AlarmLevel::kCaution,
     .limit = {AlarmLimits::gps_silence_s, "s"},
     .value = &Facts::gps_age_s,
     .present = [](const Facts& f,
                   double limit) { return f.has_vehicle && f.gps_age_s > limit && !IsSilence(f); },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("No GPS for %.1f s, limit ", f.gps_age_s) + limit + "." +
                  (GoesOnVision(f) ? " Vision goes on steering."
                                   : Blocks(f, " without a position"));
         }},
    {.id = AlarmId::kLaserLost,
     .level = AlarmLevel::kCaution,
     .immediate = true,  // half a second said so
     .present = [](const Facts& f,
                   double) { return f.laser.state == LaserHealth::State::kLost && !IsSilence(f); },
     .text =
         [](const Facts& f, const std::string&) {
           return words::LaserFault(f.laser) + ". " + kHeightsElsewhere +
                  Blocks(f, " below " + LimitWords({GuardLimits::laser_height_m, "m"}));
         }},
    {.id = AlarmId::kLaserStuck,
     .level = AlarmLevel::kCaution,
     .immediate = true,
     .present = [](const Facts& f, double) { return f.laser.state == LaserHealth::State::kStuck; },
     .text = [](const Facts& f, const std::string&) { return LaserLies(f); }},
    {.id = AlarmId::kLaserWrong,
     .level = AlarmLevel::kCaution,
     .immediate = true,
     .badness = [](const Facts& f) { return std::abs(f.laser.ratio - 1); },
     .present = [](const Facts& f, double) { return f.laser.state == LaserHealth::State::kWrong; },
     .text = [](const Facts& f, const std::string&) { return LaserLies(f); }},
    {.id = AlarmId::kEnergyLow,
     .level = AlarmLevel::kCaution,  // no warning: that would keep it from landing
     .limit = {NAN, "min", 1},
     .limit_from = &Facts::energy_reserve_min,
     .value = &Facts::energy_min,
     .less_is_worse = true,
     .present = [](const Facts& f,
                   double limit) { return f.energy_min < limit || IsLowWithoutRate(f); },
     .text =
         [](const Facts& f, const std::string& limit) {
           return (IsLowWithoutRate(f)
                       ? WithNumbers("Energy %.0f %%, limit %.0f %%. ", f.energy_percent,
                                     AlarmLimits::energy_percent)
                       : WithNumbers("Energy for %.1f min at this rate, limit ", f.energy_min) +
                             limit + ". ") +
                  "Land, or fly home.";
         }},
};

}  // namespace

std::span<const AlarmRow> SensorAlarms() { return kRows; }

}  // namespace palace
