// Frame of every panel: background, 28-unit header with title, right-aligned facts.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "gui/widgets/draw.h"

namespace palace {

/// One fact at the right of a header; listed from left to right.
struct PanelFact {
  std::string text;
  ImU32 colour = 0;      ///< 0: text 2
  bool strong = false;   ///< Medium instead of caption
  bool caution = false;  ///< with the caution diamond before it
};

/// Draws the panel and returns the content rectangle below the header (no padding taken off).
/// Facts that do not fit beside the title are dropped from the end. Recorded as "panel/<title>".
Rect DrawPanelFrame(UiFrame& ui, const Rect& rect, std::string_view title,
                    std::initializer_list<PanelFact> facts = {});
/// Background alone, for panels without a header.
void DrawPanelBackground(UiFrame& ui, const Rect& rect, std::string_view name);

}  // namespace palace
