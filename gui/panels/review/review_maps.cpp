// Maps of Review: recorded, re-decided, and what became of each safe cell.
#include <cmath>
#include <span>

#include "gui/panels/review/review.h"
#include "gui/render/map_colours.h"
#include "gui/widgets/map/cell_hatch.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

/// "10°, 7.5 cm": in as few digits as tell it, for a title beside it in a narrow window.
std::string LimitWords(const SladSettings& slad) {
  const double slope_deg = slad.limits.max_slope_deg, rough_cm = slad.limits.max_deviation_m * 100;
  return Fixed(slope_deg, DecimalsOf(slope_deg, 0)) + "°, " +
         Fixed(rough_cm, DecimalsOf(rough_cm, 0)) + " cm";
}

Rect SquareIn(const Rect& panel, const Rect& content, const Style& s) {
  const float side = std::min(panel.w, panel.bottom() - s.Px(4) - content.y);
  return {std::round(content.centre().x - side / 2), content.y, side, side};
}

MapMarks MarksAt(const EngineSnapshot& snap, const TerrainDecision* decision,
                 const LandingSite* best, const MapProbe& probe) {
  MapMarks marks;
  if (decision == nullptr) {
    return marks;
  }
  marks.sites = &decision->selection.sites;
  if (best != nullptr) {
    marks.selected = *best;
  }
  if (decision->hazards) {
    marks.probe = ProbeCell(probe, decision->hazards->geometry);
  }
  MarkLanding(snap, marks);
  return marks;
}

/// `key`: its name among the items, whatever its title says.
void DrawReviewMap(UiFrame& ui, const EngineSnapshot& snap, const Rect& rect, const char* key,
                   const char* title, const std::string& fact, const TerrainDecision* decision,
                   const LandingSite* best, ImTextureID texture, MapProbe& probe) {
  const MapMarks marks = MarksAt(snap, decision, best, probe);
  MapView view =
      MakeMapView(MapKind::kSafeDistance,
                  {.decision = decision, .cursor = marks.probe, .site = best}, ui.textures);
  view.texture = texture;
  view.key = key;
  // While probing, the value under the cross-hair stands in place of the limits.
  const Rect content =
      DrawPanelFrame(ui, rect, title, {{marks.probe ? view.value : fact, 0, false, false}});
  OfferProbe(view, DrawMapPicture(ui, SquareIn(rect, content, ui.style), view, marks), probe);
}

constexpr float kHatchWidth = 1.3f, kHatchApart = 6;
constexpr ImU32 kHatchInk = WithAlpha(picture::kBlack, 0.6f);

/// In the lower left corner of the square, in a row; where it has no room for three, what is kept
/// needs no word.
void DrawDifferenceLegend(UiFrame& ui, const Rect& square) {
  const Style& s = ui.style;
  struct Entry {
    const char* words;
    Rgba8 colour;
    bool hatched;
  };
  constexpr Entry kAll[] = {
      {"Lost", kLostSafe, true}, {"Gained", kGainedSafe, true}, {"Kept safe", kKeptSafe, false}};
  std::span<const Entry> entries = kAll;
  const float side = s.Px(12), margin = s.Px(6), height = s.Px(22);
  const auto width = [&] {
    float sum = margin;
    for (const Entry& entry : entries) {
      sum += side + TextWidth(s.caption, entry.words) + 3 * margin;
    }
    return sum;
  };
  if (width() + 2 * margin > square.w) {
    entries = entries.first(2);
  }
  const Rect plate{square.x + margin, square.bottom() - margin - height, width(), height};
  FillRect(Canvas(), plate, picture::kPlate, s.Fine(3));
  ui.items.Add("legend/difference", plate, true, "");
  float x = plate.x + margin;
  const float y = plate.centre().y;
  for (const Entry& entry : entries) {
    const Rect swatch{x, y - side / 2, side, side};
    FillRect(Canvas(), swatch, IM_COL32(entry.colour.r, entry.colour.g, entry.colour.b, 255));
    if (entry.hatched) {
      Hatch(Canvas(), swatch, kHatchInk, s.Fine(kHatchWidth), s.Px(kHatchApart));
    }
    x = swatch.right() + margin;
    x += DrawText(ui, s.caption, picture::kPlateText, x, y, entry.words) + 2 * margin;
  }
}

