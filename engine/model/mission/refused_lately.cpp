#include "engine/model/mission/refused_lately.h"

namespace palace {
namespace {

constexpr double kTold_s = 6;  // a person must be able to read why

}  // namespace

std::string WhyRefusedLately(const std::vector<Event>& events, std::string_view command,
                             Timestamp now) {
  const std::string refused = std::string(command) + kRefusedMark;
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    if (SecondsBetween(event->time, now) > kTold_s) {
      break;
    }
    if (event->text.rfind(refused, 0) == 0) {
      return event->text.substr(refused.size());
    }
  }
  return {};
}

}  // namespace palace
