#include "gui/app/ui_state.h"

#include <algorithm>

namespace palace {
namespace {

constexpr double kMinScale = 0.75;
constexpr double kMaxScale = 2.5;
constexpr std::size_t kMaxUndo = 200;

/// Moves the newest change from one stack to the other and asks for its value.
void Step(std::vector<SettingChange>& from, std::vector<SettingChange>& to, bool forward,
          UiRequest& request) {
  if (from.empty()) {
    return;
  }
  const SettingChange change = from.back();
  from.pop_back();
  to.push_back(change);
  request.settings.push_back({change.name, forward ? change.after : change.before});
}

}  // namespace

UiRequest Reduce(UiState& state, const UiAction& action) {
  UiRequest request;
  if (const auto* show = std::get_if<ShowWorkspace>(&action)) {
    state.workspace = show->workspace;
  } else if (const auto* highlight = std::get_if<HighlightSite>(&action)) {
    state.highlighted_site = highlight->site_id;
  } else if (const auto* scale = std::get_if<SetUiScale>(&action)) {
    state.scale = std::clamp(scale->scale, kMinScale, kMaxScale);
  } else if (const auto* shot = std::get_if<TakeScreenshot>(&action)) {
    state.screenshots_wanted.push_back(shot->file_name);
  } else if (std::holds_alternative<UndoSetting>(action)) {
    Step(state.undo, state.redo, false, request);
  } else if (std::holds_alternative<RedoSetting>(action)) {
    Step(state.redo, state.undo, true, request);
  } else if (const auto* load = std::get_if<LoadPreset>(&action)) {
    request.load_preset = load->path;
  } else if (const auto* save = std::get_if<SavePreset>(&action)) {
    request.save_preset = save->path;
  } else if (const auto* probe = std::get_if<PinProbe>(&action)) {
    state.probe = probe->pinned ? std::optional<Cell>(probe->cell) : std::nullopt;
  } else if (const auto* help = std::get_if<ShowKeyHelp>(&action)) {
    state.key_help = help->shown;
  } else if (std::holds_alternative<QuitProgram>(action)) {
    state.quit = true;
  }
  return request;
}

void RememberChange(UiState& state, const SetSetting& change, const Settings& before,
                    bool same_gesture) {
  state.redo.clear();
  if (same_gesture && !state.undo.empty() && state.undo.back().name == change.name) {
    state.undo.back().after = change.value;
    return;
  }
  state.undo.push_back({change.name, GetSetting(before, change.name), change.value});
  if (state.undo.size() > kMaxUndo) {
    state.undo.erase(state.undo.begin());
  }
}

}  // namespace palace
