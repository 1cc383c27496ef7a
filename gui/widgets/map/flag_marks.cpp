#include "gui/widgets/map/flag_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "gui/widgets/draw.h"

namespace palace {
namespace {

constexpr float kSpacing = 8;  // units between marks
constexpr float kHalf = 2.4f;  // units, of a mark
constexpr float kGap = 14;     // units, between words of the legend
constexpr float kLine = 20;    // units, between its lines

struct FlagLook {
  TerrainFlag flag;
  const char* word;
};
/// In the order they are drawn when a cell has several: the first wins.
constexpr std::array<FlagLook, 6> kLooks = {{{kFlagThinStructure, "Thin structure"},
                                             {kFlagMotion, "Motion"},
                                             {kFlagNoTexture, "No texture"},
                                             {kFlagElevated, "Elevated"},
                                             {kFlagUnexplained, "Unexplained"},
                                             {kFlagShadow, "Shadow"}}};

/// Strokes of one mark, once wide and dark, once narrow and white.
void Mark(ImDrawList* dl, const Style& s, ImVec2 at, TerrainFlag flag) {
  const float h = s.Fine(kHalf);
  for (const bool rim : {true, false}) {
    const ImU32 colour = rim ? WithAlpha(picture::kBlack, 0.8f) : picture::kWhite;
    const float width = s.Fine(rim ? 2.6f : 1.2f);
    const auto line = [&](float ax, float ay, float bx, float by) {
      dl->AddLine({at.x + ax * h, at.y + ay * h}, {at.x + bx * h, at.y + by * h}, colour, width);
    };
    switch (flag) {
      case kFlagThinStructure:
        line(-1, -1, 1, 1);
        line(-1, 1, 1, -1);
        break;
      case kFlagNoTexture:
        line(-1, -0.6f, 1, -0.6f);
        line(-1, 0.6f, 1, 0.6f);
        break;
      case kFlagMotion:
        line(-0.5f, -1, 0.5f, 0);
        line(0.5f, 0, -0.5f, 1);
        break;
      case kFlagElevated:
        dl->AddRect({at.x - h, at.y - h}, {at.x + h, at.y + h}, colour, 0, 0, width);
        break;
      case kFlagUnexplained:
        line(-1, 0.8f, 0, -1);
        line(0, -1, 1, 0.8f);
        line(1, 0.8f, -1, 0.8f);
        break;
      default:
        dl->AddCircleFilled(at, rim ? h * 0.75f : h * 0.4f, colour, 8);
    }
  }
}

TerrainFlag FirstOf(unsigned flags) {
  for (const FlagLook& look : kLooks) {
    if ((flags & look.flag) != 0) {
      return look.flag;
    }
  }
  return kFlagNone;
}

}  // namespace

void DrawFlagsOnMap(const Style& style, const Rect& square, const Grid<std::uint8_t>& flags) {
  if (flags.empty()) {
    return;
  }
  const float spacing = style.Px(kSpacing);
  // Squares as wide as marks are apart: which flags have a mark there or beside it. A rim of one.
  Grid<std::uint8_t> marked(static_cast<int>(square.h / spacing) + 3,
                            static_cast<int>(square.w / spacing) + 3, kFlagNone);
  const auto square_of = [&](ImVec2 at) {
    return Cell{static_cast<int>((at.y - square.y) / spacing) + 1,
                static_cast<int>((at.x - square.x) / spacing) + 1};
  };
  const auto mark = [&](ImVec2 at, TerrainFlag flag) {
    const Cell in = square_of(at);
    for (int k = 0; k < 9; ++k) {
      marked.at(in.row + k / 3 - 1, in.col + k % 3 - 1) |= flag;
    }
    Mark(Canvas(), style, at, flag);
  };
  const float cell_w = square.w / static_cast<float>(flags.cols()),
              cell_h = square.h / static_cast<float>(flags.rows());
  for (float y = square.y + spacing / 2; y < square.bottom(); y += spacing) {
    for (float x = square.x + spacing / 2; x < square.right(); x += spacing) {
      const int row = std::min(static_cast<int>((y - square.y) / cell_h), flags.rows() - 1),
                col = std::min(static_cast<int>((x - square.x) / cell_w), flags.cols() - 1);
      const TerrainFlag flag = FirstOf(flags.at(row, col));
      if (flag != kFlagNone) {
        mark({x, y}, flag);
      }
    }
  }
  // What falls between them, and has none of its kind beside it, has one where it is.
  for (int row = 0; row < flags.rows(); ++row) {
    for (int col = 0; col < flags.cols(); ++col) {
      if (flags.at(row, col) == kFlagNone) {
        continue;
      }
      const TerrainFlag flag = FirstOf(flags.at(row, col));
      const ImVec2 at{square.x + cell_w * (static_cast<float>(col) + 0.5f),
                      square.y + cell_h * (static_cast<float>(row) + 0.5f)};
      if (flag != kFlagNone && (marked.at(square_of(at)) & flag) == 0) {
        mark(at, flag);
      }
    }
  }
}

void DrawFlagsOnPicture(const Style& style, const PictureView& view, const GridGeometry& geometry,
                        const GridF& height_m, const Grid<std::uint8_t>& flags) {
  const float spacing = style.Px(kSpacing * 1.5f);
  std::set<std::pair<int, int>> taken;  // places of the screen that have their mark
  for (int row = 0; row < flags.rows(); ++row) {
    float height = kUnknownValue;
    for (int col = 0; col < flags.cols(); ++col) {
      height = std::isfinite(height_m.at(row, col)) ? height_m.at(row, col) : height;
      if (flags.at(row, col) == kFlagNone || !std::isfinite(height)) {
        continue;
      }
      const auto at = view.ScreenFromPoint(
          {geometry.NorthOfRow(row), geometry.EastOfCol(col), -static_cast<double>(height)});
      if (!at || !view.rect.Contains(*at)) {
        continue;
      }
      const std::pair place{static_cast<int>((at->x - view.rect.x) / spacing),
                            static_cast<int>((at->y - view.rect.y) / spacing)};
      if (taken.insert(place).second) {
        Mark(Canvas(), style, *at, FirstOf(flags.at(row, col)));
      }
    }
  }
}

unsigned FlagsPresent(const Grid<std::uint8_t>& flags) {
  unsigned present = 0;
  for (const std::uint8_t cell : flags.cells()) {
    present |= cell;
  }
  return present;
}

ImVec2 FlagLegendSize(const Style& style, unsigned flags, bool in_row) {
  float sum = 0, widest = 0;
  int lines = 0;
  for (const FlagLook& look : kLooks) {
    if ((flags & look.flag) != 0) {
      const float width = style.Px(kGap + 12) + TextWidth(style.caption, look.word);
      sum += width;
      widest = std::max(widest, width);
      ++lines;
    }
  }
  if (lines == 0) {
    return {0, 0};
  }
  const float margin = style.Px(12);
  return in_row ? ImVec2(sum + margin, style.Px(kLine + 6))
                : ImVec2(widest + margin, style.Px(kLine * static_cast<float>(lines) + 6));
}

void DrawFlagLegend(UiFrame& ui, ImVec2 at, unsigned flags, bool in_row) {
  const Style& s = ui.style;
  const float left = at.x - s.Px(6);
  float x = left, y = at.y + s.Px(kLine / 2 + 3);
  for (const FlagLook& look : kLooks) {
    if ((flags & look.flag) == 0) {
      continue;
    }
    x += s.Px(kGap);
    Mark(Canvas(), s, {x + s.Px(4), y}, look.flag);
    x += s.Px(12);
    x += DrawText(ui, s.caption, picture::kPlateText, x, y, look.word);
    if (!in_row) {
      x = left;
      y += s.Px(kLine);
    }
  }
}

}  // namespace palace
