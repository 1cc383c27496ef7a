#include "engine/mission/alarms/alarms.h"

#include <algorithm>
#include <vector>

#include "engine/mission/alarms/alarm_words.h"

namespace palace {
namespace {

std::vector<AlarmRow> AllRows() {
  std::vector<AlarmRow> rows;
  for (const std::span<const AlarmRow> some :
       {CaptureAlarms(), MissionAlarms(), StationAlarms(), ArrivalAlarms(), SensorAlarms(),
        std::span<const AlarmRow>(BusAlarms())}) {
    rows.insert(rows.end(), some.begin(), some.end());
  }
  std::sort(rows.begin(), rows.end(),
            [](const AlarmRow& a, const AlarmRow& b) { return a.id < b.id; });
  return rows;
}

}  // namespace

std::span<const AlarmRow> AlarmTable() {
  static const std::vector<AlarmRow> rows = AllRows();
  return rows;
}

std::string WhyStopped(const AlarmFacts& facts) {
  if (IsSilent(facts)) {
    return "Vehicle fell silent";
  }
  for (const AlarmRow& row : AlarmTable()) {
    std::string why = row.stop != nullptr ? row.stop(facts) : std::string();
    if (!why.empty()) {
      return why;
    }
  }
  return {};
}

Limit LimitOf(const AlarmRow& row, const AlarmFacts& facts) {
  Limit limit = row.limit;
  limit.value = row.limit_from != nullptr ? facts.*row.limit_from : limit.value;
  return limit;
}

std::vector<AlarmCondition> EvaluateAlarms(const AlarmFacts& facts) {
  std::vector<AlarmCondition> conditions;
  for (const AlarmRow& row : AlarmTable()) {
    const Limit limit = LimitOf(row, facts);
    const bool present = row.present(facts, limit.value);
    const bool grave = row.grave != nullptr && row.grave(facts);
    conditions.push_back({row.id, grave ? AlarmLevel::kWarning : row.level, present,
                          present ? row.text(facts, LimitWords(limit)) : std::string(),
                          row.immediate});
    if (present && row.badness != nullptr) {
      conditions.back().figure = row.badness(facts);
    }
    if (present && row.value != nullptr) {
      AlarmCondition& condition = conditions.back();
      condition.figure = facts.*row.value;
      condition.less_is_worse = row.less_is_worse;
      condition.figure_words = LimitWords({condition.figure, limit.unit, limit.decimals});
    }
  }
  return conditions;
}

}  // namespace palace
