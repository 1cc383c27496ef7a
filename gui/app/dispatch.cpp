#include "gui/app/dispatch.h"

#include <utility>

#include "engine/mission/leaving.h"
#include "engine/runtime/settings_io.h"

namespace palace {
namespace {

constexpr double kMessageTime_s = 5;

void Post(const CommandAction& action, CommandOrigin origin, const EngineSnapshot* snapshot,
          const Gesture& gesture, Engine& engine, UiState& state) {
  if (snapshot) {
    state.tune.history.Remember(action, *snapshot, gesture);
  }
  if (std::holds_alternative<WaveOff>(action)) {
    state.frame.wave_off_sent_s = gesture.ui_time_s;
  }
  engine.Post({origin, action});
}

void LoadPresetFile(const std::string& path, CommandOrigin origin, const EngineSnapshot* snapshot,
                    double ui_time_s, Engine& engine, UiState& state) {
  const Settings now = snapshot ? snapshot->session->preview_settings : Settings{};
  const Result<Settings> loaded = LoadSettingsFile(path, now);
  if (!loaded) {
    ShowMessage(state, loaded.error().message, ui_time_s);
    return;
  }
  std::vector<SetSetting> sets;
  for (const SettingInfo& info : SettingTable()) {
    const double value = GetSetting(*loaded, info.name);
    if (value != GetSetting(now, info.name)) {
      sets.push_back({info.name, value});
    }
  }
  if (snapshot) {
    state.tune.history.Remember(sets, *snapshot);
  }
  for (const SetSetting& set : sets) {
    engine.Post({origin, set});
  }
  state.tune.preset_path = path;
  ShowMessage(state, "Preset loaded, " + std::to_string(sets.size()) + " values changed",
              ui_time_s);
}

void SavePresetFile(const std::string& wanted, const EngineSnapshot* snapshot, double ui_time_s,
                    UiState& state) {
  if (!snapshot) {
    return;
  }
  const std::string path = !wanted.empty()                   ? wanted
                           : !state.tune.preset_path.empty() ? state.tune.preset_path
                                                             : "config/preset.toml";
  const Status saved = SaveSettingsFile(path, snapshot->session->preview_settings);
  if (saved) {
    state.tune.preset_path = path;
  }
  ShowMessage(state, saved ? "Preset saved to " + path : saved.error().message, ui_time_s);
}

/// Who would leave a vehicle in the air is asked first.
bool AsksFirst(const UiAction& action, const EngineSnapshot* snapshot) {
  return std::holds_alternative<QuitProgram>(action) && snapshot != nullptr &&
         !WhatTheVehicleDoesAlone(*snapshot).empty();
}

}  // namespace

void ShowMessage(UiState& state, std::string text, double ui_time_s) {
  state.message = std::move(text);
  state.message_until_s = ui_time_s + kMessageTime_s;
}

void Dispatch(const Intents& intents, CommandOrigin origin, const EngineSnapshot* snapshot,
              const Gesture& gesture, Engine& engine, UiState& state) {
  const double ui_time_s = gesture.ui_time_s;
  for (const Intent& intent : intents) {
    if (const auto* command = std::get_if<CommandAction>(&intent)) {
      Post(*command, origin, snapshot, gesture, engine, state);
    } else if (const auto* playback = std::get_if<PlaybackControl>(&intent)) {
      engine.Control(*playback);
    } else {
      const auto& action = std::get<UiAction>(intent);
      if (AsksFirst(action, snapshot)) {
        state.leave_asked = true;
        continue;
      }
      const UiRequest request = Reduce(state, action);
      for (const SetSetting& set : request.settings) {
        engine.Post({origin, set});
      }
      if (request.load_preset) {
        LoadPresetFile(*request.load_preset, origin, snapshot, ui_time_s, engine, state);
      }
      if (request.save_preset) {
        SavePresetFile(*request.save_preset, snapshot, ui_time_s, state);
      }
    }
  }
}

}  // namespace palace
