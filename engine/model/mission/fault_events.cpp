#include "engine/model/mission/fault_events.h"

#include <algorithm>

namespace palace {

std::vector<Event> FaultEvents(const std::vector<std::string>& before,
                               const std::vector<std::string>& now, Timestamp time) {
  std::vector<Event> events;
  const auto tell = [&](const char* what, const std::vector<std::string>& those,
                        const std::vector<std::string>& except) {
    for (const std::string& fault : those) {
      if (std::find(except.begin(), except.end(), fault) == except.end()) {
        events.push_back({.time = time, .kind = EventKind::kFault, .text = what + fault});
      }
    }
  };
  tell(kFaultEnded, before, now);
  tell(kFaultBegan, now, before);
  return events;
}

}  // namespace palace
