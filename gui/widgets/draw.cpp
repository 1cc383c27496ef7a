#include "gui/widgets/draw.h"

#include <algorithm>

namespace palace {

void FillRect(ImDrawList* dl, const Rect& r, ImU32 colour, float rounding) {
  dl->AddRectFilled(r.min(), r.max(), colour, rounding);
}

void StrokeRect(ImDrawList* dl, const Rect& r, ImU32 colour, float width, float rounding) {
  const float in = width / 2;
  // AddRect itself insets by half a pixel, which is right for odd whole widths only.
  dl->PathRect({r.x + in, r.y + in}, {r.right() - in, r.bottom() - in}, rounding);
  dl->PathStroke(colour, ImDrawFlags_Closed, width);
}

void DashedLine(ImDrawList* dl, ImVec2 a, ImVec2 b, ImU32 colour, float width, float on,
                float off) {
  const float length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(length > 0) || !(on + off > 0)) {
    return;
  }
  const ImVec2 step{(b.x - a.x) / length, (b.y - a.y) / length};
  for (float at = 0; at < length; at += on + off) {
    const float end = std::min(at + on, length);
    dl->AddLine({a.x + step.x * at, a.y + step.y * at}, {a.x + step.x * end, a.y + step.y * end},
                colour, width);
  }
}

void DashedPolyline(ImDrawList* dl, const std::vector<ImVec2>& points, ImU32 colour, float width,
                    float on, float off) {
  float phase = 0;  // position inside the on-off pattern, carried over corners
  for (std::size_t i = 1; i < points.size(); ++i) {
    const ImVec2 a = points[i - 1];
    const ImVec2 b = points[i];
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    float at = 0;
    while (at < length) {
      const bool drawn = phase < on;
      const float run = std::min((drawn ? on : on + off) - phase, length - at);
      if (drawn) {
        const float f = at / length;
        const float g = (at + run) / length;
        dl->AddLine({a.x + (b.x - a.x) * f, a.y + (b.y - a.y) * f},
                    {a.x + (b.x - a.x) * g, a.y + (b.y - a.y) * g}, colour, width);
      }
      at += std::max(run, 1e-3f);
      phase = std::fmod(phase + std::max(run, 1e-3f), on + off);
    }
  }
}

void DashedRect(ImDrawList* dl, const Rect& r, ImU32 colour, float width, float on, float off) {
  const float in = width / 2;
  const ImVec2 a{r.x + in, r.y + in};
  const ImVec2 c{r.right() - in, r.bottom() - in};
  DashedLine(dl, a, {c.x, a.y}, colour, width, on, off);
  DashedLine(dl, {c.x, a.y}, c, colour, width, on, off);
  DashedLine(dl, c, {a.x, c.y}, colour, width, on, off);
  DashedLine(dl, {a.x, c.y}, a, colour, width, on, off);
}

void Hatch(ImDrawList* dl, const Rect& r, ImU32 colour, float width, float spacing) {
  // Lines x + y = k, anchored at the screen's origin so that they never scale with the picture.
  // `spacing` is measured along x.
  const float first = std::ceil((r.x + r.y) / spacing) * spacing;
  for (float k = first; k < r.right() + r.bottom(); k += spacing) {
    const float x0 = std::max(r.x, k - r.bottom());
    const float x1 = std::min(r.right(), k - r.y);
    if (x1 > x0) {
      dl->AddLine({x0, k - x0}, {x1, k - x1}, colour, width);
    }
  }
}

void Stripes(ImDrawList* dl, const Rect& r, ImU32 a, ImU32 b, float stripe) {
  FillRect(dl, r, b);
  const float period = stripe * 2 * 1.41421356f;  // along x
  dl->PushClipRect(r.min(), r.max(), true);
  const float first = std::floor((r.x + r.y) / period) * period;
  for (float k = first; k < r.right() + r.bottom() + period; k += period) {
    const float half = period / 2;
    const ImVec2 quad[4] = {{k - r.y, r.y},
                            {k + half - r.y, r.y},
                            {k + half - r.bottom(), r.bottom()},
                            {k - r.bottom(), r.bottom()}};
    dl->AddConvexPolyFilled(quad, 4, a);
  }
  dl->PopClipRect();
}

