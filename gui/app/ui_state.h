// UiState: all that the window remembers between frames. Nothing here decides what is safe.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gui/app/intent.h"
#include "gui/app/options.h"
#include "gui/panels/diagnose/diagnose.h"
#include "gui/panels/fly_state.h"
#include "gui/panels/frame_bar.h"
#include "gui/panels/review/review.h"
#include "gui/panels/simulate/simulate.h"
#include "gui/panels/tune/tune.h"
#include "gui/render/orbit_camera.h"
#include "gui/widgets/focus.h"

namespace palace {

struct UiState {
  FrameState frame;  ///< holds the workspace shown
  FlyState fly;
  TuneState tune;  ///< holds the history of the limits and the preset's path
  ReviewState review;
  DiagnoseState diagnose;
  SimulateState simulate;
  Focus focus;
  OrbitCamera orbit;              ///< of the 3-D view, wherever it is shown
  std::uint64_t orbit_moves = 0;  ///< counts the operator's turns of it
  OrbitCamera world_orbit;        ///< of the free view in Simulate
  std::uint64_t highlighted_site = 0;
  double scale = 1;
  bool key_help = false;
  bool leave_asked = false;  ///< the question before leaving a vehicle in the air is open
  bool quit = false;
  std::optional<NextFlight> next;  ///< set with quit: the flight after this one, or its review
  WayOut after_review;             ///< offered while a record is shown
  bool report_wanted = false;      ///< to be written and opened
  std::vector<std::string> faults_wanted;       ///< to be injected from now on
  std::vector<int> faults_ended;                ///< numbers of those to be ended
  std::string message;                          ///< toast, newest
  double message_until_s = 0;                   ///< UI clock
  std::vector<std::string> screenshots_wanted;  ///< file names, taken after the next frame
};

/// What a person came for: a log is looked at in Review, where the transport is.
constexpr Workspace FirstWorkspace(SourceChoice source) {
  return source == SourceChoice::kReplay ? Workspace::kReview : Workspace::kFly;
}

/// What a UI action asks of the world outside the window state.
struct UiRequest {
  bool choose_preset = false;  ///< a path is needed to begin with
  std::optional<std::string> look_at_preset;
  std::optional<std::string> load_preset;
  std::optional<SavePreset> save_preset;
  std::vector<SetSetting> settings;  ///< from undo and redo
};

/// Applies one action to the state. Pure, so that tests and scripts can drive it.
///
/// CloseTop ends the first of these that is there, and nothing else: a hold under way, the list of
/// keys, the question before leaving, the list of alarms, the list of checks, the choice of a
/// preset, the question of a moved limit, the pinned probe of the workspace, the focus ring. (A
/// text field that is typed in has the Escape before any of them.)
UiRequest Reduce(UiState& state, const UiAction& action);

}  // namespace palace
