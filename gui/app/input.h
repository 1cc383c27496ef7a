// Input for ImGui and the key table, from the window or from a script.
#pragma once

#include <string>
#include <vector>

#include <imgui.h>

#include "gui/app/pointer_queue.h"
#include "gui/app/script.h"
#include "gui/platform/window.h"

namespace palace {

/// Puts the script's mouse and keys into ImGui's input, before the frame, after StartFedInput().
/// `previous` are the keys that were down; they are released first.
void FeedScriptInput(const ScriptInput& input, std::vector<ImGuiKey>& previous);
/// Keys of the window that went down and up between two frames: held for one frame where ImGui
/// reads arrays and would miss them; nothing where it takes events. `held` carries them to the next
/// frame.
void FeedShortTaps(const std::vector<KeyEvent>& events, std::vector<ImGuiKey>& held);
/// What the window's pointer did since the last frame, one change of a button a frame, where ImGui
/// reads the pointer as a state; nothing where it takes events, for then it does so itself.
void FeedPointer(const std::vector<PointerEvent>& events, PointerQueue& queue);
/// "Shift+Escape", "Ctrl+Z", "Space": the key table's spelling. Letters follow the keyboard's
/// layout.
std::string KeyName(const KeyEvent& event);
/// The text is spelt so.
bool IsKey(const std::string& keys);

}  // namespace palace
