#include "gui/panels/map_probe.h"

#include <cmath>

namespace palace {

void BeginProbe(MapProbe& probe) {
  probe.hovered = probe.next;
  probe.next.reset();
}

std::optional<Cell> ProbeCell(const MapProbe& probe, const GridGeometry& geometry) {
  const std::optional<Eigen::Vector2d>& at = probe.Shown();
  return at && geometry.rows > 0 ? geometry.CellFromPoint(at->x(), at->y()) : std::nullopt;
}

void OfferProbe(UiFrame& ui, const MapView& view, std::optional<Cell> cell, MapProbe& probe) {
  if (!cell) {
    return;
  }
  const GridGeometry& g = view.geometry;
  const Eigen::Vector2d at(g.NorthOfRow(cell->row), g.EastOfCol(cell->col));
  probe.next = at;
  const Item* square = ui.items.Find("map/" + view.key);
  if (square == nullptr || !Clicked(ui, square->rect)) {
    return;
  }
  const bool again = probe.pinned && (*probe.pinned - at).norm() < 1.5 * g.cell_m;
  probe.pinned = again ? std::nullopt : std::optional<Eigen::Vector2d>(at);
  ui.intents.push_back(UiAction(PinProbe{!again, *cell}));
}

void DrawProbeOnPicture(UiFrame& ui, const PictureView& view, const TerrainDecision* decision,
                        const MapProbe& probe) {
  if (decision == nullptr || !decision->elevation) {
    return;
  }
  const std::optional<Cell> cell = ProbeCell(probe, decision->elevation->geometry);
  if (!cell) {
    return;
  }
  const double height_m = static_cast<double>(decision->elevation->height_m.at(*cell));
  if (!std::isfinite(height_m)) {
    return;
  }
  const Eigen::Vector2d& ground = *probe.Shown();
  const auto at = view.ScreenFromPoint({ground.x(), ground.y(), -height_m});
  if (!at || !view.rect.Contains(*at)) {
    return;
  }
  const Style& s = ui.style;
  const float x = std::round(at->x), y = std::round(at->y);
  ImDrawList* dl = Canvas();
  const ImU32 dark = WithAlpha(picture::kBlack, 0.5f);
  FillRect(dl, {x - s.Px(1), view.rect.y, s.Px(3), view.rect.h}, dark);
  FillRect(dl, {view.rect.x, y - s.Px(1), view.rect.w, s.Px(3)}, dark);
  FillRect(dl, {x, view.rect.y, s.Px(1), view.rect.h}, picture::kWhite);
  FillRect(dl, {view.rect.x, y, view.rect.w, s.Px(1)}, picture::kWhite);
}

std::optional<PictureView> RightView(const EngineSnapshot& snap, const PictureView& left,
                                     const Rect& image) {
  if (!snap.rig) {
    return std::nullopt;
  }
  PictureView right = left;
  right.rect = image;
  right.X_WC.p += left.X_WC.R * Eigen::Vector3d(snap.rig->baseline_m, 0, 0);
  return right;
}

}  // namespace palace
