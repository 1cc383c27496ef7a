// Alarms in few words, the same wherever they are told: what one is about, and how many there are.
#pragma once

#include <string>
#include <vector>

#include "engine/model/mission/mission_status.h"

namespace palace {

/// What an alarm is about, without limit and advice: "GPS horizontal error 2.6 m" of "GPS
/// horizontal error 2.6 m, limit 2.0 m. Vision steers, not GPS."
std::string AlarmSubject(const std::string& text);

/// The first sentence: what was found, without what it blocks or asks for while it stands.
std::string AlarmFinding(const std::string& text);

/// "1 warning, 2 cautions stand, 1 ended". What stands is counted by level, whether it was
/// acknowledged or shelved or not; what is over is counted while it waits for its acknowledgement.
/// Empty where there is neither.
std::string AlarmCountWords(const std::vector<Alarm>& alarms);

}  // namespace palace
