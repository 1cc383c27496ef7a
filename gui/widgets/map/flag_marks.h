// Marks of terrain flags: a small white shape with a dark rim on every few pixels of a flagged
// area, and one on what is narrower, over any colour map or picture. Hazards are hatched in orange,
// unknown is hatched in grey; flags are told apart from both and from each other by shape.
//
//   cross      thin structure        two dashes  no texture      chevron  motion
//   square     elevated surface      dot         deep shadow     triangle unexplained mark
#pragma once

#include "engine/model/elevation_map.h"
#include "gui/widgets/map/projection.h"

namespace palace {

/// Over a map that fills `square`. `flags` may be empty: nothing is drawn.
void DrawFlagsOnMap(const Style& style, const Rect& square, const Grid<std::uint8_t>& flags);
/// On the ground of a picture: cells of known height, and the others at the nearest known height of
/// their row.
void DrawFlagsOnPicture(const Style& style, const PictureView& view, const GridGeometry& geometry,
                        const GridF& height_m, const Grid<std::uint8_t>& flags);

/// All bits that occur.
unsigned FlagsPresent(const Grid<std::uint8_t>& flags);
/// Size of the legend of these flags, shapes with words, beside or below each other; 0 of none.
ImVec2 FlagLegendSize(const Style& style, unsigned flags, bool in_row);
/// The legend, `at` its upper left corner.
void DrawFlagLegend(UiFrame& ui, ImVec2 at, unsigned flags, bool in_row);

}  // namespace palace
