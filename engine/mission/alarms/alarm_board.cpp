#include "engine/mission/alarms/alarm_board.h"

#include <algorithm>

namespace palace {

AlarmBoard::Entry& AlarmBoard::Find(const AlarmCondition& condition) {
  for (Entry& entry : entries_) {
    if (entry.alarm.kind == condition.id) {
      return entry;
    }
  }
  Entry entry;
  entry.alarm = Alarm{condition.id};
  entry.alarm.active = false;
  entry.alarm.count = 0;
  entries_.push_back(entry);
  return entries_.back();
}

void AlarmBoard::Entry::TakeWorst(const AlarmCondition& condition) {
  const bool worse = condition.less_is_worse ? condition.figure < worst : condition.figure > worst;
  if (worse || (std::isnan(worst) && std::isfinite(condition.figure))) {
    worst = condition.figure;
    worst_text = condition.text;
    alarm.worst = condition.figure_words;
  }
}

void AlarmBoard::Update(const std::vector<AlarmCondition>& conditions, Timestamp now) {
  raised_.clear();
  ended_.clear();
  for (const AlarmCondition& condition : conditions) {
    Entry& entry = Find(condition);
    Alarm& alarm = entry.alarm;
    const bool changed =
        entry.standing.Add(condition.present, condition.immediate ? 1 : Persistence::kSamples);
    const bool worse = condition.present && alarm.active && condition.level > alarm.level;
    if (condition.present && (alarm.active || condition.immediate)) {
      alarm.text = condition.text;
    }
    if (worse) {
      alarm.acknowledged = false;  // a caution that grows into a warning is news
      raised_.push_back(alarm);
    }
    if (condition.present && alarm.active) {
      alarm.level = condition.level;
      entry.TakeWorst(condition);
    }
    if (!changed) {
      continue;
    }
    alarm.active = condition.present;
    if (!alarm.active && std::isfinite(entry.worst)) {
      alarm.text = entry.worst_text;
    }
    if (!alarm.active && alarm.level != AlarmLevel::kAdvisory) {
      ended_.push_back(alarm);
    }
    if (alarm.active) {
      if (!entry.shown) {  // else it comes again while it still waits: the worst of them all stays
        entry.worst = NAN;
        alarm.worst.clear();
      }
      entry.TakeWorst(condition);
      alarm.level = condition.level;
      alarm.text = condition.text;
      alarm.since = now;
      alarm.acknowledged = false;
      ++alarm.count;
      entry.shown = true;
      raised_.push_back(alarm);
    } else if (alarm.acknowledged || alarm.level == AlarmLevel::kAdvisory) {
      entry.shown = false;
      alarm.count = 0;
    }
  }
}

bool AlarmBoard::Acknowledge(AlarmId id) {
  for (Entry& entry : entries_) {
    if (entry.shown && entry.alarm.kind == id) {
      entry.alarm.acknowledged = true;
      if (!entry.alarm.active) {
        entry.shown = false;
        entry.alarm.count = 0;
      }
      return true;
    }
  }
  return false;
}

bool AlarmBoard::IsAcknowledged(AlarmId id) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.shown && entry.alarm.active && entry.alarm.acknowledged && entry.alarm.kind == id;
  });
}

std::string AlarmBoard::LastText(AlarmId id) const {
  const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& e) { return e.alarm.kind == id; });
  return entry == entries_.end() ? std::string() : entry->alarm.text;
}

namespace {

/// Without the sentences on what comes next: of what is over nothing does.
std::string WordsOfOver(const Alarm& alarm) {
  std::string first = alarm.text.substr(0, alarm.text.find(". "));
  if (first.ends_with('.')) {
    first.pop_back();
  }
  return first + " (over)";
}

}  // namespace

std::string AlarmBoard::UnacknowledgedWarning() const {
  for (const Alarm& alarm : Shown()) {
    if (alarm.level == AlarmLevel::kWarning && !alarm.acknowledged) {
      return alarm.active ? alarm.text : WordsOfOver(alarm);
    }
  }
  return {};
}

std::vector<Alarm> AlarmBoard::Shown() const {
  std::vector<Alarm> shown;
  for (const Entry& entry : entries_) {
    if (entry.shown) {
      shown.push_back(entry.alarm);
    }
  }
  std::stable_sort(shown.begin(), shown.end(), [](const Alarm& a, const Alarm& b) {
    return a.active != b.active               ? a.active
           : a.level != b.level               ? a.level > b.level
           : a.acknowledged != b.acknowledged ? b.acknowledged
                                              : b.since < a.since;
  });
  return shown;
}

}  // namespace palace
