#include "gui/widgets/map/site_marks.h"

#include <algorithm>

#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

void DrawCross(const Style& s, ImDrawList* dl, ImVec2 c, float radius, bool filled) {
  const float from = std::clamp(radius * 0.11f, s.Fine(4), s.Fine(9));
  const float to = std::clamp(radius * 0.32f, s.Fine(9), s.Fine(26));
  for (const bool black : {true, false}) {
    const ImU32 colour = black ? WithAlpha(picture::kBlack, 0.8f) : picture::kWhite;
    const float width = black ? s.Fine(4) : s.Fine(2);
    const float more = black ? s.Fine(1) : 0.0f;
    dl->AddLine({c.x - to - more, c.y}, {c.x - from + more, c.y}, colour, width);
    dl->AddLine({c.x + from - more, c.y}, {c.x + to + more, c.y}, colour, width);
    dl->AddLine({c.x, c.y - to - more}, {c.x, c.y - from + more}, colour, width);
    dl->AddLine({c.x, c.y + from - more}, {c.x, c.y + to + more}, colour, width);
  }
  if (filled) {
    dl->AddCircleFilled(c, s.Fine(6), picture::kWhite);
    dl->AddCircle(c, s.Fine(6), picture::kBlack, 0, s.Fine(1.5f));
  }
}

}  // namespace

void DrawRing(const Style& s, ImDrawList* dl, const std::vector<ImVec2>& ring, ImVec2 centre,
              RingKind kind) {
  if (ring.size() < 3) {
    return;
  }
  if (kind == RingKind::kGhost) {
    std::vector<ImVec2> closed = ring;
    closed.push_back(ring.front());
    DashedPolyline(dl, closed, picture::kBlack, s.Fine(4), s.Fine(6), s.Fine(5));
    DashedPolyline(dl, closed, picture::kWhite, s.Fine(2), s.Fine(6), s.Fine(5));
    return;
  }
  const int count = static_cast<int>(ring.size());
  dl->AddPolyline(ring.data(), count, WithAlpha(picture::kBlack, 0.85f), ImDrawFlags_Closed,
                  s.Fine(4));
  dl->AddPolyline(ring.data(), count, picture::kWhite, ImDrawFlags_Closed, s.Fine(2));
  float radius = 0;
  for (const ImVec2& p : ring) {
    radius = std::max(radius, std::hypot(p.x - centre.x, p.y - centre.y));
  }
  DrawCross(s, dl, centre, radius, kind == RingKind::kCommanded);
}

