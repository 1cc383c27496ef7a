#include "gui/widgets/map/camera_overlay.h"

#include <algorithm>
#include <string>
#include <vector>

#include "engine/model/ground_class.h"
#include "gui/widgets/map/cell_hatch.h"
#include "gui/widgets/map/contour.h"
#include "gui/widgets/map/letter_places.h"

namespace palace {
namespace {

constexpr float kNoPlaceSpacing = 18;  // twice that of what breaks a limit itself

/// No hazard itself, but a lander put down there would meet one, or stand over a limit: its ring may
/// lie over such ground, for it is put down elsewhere.
bool IsNoPlace(GroundClass ground) {
  return ground == GroundClass::kTooNear || ground == GroundClass::kFootprint;
}

}  // namespace

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
  const auto ground = [&](int row, int col) { return static_cast<GroundClass>(v.at(col, row)); };
  DrawCellHatch(
      dl, image,
      {v.width(), v.height(), picture::kUnsafeTint, picture::kUnsafeLine, s.Fine(1.3f), s.Px(9)},
      [&](int row, int col) {
        const GroundClass g = ground(row, col);
        return g != GroundClass::kLandable && !IsNoPlace(g);
      });
  DrawCellHatch(dl, image,
                {v.width(), v.height(), 0, picture::kNoPlaceLine, s.Fine(1), s.Px(kNoPlaceSpacing)},
                [&](int row, int col) { return IsNoPlace(ground(row, col)); });
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

namespace {

// Items on a picture: a letter, the ring of the best or selected site, of where it is to land.

/// A site that is not the selected one. Returns where its letter stands.
LetterPlace DrawOther(UiFrame& ui, const SiteOverlay& overlay, const LandingSite& site, ImVec2 at) {
  LetterLook look;
  look.highlighted = site.id == overlay.highlighted;
  if (overlay.mission != nullptr) {
    look.refused = overlay.mission->IsRefused(site.id);
    look.highlighted |= OfferLetter(ui, "picture", at, site, *overlay.mission).hovered;
  }
  DrawLetterDisc(ui, at, site.letter, look);
  const float r = ui.style.Px(look.radius);
  const float half = LetterHalfWidth(ui.style, site.letter, look.radius);
  ui.items.Add(kSiteMark, {at.x - half, at.y - r, 2 * half, 2 * r}, true, site.letter);
  return {site.id, at, {half, r}};
}

/// The ring of a site, recorded under a name. False when it cannot be projected.
bool DrawSiteRing(UiFrame& ui, const PictureView& view, const LandingSite& site, RingKind kind,
                  const char* item) {
  const auto at = view.ScreenFromPoint(site.p_WS);
  const std::vector<ImVec2> ring = ProjectCircle(view, site, site.clear_radius_m);
  if (!at || ring.empty()) {
    return false;
  }
  DrawRing(ui.style, Canvas(), ring, *at, kind);
  ImVec2 low = *at, high = *at;
  for (const ImVec2& point : ring) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  ui.items.Add(item, {low.x, low.y, high.x - low.x, high.y - low.y}, true, site.letter);
  return true;
}

/// Beside the best of what is shown: where the vehicle is to land, whatever the maps say now.
void DrawLanding(UiFrame& ui, const PictureView& view, const SiteOverlay& overlay) {
  if (!overlay.landing || (overlay.selected && overlay.selected->id == overlay.landing->id)) {
    return;
  }
  const LandingSite& site = *overlay.landing;
  const RingKind kind = overlay.landing_commanded ? RingKind::kCommanded : RingKind::kProposed;
  const auto at = view.ScreenFromPoint(site.p_WS);
  if (!DrawSiteRing(ui, view, site, kind, kLandingRing) || !view.rect.Contains(*at)) {
    return;
  }
  const Style& s = ui.style;
  const std::string words = overlay.landing_word + " " + site.letter;
  const float width = TextWidth(s.caption, words) + s.Px(16), height = s.Px(24);
  const Rect& r = view.rect;
  const Rect plate{std::clamp(std::round(at->x - width / 2), r.x, std::max(r.x, r.right() - width)),
                   std::clamp(std::round(at->y + s.Px(16)), r.y, r.bottom() - s.Px(44) - height),
                   width, height};
  FillRect(Canvas(), plate, picture::kPlate, s.Fine(3));
  DrawText(ui, s.caption, picture::kPlateText, plate.centre().x, plate.centre().y, words,
           Align::kCentre);
}

/// The letter at a corner of its ring, kept inside the picture.
void DrawRingLetter(UiFrame& ui, const PictureView& view, const SiteOverlay& overlay, ImVec2 at,
                    float radius, const std::vector<LetterPlace>& others) {
  const Style& s = ui.style;
  const LandingSite& site = *overlay.selected;
  const ImVec2 half = LetterPlateHalf(s, site.letter);
  const Rect& r = view.rect;
  const float gap = s.Px(4), beside = radius * 0.72f + s.Px(10);
  const ImVec2 plate = CornerOfRing({site.id, at, half}, {beside, beside}, others,
                                    {r.x + gap, r.y + gap, r.w - 2 * gap, r.h - 2 * gap});
  if (overlay.mission != nullptr) {
    OfferLetter(ui, "picture", plate, site, *overlay.mission);
  }
  LetterPlate(ui, plate, site.letter, true);
  ui.items.Add(kSiteMark, {plate.x - half.x, plate.y - half.y, 2 * half.x, 2 * half.y}, true,
               site.letter);
}

}  // namespace

void DrawSites(UiFrame& ui, const PictureView& view, const SiteOverlay& overlay) {
  const Style& s = ui.style;
  ImDrawList* dl = Canvas();
  dl->PushClipRect(view.rect.min(), view.rect.max(), true);
  const std::uint64_t selected = overlay.selected ? overlay.selected->id : 0;
  std::vector<LetterPlace> letters;
  if (overlay.sites != nullptr) {
    for (const LandingSite& site : *overlay.sites) {
      const auto at = view.ScreenFromPoint(site.p_WS);
      if (site.id != selected && at && view.rect.Contains(*at)) {
        letters.push_back(DrawOther(ui, overlay, site, *at));
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
    const LandingSite& site = *overlay.selected;
    const RingKind kind = overlay.commanded ? RingKind::kCommanded : RingKind::kProposed;
    const auto at = view.ScreenFromPoint(site.p_WS);
    if (DrawSiteRing(ui, view, site, kind, kSiteRing) && view.rect.Contains(*at)) {
      const float radius = static_cast<float>(site.clear_radius_m) * view.PixelsPerMetre(site.p_WS);
      DrawRingLetter(ui, view, overlay, *at, radius, letters);
    }
  }
  DrawLanding(ui, view, overlay);
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
    if (shown++ == kFeaturesDrawn) {
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

}  // namespace palace
