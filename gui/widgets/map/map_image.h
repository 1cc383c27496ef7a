// Map panel: square map with nearest cells, hatch on unknown cells, sites, footprint, probe, and a
// colour bar whose limit tick can be dragged.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/landing_site.h"
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
  double per_bar = 0;      ///< setting units over the whole bar
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
  const Grid<std::uint8_t>* flags = nullptr;  ///< TerrainFlag bits; null or empty: none
  std::string low, high;                      ///< labels of the ends
  LimitTick limit;
  bool preview = false;
};

/// Marks shared by all maps.
struct MapMarks {
  const std::vector<LandingSite>* sites = nullptr;
  std::optional<LandingSite> selected;
  std::uint64_t highlighted = 0;
  bool commanded = false;
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

/// What was done to a map.
struct MapAnswer {
  Rect square;
  std::optional<Cell> under_pointer;
  bool clicked = false;
  bool key_pressed = false;         ///< Enter or Space with the focus
  int rows_up = 0, cols_right = 0;  ///< arrow keys, in cells
};

/// Draws the panel (items "map/<key>" and "tick/<setting>"); appends SetSetting while the tick is
/// dragged or stepped.
MapAnswer DrawMapPanel(UiFrame& ui, const Rect& panel, float side, const MapView& view,
                       const MapMarks& marks, LimitDrag& drag);
/// The square picture alone with all its marks.
MapAnswer DrawMapPicture(UiFrame& ui, const Rect& square, const MapView& view,
                         const MapMarks& marks);
/// Colour bar with end labels and limit; `bar` is the 8-unit strip itself. `drag` may be null.
void DrawColourBar(UiFrame& ui, const Rect& bar, const MapView& view, LimitDrag* drag);

}  // namespace palace
