// Presets: limits in a file whose name and place the person chooses. A file is looked at before it
// is loaded, and what would be replaced is said before it is written over.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/model/settings/settings.h"
#include "gui/app/intent.h"
#include "gui/panels/tune/setting_history.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

/// What the app found at the path that is being chosen.
struct PresetLook {
  std::string path;  ///< looked at
  bool exists = false;
  std::string problem;                     ///< why it cannot be loaded, with file, line and limit
  std::vector<SettingChange> differences;  ///< values now, and in the file
};

struct PresetState {
  std::string path;                ///< loaded or saved last; empty: the built-in defaults
  std::optional<Settings> values;  ///< of that file
  PresetChoice choice = PresetChoice::kNone;
  char field[512] = {};  ///< path being typed
  PresetLook look;
};

/// Values that `settings` has otherwise than the preset, or than the defaults where there is none.
int ChangedFromPreset(const PresetState& state, const Settings& settings);

/// In place of the list of limits, while a file is chosen. Items "preset/path", "preset/cancel",
/// "preset/load", "preset/save", "preset/replace".
void DrawPresetPanel(const Rect& rect, PresetState& state, UiFrame& ui);

}  // namespace palace
