#include <cmath>

#include "engine/core/units.h"
#include "gui/panels/fly_panels.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

double ValueAt(const GridF* grid, Cell cell) {
  if (grid == nullptr || cell.row < 0 || cell.col < 0 || cell.row >= grid->rows() ||
      cell.col >= grid->cols()) {
    return NAN;
  }
  return static_cast<double>(grid->at(cell));
}

/// Everything but the value of the four maps that are not the safe distance.
std::array<MapView, 5> Views(const EngineSnapshot& snap, const MapRowState& state,
                             const UiFrame& ui) {
  std::array<MapView, 5> views;
  constexpr const char* kKeys[] = {"elevation", "slope", "roughness", "cost"};
  constexpr const char* kTitles[] = {"Elevation", "Slope", "Roughness", "Cost"};
  const TerrainDecision* shown = ShownDecision(snap);
  for (std::size_t i = 0; i < 4; ++i) {
    views[i].key = kKeys[i];
    views[i].title = kTitles[i];
    views[i].texture = ui.textures.maps[i];
    views[i].ramp = static_cast<Ramp>(i);
    views[i].preview = snap.preview != nullptr;
  }
  views[4] = SafeDistanceMap(snap, ui);
  if (shown == nullptr || !shown->elevation || !shown->hazards) {
    return views;
  }
  for (MapView& view : views) {
    view.geometry = shown->hazards->geometry;
    view.flags = &shown->hazards->flags;
  }
  const SladSettings& slad = shown->settings;
  const SladSettings& wanted = snap.preview_settings.slad;
  views[0].values = &shown->elevation->height_m;
  views[0].low = Fixed(static_cast<double>(state.elevation_low_m), 1) + " m";
  views[0].high = Fixed(static_cast<double>(state.elevation_high_m), 1) + " m+";
  views[1].values = &shown->hazards->slope_rad;
  views[1].low = "0°";
  views[1].high = Fixed(2 * slad.max_slope_deg, 0) + "°+";
  views[1].limit = {"max " + Fixed(slad.max_slope_deg, DecimalsOf(slad.max_slope_deg, 0)) + "°",
                    0.5f,
                    NAN,
                    "slad.max_slope_deg",
                    wanted.max_slope_deg,
                    2 * slad.max_slope_deg};
  views[2].values = &shown->hazards->roughness_m;
  views[2].low = "0 cm";
  views[2].high = Fixed(250 * slad.max_deviation_m, 0) + " cm+";
  views[2].limit = {
      "max " + Fixed(100 * slad.max_deviation_m, DecimalsOf(100 * slad.max_deviation_m, 0)) + " cm",
      0.4f,
      NAN,
      "slad.max_deviation_m",
      wanted.max_deviation_m,
      2.5 * slad.max_deviation_m};
  views[3].values = &shown->hazards->cost;
  views[3].low = "0.0";
  views[3].high = "";
  views[3].limit = {"limit 1.0", 1.0f, NAN, "", 1, 1};
  if (snap.preview && snap.applied) {
    const SladSettings& applied = snap.applied->settings;
    views[1].limit.applied_at =
        static_cast<float>(applied.max_slope_deg / (2 * slad.max_slope_deg));
    views[2].limit.applied_at =
        static_cast<float>(applied.max_deviation_m / (2.5 * slad.max_deviation_m));
    views[4].limit.applied_at =
        static_cast<float>(applied.clear_radius_m() / (2.5 * slad.clear_radius_m()));
  }
  return views;
}

std::string ValueText(std::size_t map, double value) {
  switch (map) {
    case 1:
      return Fixed(Deg(value), 1) + (std::isfinite(value) ? "°" : "");
    case 2:
      return Fixed(value * 100, 1) + (std::isfinite(value) ? " cm" : "");
    case 3:
      return Fixed(value, 2);
    case 4:
      return Fixed(value, 1) + (std::isfinite(value) ? " m" : "");
    default:
      return Fixed(value, 2) + (std::isfinite(value) ? " m" : "");
  }
}

}  // namespace

void DrawMapRowPanel(const EngineSnapshot& snap, const std::array<Rect, 5>& rects, float side,
                     std::uint64_t highlighted, bool letters, MapRowState& state, UiFrame& ui) {
  std::array<MapView, 5> views = Views(snap, state, ui);
  MapMarks marks = MarksOf(snap, highlighted);
  marks.letters = letters;
  marks.probe = ProbeCell(state.probe, views[0].geometry);
  std::optional<Cell> at = marks.probe;
  char letter = 0;
  if (!at && marks.selected) {
    at = views[0].geometry.rows > 0
             ? views[0].geometry.CellFromPoint(marks.selected->p_WS.x(), marks.selected->p_WS.y())
             : std::nullopt;
    letter = letters ? marks.selected->letter : '\0';
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].letter = letter;
    views[i].value = at ? ValueText(i, ValueAt(views[i].values, *at)) : std::string();
    const auto cell = DrawMapPanel(ui, rects[i], side, views[i], marks, state.drag);
    OfferProbe(ui, views[i], cell, state.probe);
  }
}

}  // namespace palace