void DrawDifference(const EngineSnapshot& snap, const Grid<std::uint8_t>& changed,
                    const Rect& panel, const TerrainDecision* recorded, MapProbe& probe,
                    UiFrame& ui) {
  const Style& s = ui.style;
  const TerrainDecision* now = snap.terrain->applied.get();
  const int rebuilding = snap.terrain->maps_to_rebuild;  // of half a map nothing is compared
  const bool moved = rebuilding == 0 && snap.terrain->recorded != nullptr &&
                     ui.textures.difference != nullptr && now != nullptr && now->hazards &&
                     recorded->hazards;
  const double change_m2 = SafeArea(now) - SafeArea(recorded);
  const std::string change_words =
      std::isfinite(change_m2) ? (change_m2 > 0 ? "+" : "") + Fixed(change_m2, 0) + " m² safe"
                               : std::string("––");
  const Rect content =
      DrawPanelFrame(ui, panel, "Difference", {{moved ? change_words : "none", 0, false, false}});
  const Rect area = SquareIn(panel, content, s);
  if (!moved) {
    FillRect(Canvas(), area, s.palette.plot_floor);
    DrawText(ui, s.caption, s.palette.text2, area.centre().x, area.centre().y,
             !FollowsRecord(snap.session->role) ? "Only of a log"
             : LimitsMoved(snap) == 0           ? "Same limits"
             : rebuilding > 0                   ? "Map being built anew"
                                                : "No map yet",
             Align::kCentre);
    ui.items.Add("map/Difference", area, true, "Difference");
    return;
  }
  MapView view = MakeMapView(MapKind::kSafeDistance, {.decision = now}, ui.textures);
  view.texture = ui.textures.difference;
  view.key = "Difference";
  view.title = "Difference";
  MapMarks none;
  none.probe = ProbeCell(probe, now->hazards->geometry);
  const MapAnswer answer = DrawMapPicture(ui, area, view, none);
  const Rect& square = answer.square;
  DrawCellHatch(
      Canvas(), square,
      {changed.cols(), changed.rows(), 0, kHatchInk, s.Fine(kHatchWidth), s.Px(kHatchApart)},
      [&](int row, int col) { return changed.at(row, col) != 0; });
  if (const LandingSite* best = BestSite(snap, now)) {
    const GridGeometry& g = now->hazards->geometry;
    const float per_m = square.w / static_cast<float>(g.cols * g.cell_m);
    const ImVec2 at{square.x + static_cast<float>(best->p_WS.y() - g.east_min_m) * per_m,
                    square.y + static_cast<float>(g.north_max_m() - best->p_WS.x()) * per_m};
    Canvas()->PushClipRect(square.min(), square.max(), true);
    DrawRing(s, Canvas(), at, static_cast<float>(best->clear_radius_m) * per_m,
             RingKind::kProposed);
    Canvas()->PopClipRect();
  }
  DrawDifferenceLegend(ui, square);
  OfferProbe(view, answer, probe);
}

}  // namespace

Grid<std::uint8_t> ChangedCells(const EngineSnapshot& snap) {
  const TerrainDecision* before = snap.terrain->recorded.get();
  const TerrainDecision* now = snap.terrain->applied.get();
  if (before == nullptr || now == nullptr || !before->hazards || !now->hazards) {
    return {};
  }
  const GridGeometry& g = now->hazards->geometry;
  Grid<std::uint8_t> changed(g.rows, g.cols);
  for (int row = 0; row < g.rows; ++row) {
    for (int col = 0; col < g.cols; ++col) {
      const auto there =
          before->hazards->geometry.CellFromPoint(g.NorthOfRow(row), g.EastOfCol(col));
      const bool was = there && CanBearLander(*before->hazards, *there);
      changed.at(row, col) = was != CanBearLander(*now->hazards, {row, col}) ? 1 : 0;
    }
  }
  return changed;
}

void DrawReviewMaps(const EngineSnapshot& snap, const ReviewDigest& digest, const Rect& row,
                    float w, MapProbe& probe, UiFrame& ui) {
  const TerrainDecision* recorded = snap.terrain->OfRecord().get();
  const TerrainDecision* now = snap.terrain->applied.get();
  const float step = w + ui.style.Px(8);
  const bool log = FollowsRecord(snap.session->role);
  DrawReviewMap(
      ui, snap, {row.x, row.y, w, row.h}, log ? "Recorded" : "As decided",
      !log                                ? "As decided"
      : SeenFromStart(snap.session->role) ? "Recorded"
                                          : "Rebuilt",  // after a jump it is not the flight's own
      recorded != nullptr ? LimitWords(recorded->settings) : "", recorded, BestSite(snap, recorded),
      snap.terrain->recorded ? ui.textures.recorded_safe_distance : ui.textures.maps[4], probe);
  DrawReviewMap(ui, snap, {row.x + step, row.y, w, row.h}, "Re-decided", "Re-decided",
                now != nullptr ? LimitWords(now->settings) : "", now, BestSite(snap, now),
                ui.textures.maps[4], probe);
  DrawDifference(snap, digest.changed_cells, {row.x + 2 * step, row.y, w, row.h}, recorded, probe,
                 ui);
}

}  // namespace palace
