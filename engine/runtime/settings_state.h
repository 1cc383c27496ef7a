// The limits in force, and the ones being previewed.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// While a site is armed, approved or flown to, a moved limit previews only (DESIGN.md 8).
/// In replay the recorded settings are kept apart from the ones the reviewer moves.
class SettingsState {
 public:
  explicit SettingsState(const Settings& initial)
      : recorded_(initial), applied_(initial), preview_(initial) {}

  const Settings& applied() const { return applied_; }
  const Settings& preview() const { return preview_; }
  /// Replay: what the flight itself used. Equal to applied() elsewhere.
  const Settings& recorded() const { return recorded_; }
  bool previewing() const { return !(preview_ == applied_); }
  bool redecided() const { return !(applied_ == recorded_); }

  Status Set(const std::string& name, double value, bool preview_only);
  /// Replay: a change that the flight's own operator made.
  Status SetRecorded(const std::string& name, double value, bool preview_only);
  void Apply();
  void ApplyRecorded();
  /// Replay: after a jump, what the flight's operator had set by then. What the reviewer moved
  /// stays.
  void RestoreRecorded(const Settings& settings);
  void Discard() { preview_ = applied_; }
  void DiscardRecorded() { recorded_preview_ = recorded_; }
  /// Live and simulated flights: what is applied is what will be on record.
  void FollowApplied() { recorded_ = recorded_preview_ = applied_; }
  /// Replay: the reviewer's limits, in place of the recorded ones. `held`: settings that keep their
  /// initial value whatever the record says of them later.
  void Redecide(const Settings& settings, std::vector<std::string> held = {}) {
    applied_ = preview_ = settings;
    held_ = std::move(held);
  }

 private:
  Settings recorded_;
  Settings recorded_preview_ = recorded_;
  Settings applied_;
  Settings preview_;
  std::vector<std::string> held_;
};

}  // namespace palace
