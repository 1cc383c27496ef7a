// Intents: what a panel asks for. Panels append them; the app dispatches them once a frame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/model/command.h"
#include "engine/model/simulation_setup.h"

namespace palace {

enum class Workspace : std::uint8_t { kFly, kTune, kReview, kDiagnose, kSimulate };

struct ShowWorkspace {
  Workspace workspace = Workspace::kFly;
};
/// Highlights a candidate without arming it. 0: none.
struct HighlightSite {
  std::uint64_t site_id = 0;
};
/// Presets of the 3-D view, in the order of the render room's.
enum class ViewPreset : std::uint8_t { kOrbit, kAbove, kBehind };
struct ShowView3dPreset {
  ViewPreset preset = ViewPreset::kOrbit;
};
/// Turns, moves or zooms the 3-D view by hand; the way of the pointer in pixels.
struct MoveView3d {
  float turn_x = 0, turn_y = 0;
  float pan_x = 0, pan_y = 0;
  float zoom = 0;            ///< wheel steps; positive comes closer
  float view_height_px = 1;  ///< of the picture that is moved
};
/// Views of a simulated world, in the order of their keys.
enum class WorldEye : std::uint8_t { kLeft, kRight, kChase, kBirdsEye, kAbove, kOrbit };
inline constexpr std::size_t kWorldEyes = 6;
/// Fills the main area of Simulate with it.
struct ShowWorldView {
  WorldEye eye = WorldEye::kBirdsEye;
};
/// Shows the trackers on the left picture of the workspace shown, or hides them.
struct ToggleTrackView {};
enum class LoopEdge : std::uint8_t { kIn, kOut };
/// The stretch that Review plays again and again begins or ends there; seconds from the start.
struct SetLoop {
  LoopEdge edge = LoopEdge::kIn;
  double at_s = 0;
};
struct ToggleLoop {};
struct SetUiScale {
  double scale = 1;
};
struct TakeScreenshot {
  std::string file_name;  ///< empty: a name made from state and time
};
struct UndoSetting {};
struct RedoSetting {};
/// Opens the choice of a preset's file, or closes it.
enum class PresetChoice : std::uint8_t { kNone, kLoad, kSave };
struct ChoosePreset {
  PresetChoice choice = PresetChoice::kLoad;
};
/// Reads what would be loaded, or replaced, without touching it.
struct LookAtPreset {
  std::string path;
};
struct LoadPreset {
  std::string path;
};
struct SavePreset {
  std::string path;
  bool replace = false;  ///< a file of that name was seen, and is to be replaced
};
struct ShowKeyHelp {
  bool shown = false;
};
/// Escape: ends the topmost thing that is open, and only that one (the order: CloseTop in
/// ui_state).
struct CloseTop {};
struct QuitProgram {};
/// Where a simulated flight goes, and in what.
struct FlightChoice {
  std::string scenario;  ///< a name or a file, as the command line takes it
  std::uint64_t seed = 1;
  std::string vehicle;
};
/// Into the built-in simulation, as faults/fault_text.h writes one; its times count from now.
struct InjectFault {
  std::string text;
};
struct EndFault {
  int number = 0;  ///< that it was given
};
/// After a flight: what this window does next. The report is written before any of them.
struct NextFlight {
  enum class Kind : std::uint8_t { kFlyAgain, kReview, kOpenReport };
  Kind kind = Kind::kFlyAgain;
  std::string log{};                     ///< of the flight that is over; empty: not recorded
  int part = 0;                          ///< of the log, to review; 0: the longest
  std::optional<FlightChoice> choice{};  ///< of a simulation; empty: as before
};

/// What changes the window only; reduced into UiState.
using UiAction =
    std::variant<ShowWorkspace, HighlightSite, ShowView3dPreset, ShowWorldView, MoveView3d,
                 SetUiScale, TakeScreenshot, UndoSetting, RedoSetting, ChoosePreset, LookAtPreset,
                 LoadPreset, SavePreset, ShowKeyHelp, CloseTop, QuitProgram, NextFlight,
                 InjectFault, EndFault, ToggleTrackView, SetLoop, ToggleLoop>;

/// Everything a panel can ask for.
using Intent = std::variant<CommandAction, PlaybackControl, SimulationChange, UiAction>;
using Intents = std::vector<Intent>;

}  // namespace palace
