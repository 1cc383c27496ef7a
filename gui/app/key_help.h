// The list of keys behind F1.
#pragma once

#include "gui/widgets/draw.h"

namespace palace {

/// In the middle of `body` (item "key_help"): the table of keys in two columns, no word cut off.
void DrawKeyHelp(const Rect& body, UiFrame& ui);

}  // namespace palace
