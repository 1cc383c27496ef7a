#include "gui/widgets/interact.h"

#include <imgui.h>
#include <imgui_internal.h>

#include "gui/widgets/draw.h"
#include "gui/widgets/imgui_input.h"

namespace palace {
namespace {

constexpr int kCoarse = 10;
constexpr ImGuiWindowFlags kBare =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollWithMouse;

void BeginBare(const char* name, const Rect& rect, ImGuiWindowFlags flags) {
  ImGui::SetNextWindowPos(rect.min());
  ImGui::SetNextWindowSize({rect.w, rect.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::Begin(name, nullptr, flags);
  ImGui::PopStyleVar(4);
}

/// The pointer is over the rectangle of this window; nothing is taken.
void ReadPassive(const Rect& rect, Interaction& in) {
  in.hovered = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
               ImGui::IsMouseHoveringRect(rect.min(), rect.max());
  in.wheel = in.hovered ? ImGui::GetIO().MouseWheel : 0;
}

void ReadPointer(UiFrame& ui, std::string_view name, const Rect& rect, unsigned flags,
                 Interaction& in) {
  const ImGuiIO& io = ImGui::GetIO();
  const ImGuiID id = ImGui::GetID(name.data(), name.data() + name.size());
  const ImRect box(rect.min(), rect.max());
  if (!ImGui::ItemAdd(box, id, nullptr, ImGuiItemFlags_NoNav)) {
    return;  // clipped away
  }
  ImGuiButtonFlags behaviour = ImGuiButtonFlags_NoNavFocus;
  behaviour |= (flags & kOnPress) != 0 ? ImGuiButtonFlags_PressedOnClick
                                       : ImGuiButtonFlags_PressedOnClickRelease;
  bool held = false;
  const bool clicked = ImGui::ButtonBehavior(box, id, &in.hovered, &held, behaviour);
  in.wheel = in.hovered ? io.MouseWheel : 0;
  if ((flags & kDisabled) != 0) {
    if (held) {
      ImGui::ClearActiveID();  // becoming enabled under a held pointer must not fire
    }
    return;
  }
  in.clicked = clicked;
  in.held = held;
  in.pressed = held && io.MouseClicked[0];
  if (in.pressed) {
    ui.focus.PressedByMouse(name);
  } else if (held) {
    in.drag = io.MouseDelta;
  }
}

void ReadKeys(UiFrame& ui, std::string_view name, unsigned flags, Interaction& in) {
  const bool disabled = (flags & kDisabled) != 0;
  if ((flags & (kNoTab | kPassive)) != 0 || (disabled && (flags & kKeepsStop) == 0)) {
    return;
  }
  const bool side = (flags & (kSideSteps | kAllSteps)) != 0;
  const bool all = (flags & kAllSteps) != 0;
  ui.focus.Offer(name, ui.tab,
                 kPressKeys | (side ? kSideKeys : 0U) | (all ? kUpDownKeys : 0U) |
                     ((flags & kClears) != 0 ? kDeleteKeys : 0U));
  in.focused = ui.focus.Has(name);
  const ImGuiIO& io = ImGui::GetIO();
  if (!in.focused || disabled || io.WantTextInput || io.KeyCtrl || io.KeyAlt) {
    return;
  }
  in.key_held = KeyDown(ImGuiKey_Enter) || KeyDown(ImGuiKey_Space);
  in.key_pressed = KeyPressed(ImGuiKey_Enter, false) || KeyPressed(ImGuiKey_Space, false);
  in.clicked = in.clicked || in.key_pressed;
  const int size = io.KeyShift ? kCoarse : 1;
  if (side) {
    in.step_right = size * (static_cast<int>(KeyPressed(ImGuiKey_RightArrow, true)) -
                            static_cast<int>(KeyPressed(ImGuiKey_LeftArrow, true)));
  }
  if (all) {
    in.step_up = size * (static_cast<int>(KeyPressed(ImGuiKey_UpArrow, true)) -
                         static_cast<int>(KeyPressed(ImGuiKey_DownArrow, true)));
  }
  in.cleared = (flags & kClears) != 0 &&
               (KeyPressed(ImGuiKey_Backspace, false) || KeyPressed(ImGuiKey_Delete, false));
}

FocusStep ReadFocusStep() {
  const ImGuiIO& io = ImGui::GetIO();
  FocusStep step;
  step.mouse_pressed = io.MouseClicked[0];
  if (KeyPressed(ImGuiKey_Tab, true) && !io.KeyCtrl && !io.KeyAlt) {
    step.tab = io.KeyShift ? -1 : 1;
    if (io.WantTextInput) {
      ImGui::ClearActiveID();  // leaves the text field
    }
  } else if (!io.WantTextInput && !io.KeyCtrl && !io.KeyAlt) {
    step.up_down = static_cast<int>(KeyPressed(ImGuiKey_DownArrow, true)) -
                   static_cast<int>(KeyPressed(ImGuiKey_UpArrow, true));
  }
  return step;
}

}  // namespace

Interaction Interact(UiFrame& ui, std::string_view name, const Rect& rect, unsigned flags,
                     std::string_view text) {
  Interaction in;
  const ImGuiIO& io = ImGui::GetIO();
  in.pointer = io.MousePos;
  in.shift = io.KeyShift;
  if ((flags & kPassive) == 0) {
    ui.items.Add(name, rect, (flags & kDisabled) == 0, text);
  }
  if (ui.blocked_by_popup && (flags & kOverPopup) == 0) {
    return in;
  }
  if ((flags & kPassive) != 0) {
    ReadPassive(rect, in);
  } else if ((flags & kKeysOnly) == 0) {
    ReadPointer(ui, name, rect, flags, in);
  }
  ReadKeys(ui, name, flags, in);
  if (in.focused) {
    ui.ring = FocusMark{rect, Canvas()};
  }
  return in;
}

bool OfferHidden(UiFrame& ui, std::string_view name) {
  if (!ui.blocked_by_popup) {
    ui.focus.Offer(name, ui.tab, 0);
  }
  return ui.focus.Has(name);
}

void BeginCanvas(UiFrame& ui) {
  ui.focus.BeginFrame();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  BeginBare("##canvas", {0, 0, size.x, size.y}, kBare | ImGuiWindowFlags_NoBringToFrontOnFocus);
}

void EndCanvas(UiFrame& ui) {
  if (ui.ring) {
    FocusRing(ui.style, ui.ring->over, ui.ring->rect);
    ui.items.Add("focus", ui.ring->rect, true, ui.focus.shown());
  }
  if (!ui.blocked_by_popup) {
    ui.focus.EndFrame(ReadFocusStep());
  }
  ImGui::End();
}

void BeginOverlay(const char* name, const Rect& rect) {
  BeginBare(name, rect, kBare | ImGuiWindowFlags_NoFocusOnAppearing);
}

void EndOverlay() { ImGui::End(); }

bool EscapePressed() { return !ImGui::GetIO().WantTextInput && KeyPressed(ImGuiKey_Escape, false); }

}  // namespace palace
