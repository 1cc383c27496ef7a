#include "engine/runtime/settings_state.h"

#include <algorithm>

namespace palace {

Status SettingsState::Set(const std::string& name, double value, bool preview_only) {
  const Status done = SetSettingValue(preview_, name, value);
  if (done && !preview_only) {
    return SetSettingValue(applied_, name, value);
  }
  return done;
}

Status SettingsState::SetRecorded(const std::string& name, double value, bool preview_only) {
  if (std::find(held_.begin(), held_.end(), name) != held_.end()) {
    return Ok();
  }
  const bool follows = GetSetting(applied_, name) == GetSetting(recorded_, name);
  const Status done = SetSettingValue(recorded_preview_, name, value);
  if (!done || preview_only) {
    return done;
  }
  // A limit the reviewer moved stays where the reviewer put it.
  if (follows) {
    const Status followed = Set(name, value, false);
    if (!followed) {
      return followed;
    }
  }
  return SetSettingValue(recorded_, name, value);
}

void SettingsState::Apply() { applied_ = preview_; }

void SettingsState::RestoreRecorded(const Settings& settings) {
  recorded_preview_ = settings;
  ApplyRecorded();
}

void SettingsState::ApplyRecorded() {
  for (const SettingInfo& info : SettingTable()) {
    const double value = GetSetting(recorded_preview_, info.name);
    if (value != GetSetting(recorded_, info.name)) {
      const Status done = SetRecorded(info.name, value, false);
      PALACE_CHECK(done.ok(), info.name, value);
    }
  }
}

}  // namespace palace
