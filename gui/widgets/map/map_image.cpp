#include "gui/widgets/map/map_image.h"

#include <algorithm>

#include "engine/model/hazard_maps.h"
#include "engine/model/settings/settings.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/map/cell_hatch.h"
#include "gui/widgets/map/flag_marks.h"
#include "gui/widgets/map/letter_places.h"
#include "gui/widgets/map/site_marks.h"

namespace palace {

namespace {

ImVec2 ScreenFromGround(const Rect& square, const GridGeometry& g, double north_m, double east_m) {
  const double across = (east_m - g.east_min_m) / (g.cols * g.cell_m);
  const double down = (g.north_max_m() - north_m) / (g.rows * g.cell_m);
  return {square.x + static_cast<float>(across) * square.w,
          square.y + static_cast<float>(down) * square.h};
}

void DrawFootprint(const Style& s, const Rect& square, const MapView& view,
                   const std::vector<Eigen::Vector2d>& footprint) {
  if (footprint.size() < 3) {
    return;
  }
  std::vector<ImVec2> outline;
  for (const Eigen::Vector2d& corner : footprint) {
    outline.push_back(ScreenFromGround(square, view.geometry, corner.x(), corner.y()));
  }
  outline.push_back(outline.front());
  ImDrawList* dl = Canvas();
  for (std::size_t i = 1; i < outline.size(); ++i) {
    dl->AddLine(outline[i - 1], outline[i], WithAlpha(picture::kBlack, 0.7f), s.Fine(3));
  }
  DashedPolyline(dl, outline, picture::kWhite, s.Fine(1.2f), s.Fine(5), s.Fine(4));
}

constexpr float kLetterRadius = 9, kPlateSide = 16;  // of a letter's disc; of the selected one's

void DrawMapSites(UiFrame& ui, const Rect& square, const MapView& view, const MapMarks& marks) {
  const Style& s = ui.style;
  const float px_per_m = square.w / static_cast<float>(view.geometry.cols * view.geometry.cell_m);
  const std::uint64_t selected = marks.selected ? marks.selected->id : 0;
  std::vector<LetterPlace> letters;
  const auto place = [&](const LandingSite& site) {
    return ScreenFromGround(square, view.geometry, site.p_WS.x(), site.p_WS.y());
  };
  if (marks.sites != nullptr && marks.letters) {
    for (const LandingSite& site : *marks.sites) {
      const ImVec2 at = place(site);
      if (site.id != selected && square.Contains(at)) {
        LetterLook look{site.id == marks.highlighted, false, kLetterRadius};
        if (marks.mission != nullptr) {
          look.refused = marks.mission->IsRefused(site.id);
          look.highlighted |= OfferLetter(ui, "map/" + view.key, at, site, *marks.mission).hovered;
        }
        DrawLetterDisc(ui, at, site.letter, look);
        const float half = LetterHalfWidth(s, site.letter, kLetterRadius);
        letters.push_back({site.id, at, {half, s.Fine(kLetterRadius)}});
      }
    }
  }
  const auto ring = [&](const LandingSite& site, bool commanded) {
    DrawRing(s, Canvas(), place(site), static_cast<float>(site.clear_radius_m) * px_per_m,
             commanded ? RingKind::kCommanded : RingKind::kProposed);
  };
  const auto plate = [&](const LandingSite& site) {
    const ImVec2 half = LetterPlateHalf(s, site.letter, kPlateSide);
    const ImVec2 at =
        CornerOfRing({site.id, place(site), half}, {s.Px(16), s.Px(14)}, letters, square);
    letters.push_back({site.id, at, half});
    return at;
  };
  if (marks.selected) {
    const LandingSite& site = *marks.selected;
    ring(site, marks.commanded);
    if (marks.letters && square.Contains(place(site))) {
      const ImVec2 at = plate(site);
      if (marks.mission != nullptr) {
        OfferLetter(ui, "map/" + view.key, at, site, *marks.mission);
      }
      LetterPlate(ui, at, site.letter, true, kPlateSide);
    }
  }
  if (marks.landing && marks.landing->id != selected) {
    const LandingSite& site = *marks.landing;
    ring(site, marks.landing_commanded);
    if (const ImVec2 at = place(site); square.Contains(at)) {
      LetterPlate(ui, plate(site), site.letter, true, kPlateSide);
      ui.items.Add("landing_on_map/" + view.key, {at.x, at.y, 1, 1}, true, site.letter);
    }
  }
}

void DrawProbe(const Style& s, const Rect& square, const MapView& view, Cell cell) {
  const ImVec2 at = ScreenFromGround(square, view.geometry, view.geometry.NorthOfRow(cell.row),
                                     view.geometry.EastOfCol(cell.col));
  FillRect(Canvas(), {std::round(at.x), square.y, s.Px(1), square.h}, picture::kWhite);
  FillRect(Canvas(), {square.x, std::round(at.y), square.w, s.Px(1)}, picture::kWhite);
}

/// Mouse and keyboard on the tick: where it is moved to.
std::optional<TickMove> RunTick(UiFrame& ui, const Rect& bar, float tick_x, const LimitTick& limit,
                                LimitDrag& drag) {
  const Style& s = ui.style;
  const Rect grab{tick_x - s.Px(10), bar.y - s.Px(10), s.Px(20), s.Px(24)};
  const Interaction in = Interact(ui, "tick/" + limit.setting, grab, kSideSteps, limit.label);
  if (in.hovered || in.held) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  }
  const SettingInfo* info = FindSetting(limit.setting);
  if (info == nullptr) {
    return std::nullopt;
  }
  const double from = limit.asked.value_or(limit.value);
  if (in.pressed) {
    drag = {in.pointer.x, from, limit.per_bar / static_cast<double>(bar.w), from};
  }
  const double step = std::pow(10.0, -info->decimals) / info->shown_per_unit;
  double wanted = from + in.step_right * step, last = from;
  if (in.held) {
    wanted = drag.start_value + static_cast<double>(in.pointer.x - drag.start_x) * drag.per_px;
    last = drag.last_value;
  }
  const double value = ClampSetting(*info, std::round(wanted / step) * step);
  if ((in.held || in.step_right != 0) && std::abs(value - last) > step * 1e-3) {
    drag.last_value = value;
    return TickMove{limit.setting, value, grab};
  }
  return std::nullopt;
}

void DrawTick(const Style& s, const Rect& bar, float x) {
  ImDrawList* dl = Canvas();
  FillRect(dl, {x - s.Px(2), bar.y - s.Px(2), s.Px(4), bar.h + s.Px(4)}, picture::kBlack);
  FillRect(dl, {x - s.Px(1), bar.y - s.Px(2), s.Px(2), bar.h + s.Px(4)}, s.palette.white_mark);
  dl->AddTriangleFilled({x - s.Fine(5), bar.y - s.Fine(8)}, {x + s.Fine(5), bar.y - s.Fine(8)},
                        {x, bar.y - s.Fine(1)}, s.palette.white_mark);
}

}  // namespace

