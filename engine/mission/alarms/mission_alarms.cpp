// Alarms about the mission: sites, approvals, the descent, who commands.
#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/mission/alarms/alarm_words.h"
#include "engine/mission/descent_limits.h"
#include "engine/mission/wording.h"

namespace palace {
namespace {

using Facts = AlarmFacts;

/// An approval is flown: waved off, nothing of it is left to be watched.
bool DescendsOrHolds(const Facts& f) {
  return !f.approve_ahead && f.state != MissionState::kAborting;
}

const AlarmRow kRows[] = {
    {.id = AlarmId::kNoSite,
     .level = AlarmLevel::kAdvisory,
     .of_mission = true,
     .present = [](const Facts& f, double) { return f.no_site; },
     .text =
         [](const Facts& f, const std::string&) {
           return "No site listed: " + f.no_site_reason +
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
                  "A site can be selected again when the vehicle has stopped. Where none is, "
                  "wave off: it climbs and looks again.";
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
         },
     .grave =
         [](const Facts& f) {
           return f.off_path_m > DescentLimits::grave_share * DescentLimits::off_path_m;
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
                  limit +
                  WithNumbers(". Watch it: beyond %.2f m and lower than %.0f m it is waved off.",
                              f.most_beside_m, DescentLimits::last_height_m);
         },
     .grave = [](const Facts& f) { return f.off_centre_m > f.most_beside_m; },
     .hold = {.id = LimitId::kBeside,
              .label = "Beside the site below 1 m",
              .value = &Facts::beside_m,
              .limit_from = &Facts::most_beside_m,
              .unit = "m",
              .decimals = 2,
              .lasts = "0.3 s",
              .committed = true}},
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
           return WithNumbers("Wind %.1f m/s, limit ", ShownBeyond(f.wind_mps, f.max_wind_mps, 1)) +
                  limit +
                  (DescendsOrHolds(f) ? ". Watch the descent, hold or wave off."
                                      : ". No site is approved in it: wait for less.");
         },
     .grave =
         [](const Facts& f) {
           return DescendsOrHolds(f) && f.wind_mps > DescentLimits::grave_share * f.max_wind_mps;
         }},
    {.id = AlarmId::kTailwind,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .limit = {NAN, "m/s"},
     .limit_from = &Facts::max_tailwind_mps,
     .value = &Facts::tailwind_mps,
     .present = [](const Facts& f, double limit) { return f.tailwind_mps > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return WithNumbers("Tailwind %.1f m/s on the approach, limit ", f.tailwind_mps) + limit +
                  (f.approve_ahead ? ". Take another side or site, or wait."
                                   : ". Watch the descent, hold or wave off.");
         }},
    {.id = AlarmId::kTrackersApart,
     .level = AlarmLevel::kCaution,
     .of_mission = true,
     .present = [](const Facts& f, double) { return !f.trackers_apart.empty(); },
     .text =
         [](const Facts& f, const std::string&) {
           return "Trackers are not trusted: " + f.trackers_apart +
                  ". What holds the site may drift: watch it" +
                  (f.approve_ahead ? " before you approve." : ", hold or wave off.");
         }},
    {.id = AlarmId::kNotOnSite,
     .level = AlarmLevel::kWarning,
     .of_mission = true,
     .immediate = true,
     .present = [](const Facts& f, double) { return f.not_on_site; },
     .text =
         [](const Facts& f, const std::string&) {
           return f.why + ". It may stand on a roof or hang in a wire: look before anything moves.";
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

}  // namespace

std::span<const AlarmRow> MissionAlarms() { return kRows; }

}  // namespace palace
