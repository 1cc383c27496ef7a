// Whether two rectangles of the screen have a pixel in common.
#pragma once

#include "gui/widgets/ui_frame.h"

namespace palace {

/// Edges that only meet do not overlap.
inline bool Overlap(const Rect& a, const Rect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

}  // namespace palace