Rect MapWithin(const Rect& area, const GridGeometry& geometry) {
  if (geometry.rows <= 0 || geometry.cols <= 0) {
    return area;
  }
  const auto rows = static_cast<float>(geometry.rows), cols = static_cast<float>(geometry.cols);
  const float cell = std::min(area.w / cols, area.h / rows);
  const float w = std::round(cols * cell), h = std::round(rows * cell);
  return {area.x + std::floor((area.w - w) / 2), area.y + std::floor((area.h - h) / 2), w, h};
}

MapAnswer DrawMapPicture(UiFrame& ui, const Rect& area, const MapView& view,
                         const MapMarks& marks) {
  const Style& s = ui.style;
  ImDrawList* dl = Canvas();
  const bool known = view.values != nullptr && !view.values->empty();
  const Rect square = known ? MapWithin(area, view.geometry) : area;
  FillRect(dl, area, s.palette.plot_floor);  // beyond the map
  dl->PushClipRect(square.min(), square.max(), true);
  if (!known) {
    UnknownFill(s, dl, square);
  } else {
    FillRect(dl, square, picture::kUnknown);
    if (view.texture != nullptr) {
      dl->AddImage(view.texture, square.min(), square.max());
    }
    const GridF& values = *view.values;
    const bool has_reasons = view.reasons != nullptr && view.reasons->rows() == values.rows() &&
                             view.reasons->cols() == values.cols();
    const auto unknown = [&](int row, int col) {
      return !std::isfinite(values.at(row, col)) ||
             (has_reasons && (view.reasons->at(row, col) & kHazardUnknown) != 0);
    };
    DrawCellHatch(dl, square,
                  {values.cols(), values.rows(), picture::kUnknown, picture::kUnknownLine,
                   s.Fine(1), s.Px(6)},
                  unknown);
    if (view.flags != nullptr) {
      DrawFlagsOnMap(s, square, *view.flags);
    }
    DrawFootprint(s, square, view, marks.footprint);
    DrawMapSites(ui, square, view, marks);
    if (marks.probe && view.geometry.Contains(*marks.probe)) {
      DrawProbe(s, square, view, *marks.probe);
    }
  }
  if (known && !view.old.empty()) {
    StaleVeil(s, dl, square);
    TextPlate(ui, square, Corner::kBottomLeft, view.old);
    ui.items.Add("old/" + view.key, square, true, view.old);
  }
  dl->PopClipRect();
  MapAnswer answer;
  if (view.preview) {
    const Rect chip = PreviewChip(ui, {square.x + s.Px(8), square.y + s.Px(8)}, "PREVIEW ×");
    const Interaction on =
        Interact(ui, "discard_preview/" + view.key, chip, kNoTab, "Discard the preview");
    answer.discards = on.clicked;
    if (on.hovered) {
      DrawTooltip(ui, "Discard the preview: the maps show the limits in force again");
    }
  }
  const Interaction in = Interact(ui, "map/" + view.key, square,
                                  kAllSteps | kKeepsStop | (known ? 0U : unsigned{kDisabled}),
                                  view.title + " " + view.value);
  answer.square = square;
  answer.clicked = in.clicked && !in.key_pressed;
  answer.key_pressed = in.key_pressed;
  answer.rows_up = in.step_up;
  answer.cols_right = in.step_right;
  const Cell cell{static_cast<int>((in.pointer.y - square.y) / square.h *
                                   static_cast<float>(view.geometry.rows)),
                  static_cast<int>((in.pointer.x - square.x) / square.w *
                                   static_cast<float>(view.geometry.cols))};
  if (known && in.hovered && view.geometry.Contains(cell)) {
    answer.under_pointer = cell;
  }
  return answer;
}

