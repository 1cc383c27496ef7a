#include "gui/app/dispatch.h"

#include <cstdio>
#include <utility>

#include "engine/mission/leaving.h"
#include "engine/runtime/settings_io.h"
#include "gui/app/presets.h"
#include "gui/widgets/timeline_strip.h"

namespace palace {
namespace {

constexpr double kMessageTime_s = 5;

/// A bookmark is named after its time, and confirmed; without a recording there is none.
void PostBookmark(const AddBookmark& bookmark, CommandOrigin origin, const EngineSnapshot* snapshot,
                  double ui_time_s, Engine& engine, UiState& state) {
  if (!snapshot || !snapshot->session->recording) {
    ShowMessage(state, "No bookmark: nothing is recorded here", ui_time_s);
    return;
  }
  const std::string name =
      !bookmark.note.empty()
          ? bookmark.note
          : "Bookmark at " + TimeLabel(snapshot->session->source.position_s, true);
  engine.Post({origin, AddBookmark{name}});
  ShowMessage(state, name + ", in the recording", ui_time_s);
}

void Post(const CommandAction& action, CommandOrigin origin, const EngineSnapshot* snapshot,
          const Gesture& gesture, Engine& engine, UiState& state) {
  if (snapshot) {
    state.tune.history.Remember(action, *snapshot, gesture);
  }
  if (std::holds_alternative<WaveOff>(action)) {
    state.frame.wave_off_sent_s = gesture.ui_time_s;
  }
  if (const auto* bookmark = std::get_if<AddBookmark>(&action)) {
    PostBookmark(*bookmark, origin, snapshot, gesture.ui_time_s, engine, state);
    return;
  }
  engine.Post({origin, action});
}

Settings LimitsNow(const EngineSnapshot* snapshot) {
  return snapshot ? snapshot->session->preview_settings : Settings{};
}

/// Opens the choice at the path of last time.
void BeginChoice(const EngineSnapshot* snapshot, PresetState& preset) {
  const std::string path = preset.path.empty() ? FirstPresetPath().string() : preset.path;
  std::snprintf(preset.field, sizeof preset.field, "%s", path.c_str());
  preset.look = LookAt(path, LimitsNow(snapshot));
}

void LoadPresetFile(const std::string& path, CommandOrigin origin, const EngineSnapshot* snapshot,
                    double ui_time_s, Engine& engine, UiState& state) {
  const Settings now = LimitsNow(snapshot);
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
  state.tune.preset.path = path;
  state.tune.preset.values = *loaded;
  state.tune.preset.choice = PresetChoice::kNone;
  ShowMessage(state,
              "Preset loaded, " + std::to_string(sets.size()) +
                  (sets.size() == 1 ? " limit changed" : " limits changed"),
              ui_time_s);
}

void SaveChosen(const SavePreset& save, const EngineSnapshot* snapshot, double ui_time_s,
                UiState& state) {
  if (!snapshot) {
    return;
  }
  PresetState& preset = state.tune.preset;
  const Settings now = LimitsNow(snapshot);
  const Status saved = SavePresetFile(save.path, now, save.replace);
  preset.look = LookAt(save.path, now);
  if (saved) {
    preset.path = save.path;
    preset.values = now;
    preset.choice = PresetChoice::kNone;
  }
  ShowMessage(state, saved ? "Preset saved to " + save.path : saved.error().message, ui_time_s);
}

void DoWithPresets(const UiRequest& request, CommandOrigin origin, const EngineSnapshot* snapshot,
                   double ui_time_s, Engine& engine, UiState& state) {
  if (request.choose_preset) {
    BeginChoice(snapshot, state.tune.preset);
  }
  if (request.look_at_preset) {
    state.tune.preset.look = LookAt(*request.look_at_preset, LimitsNow(snapshot));
  }
  if (request.load_preset) {
    LoadPresetFile(*request.load_preset, origin, snapshot, ui_time_s, engine, state);
  }
  if (request.save_preset) {
    SaveChosen(*request.save_preset, snapshot, ui_time_s, state);
  }
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
    } else if (const auto* change = std::get_if<SimulationChange>(&intent)) {
      if (const Status changed = engine.Change(*change); !changed) {
        ShowMessage(state, changed.error().message, ui_time_s);
      }
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
      DoWithPresets(request, origin, snapshot, ui_time_s, engine, state);
    }
  }
}

}  // namespace palace
