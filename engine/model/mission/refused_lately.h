// What the station refused a moment ago, for the place where it was asked for: a check may fail at
// the press, and pass again in the next picture.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/model/mission/mission_status.h"

namespace palace {

/// Why the newest such command ("Approve") was refused, for six seconds; empty: none was.
std::string WhyRefusedLately(const std::vector<Event>& events, std::string_view command,
                             Timestamp now);

}  // namespace palace
