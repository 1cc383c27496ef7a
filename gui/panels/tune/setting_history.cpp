#include "gui/panels/tune/setting_history.h"

#include <utility>

namespace palace {
namespace {

constexpr double kGesture_s = 1;
constexpr std::size_t kMostSteps = 200;

/// What the engine makes of it, by the engine's own rule; empty change where it refuses.
std::vector<SettingChange> ChangesOf(const std::vector<SetSetting>& sets, const Settings& now) {
  std::vector<SettingChange> changes;
  Settings trial = now;
  for (const SetSetting& set : sets) {
    if (SetSettingValue(trial, set.name, set.value)) {
      const double before = GetSetting(now, set.name), after = GetSetting(trial, set.name);
      if (before != after) {
        changes.push_back({set.name, before, after});
      }
    }
  }
  return changes;
}

/// A discarded preview goes back to what is applied.
std::vector<SettingChange> DiscardedBy(const EngineSnapshot& snap) {
  std::vector<SettingChange> changes;
  for (const SettingInfo& info : SettingTable()) {
    const double before = GetSetting(snap.session->preview_settings, info.name);
    const double after = GetSetting(snap.session->settings, info.name);
    if (before != after) {
      changes.push_back({info.name, before, after});
    }
  }
  return changes;
}

std::vector<SetSetting> Asked(const SettingStep& step, double SettingChange::*value) {
  std::vector<SetSetting> sets;
  for (const SettingChange& change : step.changes) {
    sets.push_back({change.name, change.*value});
  }
  return sets;
}

}  // namespace

bool SettingHistory::Continues(const std::string& name, const Gesture& gesture) const {
  if (done_ == 0 || can_redo() || steps_.back().changes.size() != 1 ||
      steps_.back().changes.front().name != name) {
    return false;
  }
  const bool dragged = !std::isnan(gesture.press_s) || !std::isnan(last_.press_s);
  return dragged ? gesture.press_s == last_.press_s
                 : gesture.ui_time_s - last_.ui_time_s < kGesture_s;
}

void SettingHistory::Remember(const CommandAction& command, const EngineSnapshot& snap,
                              const Gesture& gesture) {
  if (std::holds_alternative<DiscardSettings>(command)) {
    Add({snap.time, DiscardedBy(snap)});
    return;
  }
  const auto* set = std::get_if<SetSetting>(&command);
  if (set == nullptr) {
    return;
  }
  Settings trial = snap.session->preview_settings;
  if (Continues(set->name, gesture) && SetSettingValue(trial, set->name, set->value)) {
    // A drag asks faster than the engine reports: the step goes on from where it stands.
    steps_.back().changes.front().after = GetSetting(trial, set->name);
    steps_.back().time = snap.time;
  } else {
    Add({snap.time, ChangesOf({*set}, snap.session->preview_settings)});
  }
  last_ = gesture;
}

void SettingHistory::Remember(const std::vector<SetSetting>& together, const EngineSnapshot& snap) {
  Add({snap.time, ChangesOf(together, snap.session->preview_settings)});
}

void SettingHistory::Add(SettingStep step) {
  if (step.changes.empty()) {
    return;
  }
  steps_.resize(done_);
  steps_.push_back(std::move(step));
  if (steps_.size() > kMostSteps) {
    steps_.erase(steps_.begin());
  }
  done_ = steps_.size();
}

std::vector<SetSetting> SettingHistory::Undo() {
  if (!can_undo()) {
    return {};
  }
  return Asked(steps_[--done_], &SettingChange::before);
}

std::vector<SetSetting> SettingHistory::Redo() {
  if (!can_redo()) {
    return {};
  }
  return Asked(steps_[done_++], &SettingChange::after);
}

}  // namespace palace