void UnknownFill(const Style& s, ImDrawList* dl, const Rect& rect) {
  FillRect(dl, rect, picture::kUnknown);
  Hatch(dl, rect, picture::kUnknownLine, s.Fine(1), s.Px(6));
}

void StaleVeil(const Style& s, ImDrawList* dl, const Rect& rect) {
  FillRect(dl, rect, WithAlpha(Rgb(0x090C10), 0.55f));
  Hatch(dl, rect, WithAlpha(picture::kWhite, 0.3f), s.Fine(1), s.Px(10));
}

Rect PlateAt(const Style& s, ImDrawList* dl, const Rect& within, Corner corner, float width,
             float height) {
  const float edge = s.Px(8);
  Rect r{within.x + edge, within.y + edge, width, height};
  if (corner == Corner::kTopRight || corner == Corner::kBottomRight) {
    r.x = within.right() - edge - width;
  }
  if (corner == Corner::kBottomLeft || corner == Corner::kBottomRight) {
    r.y = within.bottom() - edge - height;
  }
  FillRect(dl, r, picture::kPlate, s.Fine(3));
  return r;
}

Rect TextPlate(UiFrame& ui, const Rect& within, Corner corner, std::string_view text) {
  const Style& s = ui.style;
  const float width = TextWidth(s.caption, text) + s.Px(18);
  if (text.empty() || width + s.Px(16) > within.w) {
    return {};
  }
  const Rect r = PlateAt(s, Canvas(), within, corner, width, s.Px(26));
  DrawText(ui, s.caption, picture::kPlateText, r.centre().x, r.centre().y, text, Align::kCentre);
  return r;
}

ImVec2 LetterPlateHalf(const Style& s, std::string_view letter, float side) {
  const float height = s.Px(side);
  return {std::max(height, TextWidth(s.medium, letter) + s.Px(6)) / 2, height / 2};
}

void LetterPlate(UiFrame& ui, ImVec2 c, std::string_view letter, bool selected, float side) {
  const Style& s = ui.style;
  const ImVec2 half = LetterPlateHalf(s, letter, side);
  const Rect r{std::round(c.x - half.x), std::round(c.y - half.y), 2 * half.x, 2 * half.y};
  ImDrawList* dl = Canvas();
  FillRect(dl, r, selected ? picture::kWhite : picture::kLetterDark, s.Fine(2));
  // A rim against whatever lies behind: pictures are dark or light, and so are panels.
  StrokeRect(dl, r, selected ? picture::kLetterDark : picture::kPlateText, s.Fine(1), s.Fine(2));
  DrawText(ui, s.medium, selected ? picture::kLetterDark : picture::kPlateText, r.centre().x,
           r.centre().y, letter, Align::kCentre);
}

Rect PreviewChip(UiFrame& ui, ImVec2 pos, const char* words) {
  const Style& s = ui.style;
  const Rect r{pos.x, pos.y, std::max(s.Px(84), TextWidth(s.medium, words) + s.Px(16)), s.Px(24)};
  FillRect(Canvas(), r, picture::kWhite, s.Fine(3));
  DrawText(ui, s.medium, picture::kLetterDark, r.centre().x, r.centre().y, words, Align::kCentre);
  return r;
}

void FocusRing(const Style& s, ImDrawList* dl, const Rect& rect) {
  const float out = s.Px(4);
  StrokeRect(dl, {rect.x - out, rect.y - out, rect.w + 2 * out, rect.h + 2 * out},
             s.palette.white_mark, s.Fine(2), s.Fine(5));
}

}  // namespace palace
