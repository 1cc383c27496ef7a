#include "gui/app/ui_state.h"

#include <algorithm>

namespace palace {
namespace {

constexpr double kMinScale = 0.75;
constexpr double kMaxScale = 2.5;

/// The probe of the workspace shown; null where there is none.
MapProbe* ProbeOf(UiState& state) {
  switch (state.frame.workspace) {
    case Workspace::kFly:
      return &state.fly.maps.probe;
    case Workspace::kTune:
      return &state.tune.probe;
    case Workspace::kReview:
      return &state.review.probe;
    case Workspace::kDiagnose:
    case Workspace::kSimulate:
      break;
  }
  return nullptr;
}

/// Clears a switch that is on.
bool SwitchOff(bool& on) {
  const bool was = on;
  on = false;
  return was;
}

void CloseTopmost(UiState& state) {
  if (state.focus.escape_taken() || SwitchOff(state.key_help) || SwitchOff(state.leave_asked) ||
      SwitchOff(state.frame.history_open) ||
      (state.frame.workspace == Workspace::kFly && SwitchOff(state.fly.approve.show_guards))) {
    return;
  }
  if (state.frame.workspace == Workspace::kTune &&
      state.tune.preset.choice != PresetChoice::kNone) {
    state.tune.preset.choice = PresetChoice::kNone;
    return;
  }
  if (state.frame.workspace == Workspace::kFly && state.fly.maps.asked) {
    state.fly.maps.asked.reset();
    return;
  }
  MapProbe* probe = ProbeOf(state);
  if (probe != nullptr && probe->pinned) {
    probe->pinned.reset();
  } else {
    state.focus.Clear();
  }
}

/// Of the workspace shown; null where there is none.
bool* TrackViewOf(UiState& state) {
  switch (state.frame.workspace) {
    case Workspace::kFly:
      return &state.fly.camera.track_view;
    case Workspace::kReview:
      return &state.review.track_view;
    case Workspace::kTune:
    case Workspace::kDiagnose:
    case Workspace::kSimulate:
      break;
  }
  return nullptr;
}

void Show(UiState& state, Workspace workspace) {
  if (workspace != state.frame.workspace) {
    state.fly.maps.probe.pinned.reset();  // what was looked at there
    state.tune.probe.pinned.reset();
    state.review.probe.pinned.reset();
    // Behind another workspace a mission may end, and the next one have another origin.
    state.fly.search_map.last_area.reset();
    state.fly.search_map.put_aside.clear();
  }
  state.frame.workspace = workspace;
  state.highlighted_site = 0;
  if (state.focus.shown().substr(0, 4) != "tab/") {  // the tabs are in every workspace
    state.focus.Clear();
  }
}

void Move(UiState& state, const MoveView3d& move) {
  OrbitCamera& orbit =
      state.frame.workspace == Workspace::kSimulate ? state.world_orbit : state.orbit;
  if (move.turn_x != 0 || move.turn_y != 0) {
    orbit.Drag(move.turn_x, move.turn_y);
  }
  if (move.pan_x != 0 || move.pan_y != 0) {
    orbit.Pan(move.pan_x, move.pan_y, move.view_height_px);
  }
  if (move.zoom != 0) {
    orbit.Zoom(move.zoom);
  }
  ++state.orbit_moves;
}

View3dPreset PresetOf(ViewPreset preset) {
  switch (preset) {
    case ViewPreset::kOrbit:
      return View3dPreset::kOrbit;
    case ViewPreset::kAbove:
      return View3dPreset::kAbove;
    case ViewPreset::kBehind:
      break;
  }
  return View3dPreset::kBehind;
}

struct Reducer {
  UiState& state;
  UiRequest request{};

  void operator()(const ShowWorkspace& show) { Show(state, show.workspace); }
  void operator()(const HighlightSite& site) { state.highlighted_site = site.site_id; }
  void operator()(const ShowView3dPreset& show) {
    state.orbit.SetPreset(PresetOf(show.preset));
    ++state.orbit_moves;
  }
  void operator()(const ShowWorldView& show) { ShowEye(show.eye, state.simulate); }
  void operator()(const MoveView3d& move) { Move(state, move); }
  void operator()(const SetUiScale& to) {
    state.scale = std::clamp(to.scale, kMinScale, kMaxScale);
  }
  void operator()(const TakeScreenshot& shot) {
    state.screenshots_wanted.push_back(shot.file_name);
  }
  void operator()(const UndoSetting&) { request.settings = state.tune.history.Undo(); }
  void operator()(const RedoSetting&) { request.settings = state.tune.history.Redo(); }
  void operator()(const ChoosePreset& choose) {
    state.tune.preset.choice = choose.choice;
    request.choose_preset = choose.choice != PresetChoice::kNone;
    if (request.choose_preset) {
      Show(state, Workspace::kTune);
    }
  }
  void operator()(const LookAtPreset& look) { request.look_at_preset = look.path; }
  void operator()(const LoadPreset& load) { request.load_preset = load.path; }
  void operator()(const SavePreset& save) { request.save_preset = save; }
  void operator()(const ToggleTrackView&) {
    if (bool* shown = TrackViewOf(state)) {
      *shown = !*shown;
    }
  }
  void operator()(const SetLoop& loop) { state.review.loop.Set(loop.edge, loop.at_s); }
  void operator()(const ToggleLoop&) { state.review.loop.Toggle(); }
  void operator()(const ShowKeyHelp& help) { state.key_help = help.shown; }
  void operator()(const CloseTop&) { CloseTopmost(state); }
  void operator()(const QuitProgram&) { state.quit = true; }
  void operator()(const InjectFault& fault) { state.faults_wanted.push_back(fault.text); }
  void operator()(const EndFault& fault) { state.faults_ended.push_back(fault.number); }
  void operator()(const NextFlight& next) {
    if (next.kind == NextFlight::Kind::kOpenReport) {
      state.report_wanted = true;
      return;
    }
    state.next = next;
    state.quit = true;
  }
};

}  // namespace

UiRequest Reduce(UiState& state, const UiAction& action) {
  Reducer reducer{state};
  std::visit(reducer, action);
  return reducer.request;
}

}  // namespace palace
