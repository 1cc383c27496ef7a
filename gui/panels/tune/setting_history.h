// SettingHistory: what the operator did to the limits, step by step, to be undone and redone.
//
// A step is what one command moved, with the values the engine reported before it and holds after
// it; successive moves of one limit within a gesture (a drag, key presses at most 1 s apart) are
// one step. What the engine would refuse is no step. Undo and redo ask for values and move the
// mark; a new step forgets the undone ones.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/model/command.h"
#include "engine/model/snapshot.h"

namespace palace {

struct SettingChange {
  std::string name;
  double before = 0;
  double after = 0;
};
/// Limits that moved together.
struct SettingStep {
  Timestamp time;
  std::vector<SettingChange> changes;
};
/// When a command was asked for.
struct Gesture {
  double ui_time_s = 0;
  double press_s = NAN;  ///< UI clock of the mouse press that is still held; NaN: none
};

class SettingHistory {
 public:
  /// Notes what `command` does to the limits that `snap` reports; nothing for other commands.
  void Remember(const CommandAction& command, const EngineSnapshot& snap, const Gesture& gesture);
  /// Notes limits that move together, as a loaded preset does.
  void Remember(const std::vector<SetSetting>& together, const EngineSnapshot& snap);

  /// Values that take the newest step back, or bring the next undone one again; empty: none.
  std::vector<SetSetting> Undo();
  std::vector<SetSetting> Redo();
  bool can_undo() const { return done_ > 0; }
  bool can_redo() const { return done_ < steps_.size(); }

  /// Oldest first; those from done() on are undone.
  const std::vector<SettingStep>& steps() const { return steps_; }
  std::size_t done() const { return done_; }

 private:
  bool Continues(const std::string& name, const Gesture& gesture) const;
  void Add(SettingStep step);

  std::vector<SettingStep> steps_;
  std::size_t done_ = 0;
  Gesture last_;
};

}  // namespace palace
