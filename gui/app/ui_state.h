// UiState: all that the window remembers between frames. Nothing here decides what is safe.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/settings.h"
#include "gui/app/intent.h"

namespace palace {

/// One gesture on a limit: one undo step.
struct SettingChange {
  std::string name;
  double before = 0;
  double after = 0;
};

struct UiState {
  Workspace workspace = Workspace::kFly;
  double scale = 1;
  std::uint64_t highlighted_site = 0;
  bool key_help = false;
  bool quit = false;
  std::optional<Cell> probe;
  std::vector<SettingChange> undo;
  std::vector<SettingChange> redo;
  std::string preset_path;                      ///< of the preset loaded or saved last
  std::string message;                          ///< toast, newest
  double message_until_s = 0;                   ///< UI clock
  std::vector<std::string> screenshots_wanted;  ///< file names, taken after the next frame
};

/// What a UI action asks of the world outside the window state.
struct UiRequest {
  std::optional<std::string> load_preset;
  std::optional<std::string> save_preset;
  std::vector<SetSetting> settings;  ///< from undo and redo
};

/// Applies one action to the state. Pure, so that tests and scripts can drive it.
UiRequest Reduce(UiState& state, const UiAction& action);

/// Remembers a limit that moved; successive moves of one limit within a gesture are one step.
void RememberChange(UiState& state, const SetSetting& change, const Settings& before,
                    bool same_gesture);

}  // namespace palace
