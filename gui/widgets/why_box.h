// Why box: the answer to "why is this cell safe, or not?", beside the cell it speaks of.
//
// Each term has its value with 3 sigma and its limit; the one that decided carries the white mark.
// Below them: the nearest hazard, height, frames and age, flags.
#pragma once

#include <vector>

#include "engine/model/cell_explanation.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

/// A place of this size beside `anchor` (the probed cell), inside `within`, that touches neither
/// the anchor nor any of `avoid`: right of it, left, above or below, whichever is first free.
/// Nothing when no such place is left.
std::optional<Rect> PlaceBeside(const Rect& anchor, ImVec2 size, const Rect& within,
                                const std::vector<Rect>& avoid, float gap);

/// Size of the box for this explanation.
ImVec2 WhyBoxSize(const Style& style, const CellExplanation& why);
/// Draws it (item "why"). `map_age_s`: age of the map, to be added to the cell's.
void DrawWhyBox(UiFrame& ui, const Rect& rect, const CellExplanation& why, double map_age_s);

}  // namespace palace
