#include "gui/widgets/why_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "gui/widgets/draw.h"
#include "gui/widgets/number_text.h"
#include "gui/widgets/overlap.h"

namespace palace {
namespace {

constexpr float kWidth = 316;
constexpr float kPad = 12;
constexpr float kRow = 22;
constexpr float kLine = 18;

bool Holds(const Rect& outer, const Rect& inner) {
  return inner.x >= outer.x && inner.y >= outer.y && inner.right() <= outer.right() &&
         inner.bottom() <= outer.bottom();
}

std::vector<std::string> VerdictLines(const Style& s, const CellExplanation& why) {
  return WrapText(s.medium, why.verdict, s.Px(kWidth - 2 * kPad - 22));
}

/// What is known of the cell beside its terms; ages as at the map when `map_age_s` is 0.
std::vector<std::string> FactLines(const CellExplanation& why, double map_age_s) {
  std::vector<std::string> lines;
  const bool of_lander = std::any_of(why.terms.begin(), why.terms.end(),
                                     [](const auto& term) { return term.term == CellTerm::kStep; });
  if (of_lander) {  // the picture hatches the cell itself
    lines.push_back("Roughness and step: anywhere under a lander here");
  }
  std::string measured = CellStateWord(why.state);
  measured[0] = static_cast<char>(measured[0] - 'a' + 'A');
  if (why.frames > 0) {
    measured += " in " + std::to_string(why.frames) + (why.frames == 1 ? " frame" : " frames");
    if (std::isfinite(why.age_s)) {
      measured += ", " + AgeText(why.age_s + map_age_s) + " ago";
    }
  }
  lines.push_back(measured);
  if (std::isfinite(why.height_m.value)) {
    lines.push_back("Height " + Fixed(why.height_m.value, 2) + " m" +
                    (why.height_m.three_sigma > 0
                         ? " ± " + Fixed(why.height_m.three_sigma, 2) + " m"
                         : std::string()));
  }
  if (why.flags != 0) {
    lines.push_back("Flags: " + FlagWords(why.flags));
  }
  return lines;
}

void DrawTerm(UiFrame& ui, const Rect& row, const ExplainedTerm& term) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  if (term.decided) {
    FillRect(Canvas(), row, p.hover);
    FillRect(Canvas(), {row.x, row.y, s.Px(4), row.h}, p.white_mark);
  }
  if (term.over) {
    const float edge = s.Px(4);
    FillRect(Canvas(), {row.right() - edge, row.y + edge, edge, row.h - 2 * edge}, p.unsafe);
  }
  const TermWords words = WordsOf(term);
  const float y = row.centre().y;
  DrawText(ui, term.decided ? s.medium : s.body, term.decided ? p.text1 : p.text2,
           row.x + s.Px(kPad), y, words.name);
  float right = row.right() - s.Px(kPad);
  DrawText(ui, s.caption, term.decided ? p.text1 : p.text3, right, y, words.limit, Align::kRight);
  right -= s.Px(84);
  if (!words.spread.empty()) {
    right -= DrawText(ui, s.caption, p.text2, right, y, words.spread, Align::kRight) + s.Px(4);
  }
  DrawText(ui, s.medium, p.text1, right, y, words.value, Align::kRight);
}

}  // namespace

std::optional<Rect> PlaceBeside(const Rect& anchor, ImVec2 size, const Rect& within,
                                const std::vector<Rect>& avoid, float gap) {
  const float x_in = std::clamp(anchor.centre().x - size.x / 2, within.x,
                                std::max(within.x, within.right() - size.x));
  const float y_in = std::clamp(anchor.centre().y - size.y / 2, within.y,
                                std::max(within.y, within.bottom() - size.y));
  std::vector<Rect> places;
  const std::array<float, 3> heights = {y_in, within.y, within.bottom() - size.y};
  const std::array<float, 3> sides = {x_in, within.x, within.right() - size.x};
  for (const float y : heights) {
    places.push_back({anchor.right() + gap, y, size.x, size.y});
    places.push_back({anchor.x - gap - size.x, y, size.x, size.y});
  }
  for (const float x : sides) {
    places.push_back({x, anchor.y - gap - size.y, size.x, size.y});
    places.push_back({x, anchor.bottom() + gap, size.x, size.y});
  }
  for (Rect place : places) {
    place.x = std::round(place.x);
    place.y = std::round(place.y);
    const bool free = std::none_of(avoid.begin(), avoid.end(),
                                   [&](const Rect& other) { return Overlap(place, other); });
    if (free && Holds(within, place) && !Overlap(place, anchor)) {
      return place;
    }
  }
  return std::nullopt;
}

ImVec2 WhyBoxSize(const Style& s, const CellExplanation& why) {
  const auto count = [](std::size_t n) { return static_cast<float>(n); };
  const float height = s.Px(10) + s.Px(20) * count(VerdictLines(s, why).size()) + s.Px(6) +
                       s.Px(kRow) * count(why.terms.size()) + s.Px(6) +
                       s.Px(kLine) * count(FactLines(why, 0).size()) + s.Px(8);
  return {s.Px(kWidth), height};
}

void DrawWhyBox(UiFrame& ui, const Rect& rect, const CellExplanation& why, double map_age_s) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  FillRect(Canvas(), rect, p.control, s.Fine(4));
  StrokeRect(Canvas(), rect, p.strong_line, s.Fine(1), s.Fine(4));
  std::string record = why.verdict;
  float y = rect.y + s.Px(10);
  const Rect swatch{rect.x + s.Px(kPad), y + s.Px(3), s.Px(14), s.Px(14)};
  if (why.can_bear) {
    FillRect(Canvas(), swatch, p.bar);
  } else {
    FillRect(Canvas(), swatch, WithAlpha(p.unsafe, 0.25F));
    Hatch(Canvas(), swatch, p.unsafe, s.Fine(2), s.Fine(6));
  }
  for (const std::string& line : VerdictLines(s, why)) {
    DrawText(ui, s.medium, p.text1, rect.x + s.Px(kPad + 22), y + s.Px(10), line);
    y += s.Px(20);
  }
  y += s.Px(6);
  for (const ExplainedTerm& term : why.terms) {
    DrawTerm(ui, {rect.x, y, rect.w, s.Px(kRow)}, term);
    const TermWords words = WordsOf(term);
    record += "; " + words.name + " " + words.value + " " + words.spread + " " + words.limit +
              (term.over ? " over" : "") + (term.decided ? " decided" : "");
    y += s.Px(kRow);
  }
  y += s.Px(6);
  for (const std::string& line : FactLines(why, map_age_s)) {
    DrawText(ui, s.caption, p.text2, rect.x + s.Px(kPad), y + s.Px(kLine) / 2, line);
    record += "; " + line;
    y += s.Px(kLine);
  }
  ui.items.Add("why", rect, true, record);
}

}  // namespace palace
