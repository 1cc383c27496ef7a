// Hatch and tint over those cells of a raster that a predicate picks. Lines keep their spacing in
// screen pixels; neighbouring cells share one unbroken line.
#pragma once

#include <algorithm>
#include <cmath>

#include "gui/widgets/draw.h"

namespace palace {

struct CellHatch {
  int cols = 0;
  int rows = 0;
  ImU32 fill = 0;  ///< 0: none
  ImU32 line = 0;
  float width = 1;
  float spacing = 6;  ///< along x, pixels
};

/// `picks(row, col)` says whether a cell is covered. The raster fills `rect`.
template <typename Picks>
void DrawCellHatch(ImDrawList* dl, const Rect& rect, const CellHatch& look, Picks picks) {
  if (look.cols <= 0 || look.rows <= 0) {
    return;
  }
  const float cell_w = rect.w / static_cast<float>(look.cols);
  const float cell_h = rect.h / static_cast<float>(look.rows);
  for (int r = 0; look.fill != 0 && r < look.rows; ++r) {
    for (int c = 0; c < look.cols;) {
      if (!picks(r, c)) {
        ++c;
        continue;
      }
      const int from = c;
      while (c < look.cols && picks(r, c)) {
        ++c;
      }
      const float y = rect.y + cell_h * static_cast<float>(r);
      dl->AddRectFilled({rect.x + cell_w * static_cast<float>(from), y},
                        {rect.x + cell_w * static_cast<float>(c), y + cell_h}, look.fill);
    }
  }
  // Along each diagonal x + y = k, steps of half a cell decide where the line is down.
  const float step = std::max(1.0f, std::min(cell_w, cell_h) * 0.5f);
  for (float k = std::ceil((rect.x + rect.y) / look.spacing) * look.spacing;
       k < rect.right() + rect.bottom(); k += look.spacing) {
    const float x_end = std::min(rect.right(), k - rect.y);
    float down_from = -1;
    for (float x = std::max(rect.x, k - rect.bottom()); x < x_end; x += step) {
      const int c = std::clamp(static_cast<int>((x - rect.x) / cell_w), 0, look.cols - 1);
      const int r = std::clamp(static_cast<int>((k - x - rect.y) / cell_h), 0, look.rows - 1);
      const bool on = picks(r, c);
      if (on && down_from < 0) {
        down_from = x;
      } else if (!on && down_from >= 0) {
        dl->AddLine({down_from, k - down_from}, {x, k - x}, look.line, look.width);
        down_from = -1;
      }
    }
    if (down_from >= 0) {
      dl->AddLine({down_from, k - down_from}, {x_end, k - x_end}, look.line, look.width);
    }
  }
}

}  // namespace palace
