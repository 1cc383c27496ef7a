// Map probe: one place on the ground, read on all maps and marked on all pictures.
//
// The pointer over a map shows the place under it; a click pins it there, a click on the pin or
// Escape takes it away. With the focus on a map, arrows move the pin by a cell (with Shift ten).
// Kept as north and east, because the grid under a flying camera moves.
#pragma once

#include <optional>
#include <string>

#include "engine/model/snapshot.h"
#include "gui/widgets/map/map_image.h"
#include "gui/widgets/map/projection.h"

namespace palace {

struct MapProbe {
  std::optional<Eigen::Vector2d> hovered;  ///< north, east; under the pointer in the last frame
  std::optional<Eigen::Vector2d> next;     ///< being collected
  std::optional<Eigen::Vector2d> pinned;
  std::string hovered_map, next_map, pinned_map;  ///< item names of the maps they are on

  /// The place shown: under the pointer, else the pinned one.
  const std::optional<Eigen::Vector2d>& Shown() const { return hovered ? hovered : pinned; }
  /// Item name of the map it is shown on.
  const std::string& ShownMap() const { return hovered ? hovered_map : pinned_map; }
};

/// Call once a frame before the maps.
void BeginProbe(MapProbe& probe);
/// Cell of the place shown; empty without one or where the map does not reach.
std::optional<Cell> ProbeCell(const MapProbe& probe, const GridGeometry& geometry);
/// Call with what DrawMapPicture or DrawMapPanel returned: follows the pointer, pins on a click and
/// moves the pin by the arrow keys.
void OfferProbe(const MapView& view, const MapAnswer& answer, MapProbe& probe);
/// Why the cell shown is as it is, in a box beside it; call last, after all panels. The box keeps
/// inside `body`, off the probed cell, WAVE OFF, the ring on the picture and the buttons that
/// commit, stop or apply; where no such place is left it is not drawn.
void DrawProbeWhy(UiFrame& ui, const Rect& body, const TerrainDecision* decision,
                  const MapProbe& probe, Timestamp now);
/// Cross-hair on a picture, at the height of the map. Nothing where the height is unknown.
void DrawProbeOnPicture(UiFrame& ui, const PictureView& view, const TerrainDecision* decision,
                        const MapProbe& probe);
/// The right camera of a rectified pair whose left one is `left`; empty without a rig.
std::optional<PictureView> RightView(const EngineSnapshot& snap, const PictureView& left,
                                     const Rect& image);

}  // namespace palace
