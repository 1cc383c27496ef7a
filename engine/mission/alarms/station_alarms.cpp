// Alarms about the station itself: its record, its engine, what it cannot read or send.
#include "engine/core/text.h"
#include "engine/mission/alarms/alarm_words.h"
#include "engine/mission/wording.h"

namespace palace {
namespace {

using Facts = AlarmFacts;

const AlarmRow kRows[] = {
    {.id = AlarmId::kRecorder,
     .level = AlarmLevel::kCaution,
     .present = [](const Facts& f, double) { return f.has_vehicle && !f.recorder_ok; },
     .text =
         [](const Facts& f, const std::string&) {
           const std::string why = f.record.problem.empty() ? "" : ": " + f.record.problem;
           return "Recording is not running" + why + ". Acknowledge to fly without a record.";
         }},
    {.id = AlarmId::kUnusualLimits,
     .level = AlarmLevel::kCaution,
     .present = [](const Facts& f, double) { return f.has_vehicle && !f.unusual_settings.empty(); },
     .text =
         [](const Facts& f, const std::string&) {
           return f.unusual_settings + ". What is offered rests on it: see Tune.";
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
};

}  // namespace

std::span<const AlarmRow> StationAlarms() { return kRows; }

}  // namespace palace
