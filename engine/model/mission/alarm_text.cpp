#include "engine/model/mission/alarm_text.h"

#include <algorithm>

namespace palace {
namespace {

struct LevelWords {
  AlarmLevel level;
  const char* one;
  const char* many;
};
constexpr LevelWords kLevels[] = {{AlarmLevel::kWarning, "warning", "warnings"},
                                  {AlarmLevel::kCaution, "caution", "cautions"},
                                  {AlarmLevel::kAdvisory, "advisory", "advisories"}};

}  // namespace

std::string AlarmSubject(const std::string& text) {
  std::size_t stop = text.size();
  for (const char* end : {", ", ". ", ": "}) {
    stop = std::min(stop, text.find(end));
  }
  if (stop == text.size() && text.ends_with('.')) {
    --stop;
  }
  return text.substr(0, stop);
}

std::string AlarmFinding(const std::string& text) {
  const std::size_t stop = text.find(". ");
  return stop == std::string::npos ? text : text.substr(0, stop + 1);
}

std::string AlarmCountWords(const std::vector<Alarm>& alarms) {
  std::string words;
  std::ptrdiff_t standing = 0;
  for (const LevelWords& level : kLevels) {
    const auto count = std::count_if(alarms.begin(), alarms.end(), [&](const Alarm& alarm) {
      return alarm.active && alarm.level == level.level;
    });
    if (count > 0) {
      words += (words.empty() ? "" : ", ") + std::to_string(count) + " " +
               (count == 1 ? level.one : level.many);
    }
    standing += count;
  }
  if (standing > 0) {
    words += standing == 1 ? " stands" : " stand";
  }
  const auto over =
      std::count_if(alarms.begin(), alarms.end(), [](const Alarm& alarm) { return !alarm.active; });
  return over == 0 ? words : words + (words.empty() ? "" : ", ") + std::to_string(over) + " ended";
}

}  // namespace palace
