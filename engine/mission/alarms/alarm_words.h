// Words that several alarms share, and the rows by what they are about. For this folder only.
#pragma once

#include <span>
#include <string>

#include "engine/mission/alarms/alarms.h"

namespace palace {

/// What an old picture or pose does to the mission.
std::string StaleConsequence(const AlarmFacts& facts);
/// The same of what stops at once.
std::string StopConsequence(const AlarmFacts& facts);
std::string StopConsequence(const AlarmFacts& facts, double after_s);
/// "Left camera stale, 1.8 s, limit 0.5 s. ".
std::string StaleText(const char* what, double age_s, const std::string& limit);
/// Nothing at all was heard of the vehicle for longer than a sensor may be silent.
bool IsSilent(const AlarmFacts& facts);
/// "Vehicle silent" or "Vehicle status".
const char* LinkWords(const AlarmFacts& facts);

/// Pictures, pose and link: their age, and whether the pair is right.
std::span<const AlarmRow> CaptureAlarms();
/// Sites, approvals, the descent, who commands.
std::span<const AlarmRow> MissionAlarms();
/// The station's record and engine, what it cannot read or send.
std::span<const AlarmRow> StationAlarms();
/// What arrives from the vehicle, and when.
std::span<const AlarmRow> ArrivalAlarms();
/// What the vehicle's own motion contradicts.
std::span<const AlarmRow> SensorAlarms();

}  // namespace palace
