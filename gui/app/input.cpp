#include "gui/app/input.h"

#include <algorithm>
#include <cctype>
#include <map>

#include <GLFW/glfw3.h>

#include "gui/widgets/imgui_input.h"

namespace palace {
namespace {

const std::map<std::string, ImGuiKey>& NamedKeys() {
  static const std::map<std::string, ImGuiKey> keys = {
      {"Tab", ImGuiKey_Tab},     {"Enter", ImGuiKey_Enter},         {"Escape", ImGuiKey_Escape},
      {"Space", ImGuiKey_Space}, {"Left", ImGuiKey_LeftArrow},      {"Right", ImGuiKey_RightArrow},
      {"Up", ImGuiKey_UpArrow},  {"Down", ImGuiKey_DownArrow},      {"Home", ImGuiKey_Home},
      {"End", ImGuiKey_End},     {"Backspace", ImGuiKey_Backspace}, {"Delete", ImGuiKey_Delete},
  };
  return keys;
}

/// The key without its modifiers: "Shift+Tab" gives "Tab".
std::string BaseKey(const std::string& keys) {
  const std::size_t plus = keys.rfind('+');
  return plus == std::string::npos || plus + 1 == keys.size() ? keys : keys.substr(plus + 1);
}

std::string GlfwKeyName(int key) {
  static const std::map<int, std::string> names = {
      {GLFW_KEY_ESCAPE, "Escape"},  {GLFW_KEY_SPACE, "Space"},   {GLFW_KEY_ENTER, "Enter"},
      {GLFW_KEY_KP_ENTER, "Enter"}, {GLFW_KEY_TAB, "Tab"},       {GLFW_KEY_LEFT, "Left"},
      {GLFW_KEY_RIGHT, "Right"},    {GLFW_KEY_UP, "Up"},         {GLFW_KEY_DOWN, "Down"},
      {GLFW_KEY_HOME, "Home"},      {GLFW_KEY_END, "End"},       {GLFW_KEY_KP_ADD, "+"},
      {GLFW_KEY_KP_SUBTRACT, "-"},  {GLFW_KEY_DELETE, "Delete"}, {GLFW_KEY_BACKSPACE, "Backspace"},
  };
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) {
    return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  }
  const auto it = names.find(key);
  return it == names.end() ? std::string() : it->second;
}

}  // namespace

void FeedScriptInput(const ScriptInput& input, std::vector<ImGuiKey>& previous) {
  FeedMousePosition(input.mouse);
  FeedMouseButton(0, input.mouse_down);
  for (const ImGuiKey key : previous) {
    FeedKey(key, false);
  }
  previous.clear();
  bool shift = false, ctrl = false;
  for (const auto& keys : {input.key, input.hold_key}) {
    if (!keys) {
      continue;
    }
    shift |= keys->find("Shift+") != std::string::npos;
    ctrl |= keys->find("Ctrl+") != std::string::npos;
    const auto named = NamedKeys().find(BaseKey(*keys));
    if (named != NamedKeys().end()) {
      FeedKey(named->second, true);
      previous.push_back(named->second);
    }
  }
  FeedModifiers(shift, ctrl);
}

void FeedShortTaps(const std::vector<KeyEvent>& events, std::vector<ImGuiKey>& held) {
#if IMGUI_VERSION_NUM >= 18900
  static_cast<void>(events);
  static_cast<void>(held);
#else
  const auto has = [&](int key, KeyAction action) {
    return std::any_of(events.begin(), events.end(), [&](const KeyEvent& event) {
      return event.key == key && event.action == action;
    });
  };
  std::vector<ImGuiKey> taps, down;
  for (const KeyEvent& event : events) {
    const auto named = NamedKeys().find(GlfwKeyName(event.key));
    if (event.action == KeyAction::kPress && named != NamedKeys().end()) {
      (has(event.key, KeyAction::kRelease) ? taps : down).push_back(named->second);
    }
  }
  for (const ImGuiKey key : held) {
    if (std::find(down.begin(), down.end(), key) == down.end()) {
      FeedKey(key, false);
    }
  }
  for (const ImGuiKey key : taps) {
    FeedKey(key, true);
  }
  held = taps;
#endif
}

void FeedPointer(const std::vector<PointerEvent>& events, PointerQueue& queue) {
  queue.Add(events);
  const std::optional<PointerEvent> pointer = queue.Take();
#if IMGUI_VERSION_NUM < 18900
  if (pointer) {
    FeedMousePosition({pointer->x, pointer->y});
  }
  if (pointer && pointer->button >= 0) {
    FeedMouseButton(pointer->button, pointer->down);
  }
#else
  static_cast<void>(pointer);
#endif
}

bool IsKey(const std::string& keys) {
  std::string base = keys;
  for (const char* modifier : {"Ctrl+", "Alt+", "Shift+"}) {  // in the order of KeyName
    if (base.rfind(modifier, 0) == 0) {
      base.erase(0, std::string(modifier).size());
    }
  }
  if (base.size() == 1 || NamedKeys().count(base) > 0) {
    return true;
  }
  for (int key = GLFW_KEY_F1; key <= GLFW_KEY_F12; ++key) {
    if (base == GlfwKeyName(key)) {
      return true;
    }
  }
  return false;
}

std::string KeyName(const KeyEvent& event) {
  std::string base = GlfwKeyName(event.key);
  if (base.empty()) {
    base = event.name;
    std::transform(base.begin(), base.end(), base.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  }
  if (base == "=") {
    base = "+";  // the key that prints + with Shift
  }
  if (base.empty()) {
    return {};
  }
  std::string name;
  name += (event.mods & GLFW_MOD_CONTROL) != 0 ? "Ctrl+" : "";
  name += (event.mods & GLFW_MOD_ALT) != 0 ? "Alt+" : "";
  name += (event.mods & GLFW_MOD_SHIFT) != 0 && base != "+" ? "Shift+" : "";
  return name + base;
}

}  // namespace palace