std::optional<TickMove> DrawColourBar(UiFrame& ui, const Rect& bar, const MapView& view,
                                      LimitDrag* drag) {
  const Style& s = ui.style;
  std::optional<TickMove> move;
  DrawRampBar(Canvas(), bar, view.ramp);
  const float label_y = bar.bottom() + s.Px(12);
  const bool has_limit = std::isfinite(view.limit.at);
  float limit_from = 0;
  float limit_to = 0;
  if (has_limit) {
    const float dashed_at = view.limit.asked ? view.limit.at : view.limit.applied_at;
    const float asked_at =
        view.limit.asked
            ? view.limit.at +
                  static_cast<float>((*view.limit.asked - view.limit.value) / view.limit.per_bar)
            : view.limit.at;
    if (std::isfinite(dashed_at)) {
      const float x = bar.x + std::clamp(dashed_at, 0.0f, 1.0f) * bar.w;
      DashedLine(Canvas(), {x, bar.y - s.Px(6)}, {x, bar.bottom() + s.Px(4)}, s.palette.white_mark,
                 s.Fine(1), s.Fine(3), s.Fine(2));
    }
    const float x = std::round(bar.x + std::clamp(asked_at, 0.0f, 1.0f) * bar.w);
    DrawTick(s, bar, x);
    const float width = TextWidth(s.medium, view.limit.label);
    limit_from = std::clamp(x - width / 2, bar.x, bar.right() - width);
    limit_to = limit_from + width;
    DrawText(ui, s.medium, s.palette.text1, limit_from, label_y, view.limit.label);
    if (drag != nullptr && !view.limit.setting.empty()) {
      move = RunTick(ui, bar, x, view.limit, *drag);
    }
  }
  const float keep = s.Px(8);
  const float low_end = bar.x + TextWidth(s.caption, view.low);
  if (!has_limit || low_end + keep < limit_from) {
    DrawText(ui, s.caption, s.palette.text2, bar.x, label_y, view.low);
  }
  const float high_from = bar.right() - TextWidth(s.caption, view.high);
  if (!has_limit || high_from - keep > limit_to) {
    DrawText(ui, s.caption, s.palette.text2, bar.right(), label_y, view.high, Align::kRight);
  }
  return move;
}

MapAnswer DrawMapPanel(UiFrame& ui, const Rect& panel, float side, const MapView& view,
                       const MapMarks& marks, LimitDrag& drag) {
  const Style& s = ui.style;
  const Rect content = DrawPanelFrame(
      ui, panel, view.title,
      {{view.letter, s.palette.text3, false, false}, {view.value, s.palette.text1, true, false}});
  const Rect square{std::round(content.x + (content.w - side) / 2), content.y, side, side};
  MapAnswer answer = DrawMapPicture(ui, square, view, marks);
  const Rect bar{panel.x + s.Px(12), square.bottom() + s.Px(12), panel.w - s.Px(24), s.Px(8)};
  answer.tick = DrawColourBar(ui, bar, view, &drag);
  return answer;
}

}  // namespace palace
