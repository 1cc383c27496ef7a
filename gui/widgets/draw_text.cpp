#include <algorithm>
#include <cctype>

#include "gui/widgets/draw.h"

namespace palace {
namespace {

constexpr const char* kEllipsis = "…";

/// A mark of punctuation there ends a clause: no decimal point.
bool EndsClause(std::string_view text, std::size_t at) {
  return at + 1 < text.size() && text[at + 1] == ' ' &&
         std::string_view(".,:;").find(text[at]) != std::string_view::npos;
}

}  // namespace

float TextWidth(const ImFont* font, std::string_view text) {
  return std::ceil(
      font->CalcTextSizeA(font->FontSize, 1e9f, 0, text.data(), text.data() + text.size()).x);
}

float DrawText(UiFrame& ui, ImFont* font, ImU32 colour, float x, float centre_y,
               std::string_view text, Align align) {
  if (text.empty()) {
    return 0;
  }
  const float width = TextWidth(font, text);
  if (align == Align::kRight) {
    x -= width;
  } else if (align == Align::kCentre) {
    x -= width / 2;
  }
  x = std::round(x);
  const float y = std::round(centre_y - font->FontSize / 2);
  Canvas()->AddText(font, font->FontSize, {x, y}, colour, text.data(), text.data() + text.size());
  ui.items.Add("text", Rect{x, y, width, font->FontSize}, true, text);
  return width;
}

float DrawValueUnit(UiFrame& ui, ImFont* value_font, float x, float centre_y,
                    std::string_view value, std::string_view unit, Align align) {
  const Style& s = ui.style;
  // The degree sign follows its digit; every other unit stands apart.
  const float gap = unit.empty() || unit.substr(0, 2) == "°" ? 0.0f : s.Px(6);
  const float value_width = TextWidth(value_font, value);
  const float unit_width = unit.empty() ? 0.0f : TextWidth(s.caption, unit);
  const float width = value_width + gap + unit_width;
  if (align == Align::kRight) {
    x -= width;
  } else if (align == Align::kCentre) {
    x -= width / 2;
  }
  DrawText(ui, value_font, s.palette.text1, x, centre_y, value);
  // The unit shares the base line of the value: Roboto's base line is 0.79 of the size down.
  const float drop = (value_font->FontSize - s.caption->FontSize) * 0.29f;
  DrawText(ui, s.caption, s.palette.text2, x + value_width + gap, centre_y + drop, unit);
  return width;
}

std::string_view WholeWords(const ImFont* font, std::string_view text, float width) {
  while (!text.empty() && TextWidth(font, text) > width) {
    const std::size_t space = text.rfind(' ');
    if (space == std::string_view::npos) {
      return {};
    }
    text = text.substr(0, space);
    while (!text.empty() && (text.back() == ',' || text.back() == ';' || text.back() == ' ')) {
      text.remove_suffix(1);
    }
  }
  return text;
}

std::string FitWords(const ImFont* font, std::string_view text, float width) {
  if (TextWidth(font, text) <= width) {
    return std::string(text);
  }
  const std::string_view start = WholeWords(font, text, width - TextWidth(font, kEllipsis));
  return start.empty() ? std::string() : std::string(start) + kEllipsis;
}

std::string FitClauses(const ImFont* font, std::string_view text, float width) {
  if (TextWidth(font, text) <= width) {
    return std::string(text);
  }
  const float room = width - TextWidth(font, kEllipsis);
  std::size_t best = 0;
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    if (EndsClause(text, at) && TextWidth(font, text.substr(0, at)) <= room) {
      best = at;
    }
  }
  return best > 0 ? std::string(text.substr(0, best)) + kEllipsis : FitWords(font, text, width);
}

std::vector<std::string> WrapText(const ImFont* font, std::string_view text, float width) {
  std::vector<std::string> lines;
  std::string line;
  while (!text.empty()) {
    const std::size_t space = text.find(' ');
    const std::string_view word = text.substr(0, space);
    std::string longer = line.empty() ? std::string(word) : line + " " + std::string(word);
    if (!line.empty() && TextWidth(font, longer) > width) {
      lines.push_back(line);
      line = std::string(word);
    } else {
      line = std::move(longer);
    }
    text = space == std::string_view::npos ? std::string_view() : text.substr(space + 1);
  }
  if (!line.empty()) {
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> WrapText(const ImFont* font, std::string_view text, float width,
                                  std::size_t most) {
  std::vector<std::string> lines = WrapText(font, text, width);
  if (lines.size() <= most) {
    return lines;
  }
  for (std::size_t at = text.size(); at-- > 1;) {
    if (EndsClause(text, at)) {
      std::vector<std::string> clauses =
          WrapText(font, std::string(text.substr(0, at)) + kEllipsis, width);
      if (clauses.size() <= most) {
        return clauses;
      }
    }
  }
  lines[most - 1] = FitWords(font, lines[most - 1] + " " + lines[most], width);
  lines.resize(most);
  return lines;
}

}  // namespace palace
