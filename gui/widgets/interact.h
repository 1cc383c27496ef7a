// Interact: the one way in which a control meets mouse and keyboard.
//
// The pointer is arbitrated by ImGui: one control takes a press and keeps it until the release, so
// a control that appears under a held pointer does not fire; of controls that overlap, the one that
// interacts first in the frame has the pointer, and an overlay (BeginOverlay) shields what lies
// below it. What is outside the clip rectangle cannot be hit. The keyboard works the control that
// has the focus (gui/widgets/focus.h), whose ring the canvas draws.
#pragma once

#include <string_view>

#include "gui/widgets/ui_frame.h"

namespace palace {

/// What kind of control it is, as bits.
enum InteractFlags : unsigned {
  kDisabled = 1,    ///< recorded as such; takes no click and is no stop of Tab
  kKeepsStop = 2,   ///< a stop of Tab also while disabled
  kOnPress = 4,     ///< fires when the pointer goes down on it, not on the release
  kOverPopup = 8,   ///< works also while a popup is open
  kSideSteps = 16,  ///< Left and Right step it
  kAllSteps = 32,   ///< all four arrows step it
  kClears = 64,     ///< Backspace and Delete reset it
  kNoTab = 128,     ///< the keyboard works it through another control or a key of its own
  kKeysOnly = 256,  ///< a text field of ImGui's lies there and takes the pointer
  kPassive = 512,   ///< hover and wheel only; controls on it keep the pointer; not recorded
};

struct Interaction {
  bool hovered = false;      ///< the pointer is on it and nothing lies above it
  bool pressed = false;      ///< the pointer went down on it in this frame
  bool held = false;         ///< it took the press and the button is still down, wherever it is
  bool clicked = false;      ///< pressed and released on it (kOnPress: pressed), or Enter or Space
  bool focused = false;      ///< the keyboard works it
  bool key_pressed = false;  ///< Enter or Space went down in this frame, with the focus
  bool key_held = false;     ///< Enter or Space is down, with the focus
  bool cleared = false;      ///< kClears
  int step_right = 0;        ///< arrow keys; ten with Shift
  int step_up = 0;
  ImVec2 pointer{};
  ImVec2 drag{};    ///< way of the pointer since the last frame, while held
  float wheel = 0;  ///< while hovered
  bool shift = false;
};

/// Records the control as an item (`text`: its visible words) and returns what was done to it.
Interaction Interact(UiFrame& ui, std::string_view name, const Rect& rect, unsigned flags = 0,
                     std::string_view text = {});
/// A control of a list that is scrolled out of sight: the keyboard still reaches it. True when it
/// has the focus: the list has to scroll.
bool OfferHidden(UiFrame& ui, std::string_view name);

/// Opens the one borderless window that all panels draw into; call once a frame around them.
void BeginCanvas(UiFrame& ui);
/// Draws the focus ring, records it as item "focus", and moves the focus where the keys say.
void EndCanvas(UiFrame& ui);
/// A window above the canvas: its area shields what lies below from the pointer.
void BeginOverlay(const char* name, const Rect& rect);
void EndOverlay();
/// Escape went down in this frame and no text field has it.
bool EscapePressed();

}  // namespace palace
