#include "gui/panels/fly_panels.h"
#include "gui/panels/map_views.h"

namespace palace {

void DrawMapRowPanel(const EngineSnapshot& snap, const std::array<Rect, 5>& rects, float side,
                     bool letters, MapRowState& state, UiFrame& ui) {
  MapMarks marks = MarksOf(snap, ui.highlighted_site);
  marks.letters = letters;
  MapSource source = ShownMap(snap);
  if (source.decision != nullptr && source.decision->hazards) {
    marks.probe = ProbeCell(state.probe, source.decision->hazards->geometry);
  }
  source.cursor = marks.probe;
  source.site = marks.selected ? &*marks.selected : nullptr;
  for (std::size_t i = 0; i < rects.size(); ++i) {
    MapView view = MakeMapView(static_cast<MapKind>(i), source, ui.textures);
    view.preview = snap.terrain->preview != nullptr;
    view.letter = letters ? view.letter : "";
    OfferProbe(view, DrawMapPanel(ui, rects[i], side, view, marks, state.drag), state.probe);
  }
}

}  // namespace palace
