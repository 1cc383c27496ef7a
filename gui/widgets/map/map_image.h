// Map panel: map of one scale both ways with nearest cells, hatch on unknown cells, sites,
// footprint, probe, and a colour bar whose limit tick can be dragged.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/mission/mission_status.h"
#include "gui/widgets/map/colour_ramp.h"
#include "gui/widgets/panel_frame.h"

namespace palace {

/// The limit on a colour bar and what dragging it sets.
struct LimitTick {
  std::string label;       ///< "max 10°"
  float at = NAN;          ///< 0..1 along the bar; NaN: no limit
  float applied_at = NAN;  ///< while previewing: where the applied limit is
  std::string setting;     ///< "slad.max_slope_deg"; empty: cannot be dragged
  double value = 0;        ///< of the setting
  /// A move that waits for its answer: the tick stands there, dashed where the limit is.
  std::optional<double> asked;
  double per_bar = 0;  ///< setting units over the whole bar
};

struct MapView {
  std::string key;     ///< item name: "map/" + key
  std::string title;   ///< "Slope"
  std::string letter;  ///< site the value belongs to; empty: none
  std::string value;   ///< at the site, or under the cursor
  ImTextureID texture = nullptr;
  Ramp ramp = Ramp::kElevation;
  GridGeometry geometry;
  const GridF* values = nullptr;  ///< NaN cells are hatched; null: the whole map is unknown
  /// HazardReason bits, hatched where unknown: a distance of 0 there is none that was measured.
  const Grid<std::uint8_t>* reasons = nullptr;
  const Grid<std::uint8_t>* flags = nullptr;  ///< TerrainFlag bits; null or empty: none
  std::string low, high;                      ///< labels of the ends
  LimitTick limit;
  bool preview = false;
  std::string old;  ///< "11.2 s old", veiled; empty: as good as new
};

/// Marks shared by all maps.
struct MapMarks {
  const std::vector<LandingSite>* sites = nullptr;
  /// Letters select by a click, refused ones are struck through; null: they are marks only.
  const MissionStatus* mission = nullptr;
  std::optional<LandingSite> selected;
  std::uint64_t highlighted = 0;
  bool commanded = false;
  std::optional<LandingSite> landing;  ///< selected or flown to, where that is another one
  bool landing_commanded = false;
  bool letters = true;                     ///< letters of the other sites
  std::vector<Eigen::Vector2d> footprint;  ///< north, east
  std::optional<Cell> probe;
};

/// The drag of a limit tick under way.
struct LimitDrag {
  float start_x = 0;
  double start_value = 0;
  double per_px = 0;
  double last_value = 0;
};

/// A limit that a tick was moved to.
struct TickMove {
  std::string setting;
  double value = 0;
  Rect tick;  ///< where it stands now
};

/// What was done to a map.
struct MapAnswer {
  Rect square;                   ///< where the map lies
  std::optional<TickMove> tick;  ///< of DrawMapPanel: the tick was dragged or stepped
  std::optional<Cell> under_pointer;
  bool clicked = false;
  bool discards = false;            ///< the chip of the preview was pressed
  bool key_pressed = false;         ///< Enter or Space with the focus
  int rows_up = 0, cols_right = 0;  ///< arrow keys, in cells
};

/// Draws the panel (items "map/<key>" and "tick/<setting>").
MapAnswer DrawMapPanel(UiFrame& ui, const Rect& panel, float side, const MapView& view,
                       const MapMarks& marks, LimitDrag& drag);
/// The picture alone with all its marks, in the middle of `area` as large as MapWithin says.
MapAnswer DrawMapPicture(UiFrame& ui, const Rect& area, const MapView& view, const MapMarks& marks);
/// Where a map lies in `area`: as large as it can, of one scale both ways, in whole pixels; all of
/// it for a map without cells.
Rect MapWithin(const Rect& area, const GridGeometry& geometry);
/// Colour bar with end labels and limit; `bar` is the 8-unit strip itself. `drag` may be null: the
/// tick stands still. Returns where it was moved to.
std::optional<TickMove> DrawColourBar(UiFrame& ui, const Rect& bar, const MapView& view,
                                      LimitDrag* drag);

}  // namespace palace
