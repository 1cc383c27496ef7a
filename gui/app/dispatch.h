// Dispatch: carries out what the panels asked for, once a frame, in one place.
#pragma once

#include "engine/runtime/engine.h"
#include "gui/app/intent.h"
#include "gui/app/ui_state.h"

namespace palace {

/// Commands go to the engine, playback to the source, the rest into the window state.
/// `gesture` joins successive moves of one limit into one step of the history.
void Dispatch(const Intents& intents, CommandOrigin origin, const EngineSnapshot* snapshot,
              const Gesture& gesture, Engine& engine, UiState& state);

/// Shows one line to the operator for a few seconds.
void ShowMessage(UiState& state, std::string text, double ui_time_s);

}  // namespace palace
