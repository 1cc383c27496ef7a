#include "gui/widgets/imgui_input.h"

namespace palace {

#if IMGUI_VERSION_NUM >= 18900

void StartFedInput() {
  // Otherwise what comes together is spread over several frames.
  ImGui::GetIO().ConfigInputTrickleEventQueue = false;
}

void FeedMousePosition(ImVec2 position) { ImGui::GetIO().AddMousePosEvent(position.x, position.y); }
void FeedMouseButton(int button, bool down) { ImGui::GetIO().AddMouseButtonEvent(button, down); }
void FeedMouseWheel(float steps) { ImGui::GetIO().AddMouseWheelEvent(0, steps); }
void FeedKey(ImGuiKey key, bool down) { ImGui::GetIO().AddKeyEvent(key, down); }
void FeedModifiers(bool shift, bool ctrl) {
  ImGui::GetIO().AddKeyEvent(ImGuiMod_Shift, shift);
  ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, ctrl);
}

bool KeyPressed(ImGuiKey key, bool repeat) { return ImGui::IsKeyPressed(key, repeat); }
bool KeyDown(ImGuiKey key) { return ImGui::IsKeyDown(key); }

#else

void StartFedInput() {
  ImGuiIO& io = ImGui::GetIO();
  for (int key = 0; key < ImGuiKey_COUNT; ++key) {
    if (io.KeyMap[key] < 0) {  // no backend has given this key a number
      io.KeyMap[key] = key;
    }
  }
}

void FeedMousePosition(ImVec2 position) { ImGui::GetIO().MousePos = position; }
void FeedMouseButton(int button, bool down) { ImGui::GetIO().MouseDown[button] = down; }
void FeedMouseWheel(float steps) { ImGui::GetIO().MouseWheel += steps; }
void FeedKey(ImGuiKey key, bool down) { ImGui::GetIO().KeysDown[ImGui::GetKeyIndex(key)] = down; }
void FeedModifiers(bool shift, bool ctrl) {
  ImGui::GetIO().KeyShift = shift;
  ImGui::GetIO().KeyCtrl = ctrl;
}

bool KeyPressed(ImGuiKey key, bool repeat) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
}
bool KeyDown(ImGuiKey key) { return ImGui::IsKeyDown(ImGui::GetKeyIndex(key)); }

#endif

}  // namespace palace
