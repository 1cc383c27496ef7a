#include "gui/widgets/map/camera_overlay.h"

#include <algorithm>

#include "engine/model/ground_class.h"
#include "gui/widgets/map/cell_hatch.h"
#include "gui/widgets/map/contour.h"
#include "gui/widgets/map/flag_marks.h"

namespace palace {

void DrawVerdict(UiFrame& ui, const Rect& image, std::shared_ptr<const ImageU8> verdict,
                 OverlayCache& cache) {
  if (!verdict || verdict->empty()) {
    return;
  }
  if (cache.verdict != verdict) {
    cache.contours = SafeContours(*verdict);
    cache.verdict = verdict;
  }
  const Style& s = ui.style;
  ImDrawList* dl = Canvas();
  const ImageU8& v = *verdict;
  DrawCellHatch(
      dl, image,
      {v.width(), v.height(), picture::kUnsafeTint, picture::kUnsafeLine, s.Fine(1.3f), s.Px(9)},
      [&](int row, int col) {
        const auto ground = static_cast<GroundClass>(v.at(col, row));
        return ground == GroundClass::kUnknown || ground == GroundClass::kHazard;
      });
  const float kx = image.w / static_cast<float>(v.width());
  const float ky = image.h / static_cast<float>(v.height());
  std::vector<ImVec2> line;
  for (const std::vector<ImVec2>& contour : cache.contours) {
    line.clear();
    for (const ImVec2& p : contour) {
      line.push_back({image.x + (p.x + 0.5f) * kx, image.y + (p.y + 0.5f) * ky});
    }
    dl->AddPolyline(line.data(), static_cast<int>(line.size()), picture::kSafe, 0, s.Fine(1.5f));
  }
}

void DrawSites(UiFrame& ui, const PictureView& view, const SiteOverlay& overlay) {
  const Style& s = ui.style;
  ImDrawList* dl = Canvas();
  dl->PushClipRect(view.rect.min(), view.rect.max(), true);
  const std::uint64_t selected = overlay.selected ? overlay.selected->id : 0;
  if (overlay.sites != nullptr) {
    for (const LandingSite& site : *overlay.sites) {
      const auto at = view.ScreenFromPoint(site.p_WS);
      if (site.id != selected && at && view.rect.Contains(*at)) {
        DrawLetterDisc(ui, *at, site.letter, site.id == overlay.highlighted);
      }
    }
  }
  if (overlay.ghost) {
    const auto at = view.ScreenFromPoint(overlay.ghost->p_WS);
    if (at) {
      const std::vector<ImVec2> ring =
          ProjectCircle(view, *overlay.ghost, overlay.ghost->clear_radius_m);
      DrawRing(s, dl, ring, *at, RingKind::kGhost);
      const float width = TextWidth(s.caption, overlay.ghost_words) + s.Px(16);
      // In the middle of its ring; below the ring where the selected cross would be hidden.
      const bool covers =
          overlay.selected &&
          (overlay.selected->p_WS - overlay.ghost->p_WS).norm() < overlay.ghost->clear_radius_m;
      float middle_y = at->y;
      std::vector<ImVec2> both = ring;
      if (covers) {
        const std::vector<ImVec2> other =
            ProjectCircle(view, *overlay.selected, overlay.selected->clear_radius_m);
        both.insert(both.end(), other.begin(), other.end());
      }
      for (const ImVec2& point : both) {
        middle_y = covers ? std::max(middle_y, point.y) : middle_y;
      }
      const float half = s.Px(12);
      middle_y += covers ? half + s.Px(6) : 0;
      // A letter in the middle of the ring stays readable.
      for (std::size_t i = 0; overlay.sites != nullptr && i < overlay.sites->size(); ++i) {
        const LandingSite& site = (*overlay.sites)[i];
        const bool under = (site.p_WS - overlay.ghost->p_WS).norm() < 0.5;
        middle_y -= !covers && under && site.id != selected ? s.Px(28) : 0;
      }
      middle_y = std::clamp(middle_y, view.rect.y + half, view.rect.bottom() - s.Px(44) - half);
      const float left = std::clamp(at->x - width / 2, view.rect.x,
                                    std::max(view.rect.x, view.rect.right() - width));
      const Rect plate{std::round(left), std::round(middle_y - half), width, s.Px(24)};
      FillRect(dl, plate, picture::kPlate, s.Fine(3));
      DrawText(ui, s.caption, picture::kPlateText, plate.centre().x, plate.centre().y,
               overlay.ghost_words, Align::kCentre);
    }
  }
  if (overlay.selected) {
    const auto at = view.ScreenFromPoint(overlay.selected->p_WS);
    const std::vector<ImVec2> ring =
        ProjectCircle(view, *overlay.selected, overlay.selected->clear_radius_m);
    if (at && !ring.empty()) {
      DrawRing(s, dl, ring, *at, overlay.commanded ? RingKind::kCommanded : RingKind::kProposed);
      const float radius = static_cast<float>(overlay.selected->clear_radius_m) *
                           view.PixelsPerMetre(overlay.selected->p_WS);
      Rect around{at->x - radius, at->y - radius, 2 * radius, 2 * radius};
      for (const ImVec2& point : ring) {
        const float right = std::max(around.right(), point.x);
        const float bottom = std::max(around.bottom(), point.y);
        around.x = std::min(around.x, point.x);
        around.y = std::min(around.y, point.y);
        around.w = right - around.x;
        around.h = bottom - around.y;
      }
      ui.items.Add("ring", around, true, overlay.selected->letter);
      const ImVec2 plate{at->x + radius * 0.72f + s.Px(10), at->y - radius * 0.72f - s.Px(10)};
      if (view.rect.Contains(plate)) {
        LetterPlate(ui, plate, overlay.selected->letter, true);
      }
    }
  }
  dl->PopClipRect();
}

void DrawTracker(UiFrame& ui, const PictureView& view, const TrackerStatus& tracker) {
  if (!tracker.locked) {
    return;
  }
  const Style& s = ui.style;
  ImDrawList* dl = Canvas();
  dl->PushClipRect(view.rect.min(), view.rect.max(), true);
  std::size_t shown = 0;
  for (const TrackedFeature& feature : tracker.features) {
    if (shown++ == 24) {  // more would hide the picture
      break;
    }
    DrawBrackets(s, dl, view.ScreenFromPixel(feature.pixel),
                 feature.inlier ? picture::kWhite : Rgb(0x909DAC));
  }
  if (tracker.window_side_px > 0 && tracker.site_in_picture) {
    DrawSearchWindow(s, dl, view.ScreenFromPixel(tracker.window_centre),
                     static_cast<float>(tracker.window_side_px) * view.ScalePx());
  }
  dl->PopClipRect();
}

void DrawVerdictLegend(UiFrame& ui, const Rect& image, unsigned flags) {
  const Style& s = ui.style;
  const char* safe = "Safe";
  const char* over = "Over a limit or unknown";
  const float safe_w = TextWidth(s.caption, safe);
  const float over_w = TextWidth(s.caption, over);
  const float width = s.Px(8 + 14 + 6) + safe_w + s.Px(14 + 14 + 6) + over_w + s.Px(12);
  if (width + s.Px(16) > image.w) {
    return;
  }
  ImDrawList* dl = Canvas();
  const Rect plate = PlateAt(s, dl, image, Corner::kTopLeft, width, s.Px(26));
  const float y = plate.centre().y;
  const float half = s.Px(7);
  float x = plate.x + s.Px(8);
  StrokeRect(dl, {x, y - half, half * 2, half * 2}, picture::kSafe, s.Fine(2));
  x += half * 2 + s.Px(6);
  x += DrawText(ui, s.caption, picture::kPlateText, x, y, safe) + s.Px(14);
  const Rect swatch{x, y - half, half * 2, half * 2};
  FillRect(dl, swatch, WithAlpha(Rgb(0xF5963C), 0.25f));
  Hatch(dl, swatch, Rgb(0xF5963C), s.Fine(2), s.Fine(6));
  x += half * 2 + s.Px(6);
  DrawText(ui, s.caption, picture::kPlateText, x, y, over);
  const float flags_w = FlagLegendWidth(s, flags) + s.Px(12);
  if (flags != 0 && flags_w + s.Px(16) <= image.w) {
    const Rect below{plate.x, plate.bottom() + s.Px(4), flags_w, plate.h};
    FillRect(dl, below, picture::kPlate, s.Fine(3));
    DrawFlagLegend(ui, below.x - s.Px(6), below.centre().y, flags);
  }
}

}  // namespace palace
