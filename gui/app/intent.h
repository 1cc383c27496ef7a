// Intents: what a panel asks for. Panels append them; the app dispatches them once a frame.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "engine/model/command.h"
#include "engine/model/grid.h"

namespace palace {

enum class Workspace : std::uint8_t { kFly, kTune, kReview, kDiagnose };

struct ShowWorkspace {
  Workspace workspace = Workspace::kFly;
};
/// Highlights a candidate without arming it. 0: none.
struct HighlightSite {
  std::uint64_t site_id = 0;
};
struct SetUiScale {
  double scale = 1;
};
struct TakeScreenshot {
  std::string file_name;  ///< empty: a name made from state and time
};
struct UndoSetting {};
struct RedoSetting {};
struct LoadPreset {
  std::string path;
};
struct SavePreset {
  std::string path;  ///< empty: the preset's own file
};
/// Pins the probe to a map cell, or removes it.
struct PinProbe {
  bool pinned = false;
  Cell cell;
};
struct ShowKeyHelp {
  bool shown = false;
};
struct QuitProgram {};

/// What changes the window only; reduced into UiState.
using UiAction =
    std::variant<ShowWorkspace, HighlightSite, SetUiScale, TakeScreenshot, UndoSetting, RedoSetting,
                 LoadPreset, SavePreset, PinProbe, ShowKeyHelp, QuitProgram>;

/// Everything a panel can ask for.
using Intent = std::variant<CommandAction, PlaybackControl, UiAction>;
using Intents = std::vector<Intent>;

}  // namespace palace
