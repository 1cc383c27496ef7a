// Keys: one table binds, documents and tests every key of the program.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/model/snapshot.h"
#include "gui/app/intent.h"
#include "gui/app/ui_state.h"

namespace palace {

/// A row of the table.
struct KeyBinding {
  std::string keys;         ///< "Shift+Escape", "Ctrl+Left", "F2": as scripts and people write it
  std::string description;  ///< a verb with an object
  bool repeats = false;     ///< may be held down (steps, never toggles)
  bool works_in_popup = false;
  bool works_while_typing = false;  ///< keys that print nothing
};

const std::vector<KeyBinding>& KeyTable();

/// The intents of a pressed key; empty for a key that is not bound or not allowed now. Keys that
/// the control with the focus answers to are its own.
Intents IntentsOfKey(std::string_view keys, const EngineSnapshot* snapshot, const UiState& state,
                     bool text_field_active);

}  // namespace palace
