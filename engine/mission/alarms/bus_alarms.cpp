// Alarms of a bus: what a stranger, a wrong build or a flood does to it.
#include <array>

#include "engine/core/text.h"
#include "engine/mission/alarms/alarms.h"

namespace palace {
namespace {

using Facts = AlarmFacts;

std::string RefusedWords(const Facts& f) {
  return WithNumbers("%.0f datagrams of the last %.0f s were refused", f.losses.refused,
                     LossWatch::kWindow_s) +
         (f.losses.refused_why.empty() ? "" : " (in all: " + f.losses.refused_why + ")");
}

const std::array<AlarmRow, kBusAlarmCount> kBusAlarms = {{
    {.id = AlarmId::kDatagramsRefused,
     .level = AlarmLevel::kAdvisory,
     .present =
         [](const Facts& f, double) {
           return f.losses.refused > 0 && !(f.refused_hz > AlarmLimits::refused_hz);
         },
     .text = [](const Facts& f,
                const std::string&) { return RefusedWords(f) + ". Diagnose names the sender."; }},
    {.id = AlarmId::kRefusedOften,
     .level = AlarmLevel::kCaution,
     .limit = {AlarmLimits::refused_hz, "a second", 0},
     .value = &Facts::refused_hz,
     .present = [](const Facts& f, double limit) { return f.refused_hz > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return RefusedWords(f) + ", limit " + limit +
                  ". Find the sender that Diagnose names and stop it.";
         }},
    {.id = AlarmId::kBusOverload,
     .level = AlarmLevel::kCaution,
     .limit = {AlarmLimits::bus_load, "times", 0},
     .value = &Facts::bus_load,
     .present = [](const Facts& f, double limit) { return f.bus_load > limit; },
     .text =
         [](const Facts& f, const std::string& limit) {
           return "Bus overload: " + f.losses.busiest +
                  WithNumbers(" %.0f times as fast as needed, limit ", f.bus_load) + limit +
                  ". Find the sender that Diagnose names and stop it.";
         }},
    {.id = AlarmId::kBusOverrun,
     .level = AlarmLevel::kCaution,
     .present = [](const Facts& f, double) { return f.losses.overrun > 0; },
     .text =
         [](const Facts& f, const std::string&) {
           return WithNumbers(
               "This machine lost %.0f datagrams of the last %.0f s before they could be read. "
               "Close other programs, raise net.core.rmem_max.",
               f.losses.overrun, LossWatch::kWindow_s);
         }},
    {.id = AlarmId::kOtherVersion,
     .level = AlarmLevel::kCaution,
     .present = [](const Facts& f, double) { return !f.losses.other_version.empty(); },
     .text =
         [](const Facts& f, const std::string&) {
           return "Version mismatch, not read: " + f.losses.other_version +
                  " messages. Build sender and station from the same message types.";
         }},
    {.id = AlarmId::kSecondSender,
     .level = AlarmLevel::kCaution,
     .present = [](const Facts& f, double) { return !f.losses.second_sender.empty(); },
     .text =
         [](const Facts& f, const std::string&) {
           return "A second sender is refused: " + f.losses.second_sender +
                  ". Find it and stop it; which of the two is the vehicle, only you can know.";
         }},
}};

}  // namespace

std::span<const AlarmRow, kBusAlarmCount> BusAlarms() { return kBusAlarms; }

}  // namespace palace
