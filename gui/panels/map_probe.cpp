#include "gui/panels/map_probe.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"
#include "gui/widgets/why_box.h"

namespace palace {

void BeginProbe(MapProbe& probe) {
  probe.hovered = probe.next;
  probe.hovered_map = std::move(probe.next_map);
  probe.next.reset();
  probe.next_map.clear();
}

std::optional<Cell> ProbeCell(const MapProbe& probe, const GridGeometry& geometry) {
  const std::optional<Eigen::Vector2d>& at = probe.Shown();
  return at && geometry.rows > 0 ? geometry.CellFromPoint(at->x(), at->y()) : std::nullopt;
}

namespace {

void Pin(const MapView& view, Cell cell, MapProbe& probe) {
  probe.pinned =
      Eigen::Vector2d(view.geometry.NorthOfRow(cell.row), view.geometry.EastOfCol(cell.col));
  probe.pinned_map = "map/" + view.key;
}

/// Arrows move the pin, from the middle of the map when there is none; Enter takes it away again.
void PinByKeys(const MapView& view, const MapAnswer& answer, MapProbe& probe) {
  const GridGeometry& g = view.geometry;
  if (answer.key_pressed && probe.pinned) {
    probe.pinned.reset();
    return;
  }
  if (!answer.key_pressed && answer.rows_up == 0 && answer.cols_right == 0) {
    return;
  }
  const auto at =
      probe.pinned ? g.CellFromPoint(probe.pinned->x(), probe.pinned->y()) : std::optional<Cell>();
  const Cell from = at.value_or(Cell{g.rows / 2, g.cols / 2});
  Pin(view,
      {std::clamp(from.row - answer.rows_up, 0, g.rows - 1),
       std::clamp(from.col + answer.cols_right, 0, g.cols - 1)},
      probe);
}

}  // namespace

void OfferProbe(const MapView& view, const MapAnswer& answer, MapProbe& probe) {
  const GridGeometry& g = view.geometry;
  if (g.rows <= 0 || g.cols <= 0) {
    return;
  }
  PinByKeys(view, answer, probe);
  if (!answer.under_pointer) {
    return;
  }
  const Cell cell = *answer.under_pointer;
  const Eigen::Vector2d at(g.NorthOfRow(cell.row), g.EastOfCol(cell.col));
  probe.next = at;
  probe.next_map = "map/" + view.key;
  if (answer.clicked) {
    const bool again = probe.pinned && (*probe.pinned - at).norm() < 1.5 * g.cell_m;
    Pin(view, cell, probe);
    if (again) {
      probe.pinned.reset();
    }
  }
}

namespace {

/// A pin that the map does not reach any more is told on the map that it was set on; it comes back
/// with its ground.
void TellPinBeyond(UiFrame& ui, const Rect& square, const GridGeometry& g, const MapProbe& probe) {
  if (probe.hovered || !probe.pinned || g.rows <= 0 || ProbeCell(probe, g)) {
    return;
  }
  const Eigen::Vector2d& pin = *probe.pinned;
  const double north_m = std::max({0.0, pin.x() - g.north_max_m(), g.north_min_m - pin.x()});
  const double east_m = std::max({0.0, pin.y() - g.east_max_m(), g.east_min_m - pin.y()});
  TextPlate(ui, square, Corner::kTopLeft,
            "Pin " + Fixed(std::hypot(north_m, east_m), 0) + " m off the map");
}

}  // namespace

void DrawProbeWhy(UiFrame& ui, const Rect& body, const TerrainDecision* decision,
                  const MapProbe& probe, Timestamp now) {
  const Item* square = probe.Shown() ? ui.items.Find(probe.ShownMap()) : nullptr;
  if (square != nullptr && decision != nullptr && decision->hazards) {
    TellPinBeyond(ui, square->rect, decision->hazards->geometry, probe);
  }
  if (ui.explain_cell == nullptr || square == nullptr || ui.blocked_by_popup ||
      decision == nullptr || !decision->elevation || !decision->hazards) {
    return;
  }
  const GridGeometry& g = decision->hazards->geometry;
  const std::optional<Cell> cell = ProbeCell(probe, g);
  if (!cell) {
    return;
  }
  const CellExplanation why = ui.explain_cell(*decision, *cell);
  const Style& s = ui.style;
  const float across = square->rect.w / static_cast<float>(g.cols);
  const float down = square->rect.h / static_cast<float>(g.rows);
  const float side_x = std::max(across, s.Px(24)), side_y = std::max(down, s.Px(24));
  const ImVec2 middle{square->rect.x + across * (static_cast<float>(cell->col) + 0.5F),
                      square->rect.y + down * (static_cast<float>(cell->row) + 0.5F)};
  const Rect anchor{middle.x - side_x / 2, middle.y - side_y / 2, side_x, side_y};
  std::vector<Rect> avoid = {ui.wave_off_rect};
  for (const char* name :
       {"ring", "approve", "refuse", "hold_here", "acknowledge_wave_off", "apply", "discard",
        "next_look", "turn_left", "turn_right", "climb", "look_at_pin"}) {
    if (const Item* item = ui.items.Find(name)) {
      avoid.push_back(item->rect);
    }
  }
  if (const auto place = PlaceBeside(anchor, WhyBoxSize(s, why), body, avoid, s.Px(4))) {
    const double map_age_s = SecondsBetween(decision->map_time, now);
    if (probe.hovered) {
      DrawWhyBox(ui, *place, why, map_age_s);
    } else {  // pinned: it stays, so it must shield what it covers
      BeginOverlay("##why", *place);
      DrawWhyBox(ui, *place, why, map_age_s);
      EndOverlay();
    }
  }
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
  const double height_m = static_cast<double>(decision->elevation->Measured().at(*cell));
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
  if (!snap.sensors->rig) {
    return std::nullopt;
  }
  PictureView right = left;
  right.rect = image;
  right.X_WC.p += left.X_WC.R * Eigen::Vector3d(snap.sensors->rig->baseline_m, 0, 0);
  return right;
}

}  // namespace palace
