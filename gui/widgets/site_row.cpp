#include "gui/widgets/site_row.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"
#include "engine/model/approach_side.h"
#include "engine/model/cell_explanation.h"
#include "engine/model/size_words.h"
#include "gui/widgets/draw.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/map/site_marks.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

/// Half side of the cut-out, in clear radii.
constexpr float kCutOutRadii = 1.4f;
constexpr std::string_view kRefusedReason = "By the operator; click for a second look";

void DrawCutOut(const Style& s, const Rect& box, const LandingSite& site,
                const std::optional<PictureView>& view, ImTextureID texture) {
  ImDrawList* dl = Canvas();
  const auto at = view ? view->ScreenFromPoint(site.p_WS) : std::nullopt;
  const float half = view ? kCutOutRadii * static_cast<float>(site.clear_radius_m) *
                                view->PixelsPerMetre(site.p_WS)
                          : 0.0f;
  if (texture == nullptr || !at || !view->rect.Contains(*at) || !(half > 0)) {
    UnknownFill(s, dl, box);
    return;
  }
  const Rect& full = view->rect;
  // Slide the cut-out inside the picture rather than showing what is beyond its edge.
  const float half_x = std::min(half, full.w / 2);
  const float half_y = std::min(half, full.h / 2);
  const float cx = std::clamp(at->x, full.x + half_x, full.right() - half_x);
  const float cy = std::clamp(at->y, full.y + half_y, full.bottom() - half_y);
  const ImVec2 uv0{(cx - half_x - full.x) / full.w, (cy - half_y - full.y) / full.h};
  const ImVec2 uv1{(cx + half_x - full.x) / full.w, (cy + half_y - full.y) / full.h};
  dl->AddImage(texture, box.min(), box.max(), uv0, uv1);
  const ImVec2 centre{box.centre().x + (at->x - cx) / half_x * box.w / 2,
                      box.centre().y + (at->y - cy) / half_y * box.h / 2};
  dl->PushClipRect(box.min(), box.max(), true);
  const float radius = box.w / 2 / kCutOutRadii;
  dl->AddCircle(centre, radius, WithAlpha(picture::kBlack, 0.8f), 0, s.Fine(2.5f));
  dl->AddCircle(centre, radius, picture::kWhite, 0, s.Fine(1.2f));
  dl->PopClipRect();
}

struct SiteWord {
  Icon icon;
  std::string word;
};

SiteWord WordOf(const LandingSite& site, const SiteRowLook& look) {
  if (!look.verdict.empty()) {
    return {Icon::kWarning, std::string(look.verdict)};
  }
  if (look.refused) {
    return {Icon::kOff, "Refused"};
  }
  if (look.old_map) {
    return {Icon::kStale, "Old map"};
  }
  if (!IsInView(site)) {
    return {Icon::kStale,
            "Not all in view"};  // whatever it was: nothing is approved on such ground
  }
  if (!IsReached(site)) {
    return {Icon::kWarning, "Rejected"};
  }
  const Icon icon = look.standing == SiteStanding::kConfirmed     ? Icon::kNormal
                    : look.standing == SiteStanding::kProvisional ? Icon::kProvisional
                                                                  : Icon::kSearch;
  return {icon, look.standing_words.empty() ? StandingWord(look.standing) : look.standing_words};
}

}  // namespace

SiteRowAnswer DrawSiteRow(UiFrame& ui, const Rect& rect, const LandingSite& site,
                          const std::optional<PictureView>& view, ImTextureID texture,
                          const SiteRowLook& look) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  ImDrawList* dl = Canvas();
  const SiteWord status = WordOf(site, look);
  // What a refused site has over the others no longer ranks it.
  const std::string_view why = look.refused           ? kRefusedReason
                               : look.verdict.empty() ? std::string_view(site.reason)
                                                      : look.why;
  const std::string words = site.letter + " " + status.word + " " + std::string(why) +
                            (site.flags != 0 ? " " + FlagWords(site.flags) : std::string());
  const Interaction in = Interact(ui, SiteItemName(site.letter), rect,
                                  kKeepsStop | (look.enabled ? 0U : unsigned{kDisabled}), words);
  const bool hovered = look.enabled && in.hovered;
  if (look.selected || hovered || in.focused) {
    FillRect(dl, rect, look.selected ? p.hover : p.control);
  }
  if (look.selected) {
    FillRect(dl, {rect.x, rect.y, s.Px(4), rect.h}, p.white_mark);
  }
  const float side = s.Px(look.narrow ? 36 : 56);
  const Rect box{rect.x + s.Px(16), std::round(rect.centre().y - side / 2), side, side};
  DrawCutOut(s, box, site, view, texture);

  const float letter_x = box.right() + s.Px(look.narrow ? 22 : 22);
  const float first_y = look.narrow ? rect.y + s.Px(14) : rect.y + s.Px(17);
  LetterPlate(ui, {letter_x, first_y}, site.letter, look.selected);
  const float text_x = letter_x + s.Px(18);
  const float left_x = look.narrow ? text_x : letter_x - s.Px(10);
  DrawText(ui, s.medium, p.text1, text_x, first_y, Fixed(site.safe_distance_m, 1) + " m clear");

  const float right = rect.right() - s.Px(14);
  const float word_w = DrawText(ui, s.caption, p.text2, right, first_y, status.word, Align::kRight);
  DrawIcon(dl, status.icon, {right - word_w - s.Px(13), first_y}, s.Px(12),
           status.icon == Icon::kWarning ? p.warning : p.text2);

  const float width = right - left_x;
  if (look.narrow) {
    std::string_view reason = why;
    if (TextWidth(s.caption, reason) > width) {
      reason = reason.substr(0, reason.find(';'));  // whole clauses only: half a figure misleads
    }
    DrawText(ui, s.caption, p.text2, left_x, first_y + s.Px(18),
             FitWords(s.caption, reason, width));
  } else {
    const std::string figures = "Slope " + SizeWords(site.slope_rad, kDegPerRad, "°", 1) +
                                "   Rough " + SizeWords(site.roughness_m, 100, " cm", 1) + "   " +
                                Fixed(site.distance_m, 1) + " m away" +
                                (site.flags != 0 ? "   " + FlagWords(site.flags) : std::string());
    DrawText(ui, s.caption, p.text2, left_x, first_y + s.Px(21),
             FitWords(s.caption, figures, width));
    DrawText(ui, s.caption, look.selected ? p.text1 : p.text2, left_x, first_y + s.Px(39),
             FitWords(s.caption, why, width));
  }
  return {in.clicked, in.focused};
}

}  // namespace palace