void DrawRing(const Style& s, ImDrawList* dl, ImVec2 centre, float radius, RingKind kind) {
  std::vector<ImVec2> ring;
  for (int i = 0; i < 64; ++i) {
    const float angle = 2 * 3.14159265f * static_cast<float>(i) / 64;
    ring.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  DrawRing(s, dl, ring, centre, kind);
}

float LetterHalfWidth(const Style& s, std::string_view letter, float radius) {
  return letter.size() > 1 ? std::max(s.Fine(radius), TextWidth(s.caption, letter) / 2 + s.Fine(5))
                           : s.Fine(radius);
}

void DrawLetterDisc(UiFrame& ui, ImVec2 c, std::string_view letter, const LetterLook& look) {
  const Style& s = ui.style;
  const float r = s.Fine(look.radius), half = LetterHalfWidth(s, letter, look.radius);
  ImDrawList* dl = Canvas();
  const ImU32 fill = look.highlighted ? picture::kWhite : picture::kLetterDark;
  const ImU32 ink = look.highlighted ? picture::kLetterDark : picture::kWhite;
  if (half > r) {
    const Rect pill{c.x - half, c.y - r, 2 * half, 2 * r};
    FillRect(dl, pill, fill, r);
    StrokeRect(dl, pill, ink, s.Fine(1.5f), r);
  } else {
    dl->AddCircleFilled(c, r, fill);
    dl->AddCircle(c, r, ink, 0, s.Fine(1.5f));
  }
  const bool small = look.radius < 10 || letter.size() > 1;
  DrawText(ui, small ? s.caption : s.medium, ink, c.x, c.y, letter, Align::kCentre);
  if (look.refused) {
    const float reach = r * 0.7f;
    dl->AddLine({c.x - reach, c.y + reach}, {c.x + reach, c.y - reach}, ink, s.Fine(2));
  }
}

LetterAnswer OfferLetter(UiFrame& ui, std::string_view where, ImVec2 centre,
                         const LandingSite& site, const MissionStatus& mission) {
  const std::string& letter = site.letter;
  const float high = ui.style.Px(11);
  const float half = std::max(high, LetterHalfWidth(ui.style, letter, 11));
  const Rect area{centre.x - half, centre.y - high, 2 * half, 2 * high};
  const bool may = mission.MaySelect(site.id);
  const Interaction in = Interact(ui, "letter/" + std::string(where) + "/" + letter, area,
                                  kNoTab | (may ? 0U : unsigned{kDisabled}), letter);
  if (in.hovered) {
    DrawTooltip(
        ui, mission.armed && mission.armed->id == site.id ? "Site " + letter + " is selected"
            : may                                         ? "Select site " + letter
            : mission.may_select
                ? std::string("No site can be selected in state ") + MissionStateWord(mission.state)
                : "Sites cannot be selected here");
  }
  if (in.clicked) {
    ui.intents.push_back(CommandAction(SelectSite{site.id}));
  }
  return {in.hovered, in.clicked};
}

void DrawBrackets(const Style& s, ImDrawList* dl, ImVec2 c, ImU32 colour) {
  const float half = s.Fine(10);
  const float arm = s.Fine(6);
  for (const bool black : {true, false}) {
    const ImU32 ink = black ? WithAlpha(picture::kBlack, 0.8f) : colour;
    const float width = s.Fine(black ? 4.0f : 2.0f);
    for (const float sx : {-1.0f, 1.0f}) {
      for (const float sy : {-1.0f, 1.0f}) {
        const ImVec2 corner{c.x + sx * half, c.y + sy * half};
        const ImVec2 bracket[3] = {
            {corner.x - sx * arm, corner.y}, corner, {corner.x, corner.y - sy * arm}};
        dl->AddPolyline(bracket, 3, ink, 0, width);
      }
    }
  }
}

void DrawSearchWindow(const Style& s, ImDrawList* dl, ImVec2 c, float side) {
  const Rect r{c.x - side / 2, c.y - side / 2, side, side};
  StrokeRect(dl, {r.x - s.Fine(1), r.y - s.Fine(1), r.w + s.Fine(2), r.h + s.Fine(2)},
             WithAlpha(picture::kBlack, 0.8f), s.Fine(3));
  StrokeRect(dl, r, picture::kWhite, s.Fine(1));
}

void DrawScaleBar(UiFrame& ui, const Rect& image, float pixels_per_metre) {
  const Style& s = ui.style;
  if (!(pixels_per_metre > 0) || image.w < s.Px(150)) {
    return;
  }
  const float longest = std::min(image.w * 0.28f, s.Px(180));
  double length_m = 0;
  for (const double candidate : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (static_cast<float>(candidate) * pixels_per_metre <= longest) {
      length_m = candidate;
    }
  }
  const float length = static_cast<float>(length_m) * pixels_per_metre;
  if (length < s.Px(20)) {
    return;
  }
  const std::string label = Fixed(length_m, length_m < 1 ? 1 : 0) + " m";
  const float width = length + s.Px(28) + TextWidth(s.caption, label);
  const Rect plate = PlateAt(s, Canvas(), image, Corner::kBottomLeft, width, s.Px(26));
  const float x = plate.x + s.Px(9);
  const float y = plate.centre().y + s.Px(4);
  ImDrawList* dl = Canvas();
  dl->AddLine({x, y}, {x + length, y}, picture::kWhite, s.Fine(2));
  dl->AddLine({x, y - s.Fine(5)}, {x, y + s.Fine(1)}, picture::kWhite, s.Fine(2));
  dl->AddLine({x + length, y - s.Fine(5)}, {x + length, y + s.Fine(1)}, picture::kWhite, s.Fine(2));
  DrawText(ui, s.caption, picture::kPlateText, plate.right() - s.Px(9), plate.centre().y, label,
           Align::kRight);
}

}  // namespace palace
