// Button: 32 units high (24 in strips), outlined. Recorded by name so that scripts can click it.
#pragma once

#include <string_view>

#include "gui/widgets/draw.h"
#include "gui/widgets/interact.h"

namespace palace {

struct ButtonLook {
  ImFont* font = nullptr;     ///< null: body
  bool enabled = true;        ///< disabled: quiet line, text 3, never fires
  bool active = false;        ///< a switch that is on: white fill
  bool flat = false;          ///< no fill of its own (strips)
  bool unseen = false;        ///< drawn only with the pointer or the focus on it
  std::string_view sub{};     ///< second line in caption, "then site B"
  std::string_view reason{};  ///< why it is disabled, shown as tooltip
  std::string_view hint{};    ///< what it does, where its label does not say; a tooltip
};

/// True in the frame in which the button is released after being pressed on it, or Enter or Space
/// goes down on it.
bool DrawButton(UiFrame& ui, std::string_view name, const Rect& rect, std::string_view label,
                const ButtonLook& look = {});
/// Small box beside the pointer; keeps out of the WAVE OFF rectangle, and off the control that it
/// speaks of, where one is given: below it, or above.
void DrawTooltip(UiFrame& ui, std::string_view text, const Rect* of = nullptr);

}  // namespace palace
