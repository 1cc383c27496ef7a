#include <cmath>

#include <gtest/gtest.h>

#include "gui/widgets/map/contour.h"
#include "gui/widgets/map/map_image.h"
#include "gui/widgets/number_text.h"
#include "gui/widgets/plot.h"
#include "gui/widgets/style.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

double Linear(ImU32 channel) {
  const double c = static_cast<double>(channel & 0xFFu) / 255;
  return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double Luminance(ImU32 colour) {
  return 0.2126 * Linear(colour) + 0.7152 * Linear(colour >> 8) + 0.0722 * Linear(colour >> 16);
}
double Contrast(ImU32 a, ImU32 b) {
  const double la = Luminance(a);
  const double lb = Luminance(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

// A ring is a circle, so a metre is as long down a map as across it.
TEST(MapWithin, HasOneScaleBothWaysAndIsAsLargeAsItCanBe) {
  const Rect area{10, 20, 240, 200};
  const struct {
    int rows, cols;
    float w, h;
  } table[] = {{100, 100, 200, 200}, {200, 100, 100, 200}, {100, 200, 240, 120}, {0, 0, 240, 200}};
  for (const auto& row : table) {
    const Rect map = MapWithin(area, {row.rows, row.cols, 0.15, 0, 0});
    EXPECT_EQ(map.w, row.w) << row.rows;
    EXPECT_EQ(map.h, row.h) << row.cols;
    EXPECT_EQ(map.centre().x, area.centre().x) << row.rows;
    EXPECT_EQ(map.centre().y, area.centre().y) << row.cols;
  }
}

TEST(Palette, EveryTextIsReadableOnEveryGroundInEveryTheme) {
  const Palette themes[] = {MakeDarkPalette(), MakeLightPalette(), MakeHighContrastPalette()};
  for (int t = 0; t < 3; ++t) {
    const Palette& p = themes[t];
    for (const ImU32 text : {p.text1, p.text2, p.text3}) {
      for (const ImU32 ground : {p.panel, p.control, p.hover}) {
        EXPECT_GE(Contrast(text, ground), 4.5) << "theme " << t;
      }
    }
    EXPECT_GE(Contrast(p.on_go, p.go), 6.0) << "theme " << t;
    EXPECT_GE(Contrast(p.on_white, p.white_mark), 4.5) << "theme " << t;
    EXPECT_GE(Contrast(p.on_replay, p.replay), 4.5) << "theme " << t;
    EXPECT_GE(Contrast(p.warning, p.warning_fill), 4.5) << "theme " << t;
    EXPECT_GE(Contrast(p.caution, p.caution_fill), 4.5) << "theme " << t;
    EXPECT_GE(Contrast(p.advisory, p.advisory_fill), 4.5) << "theme " << t;
    EXPECT_GE(Contrast(p.strong_line, p.panel), 3.0) << "theme " << t;
  }
}

TEST(NumberText, ShowsTrueMinusGroupsAndUnknown) {
  EXPECT_EQ(Fixed(-1234567.25, 1), "−1 234 567.2");
  EXPECT_EQ(Fixed(-0.04, 1), "0.0");
  EXPECT_EQ(Fixed(999, 0), "999");
  EXPECT_EQ(Fixed(NAN, 2), "––");
  EXPECT_EQ(AgeText(0.024), "24 ms");
  EXPECT_EQ(AgeText(1.8), "1.8 s");
  EXPECT_EQ(LengthText(252), "00:04:12");
}

TEST(NumberText, AValueOverItsLimitDoesNotReadLikeTheLimit) {
  EXPECT_EQ(FixedAgainst(2.31, 2.3, false, 1), "2.3");
  EXPECT_EQ(FixedAgainst(2.28, 2.3, true, 1), "2.28");
  EXPECT_EQ(FixedAgainst(2.298, 2.3, true, 1), "2.298");
  EXPECT_EQ(FixedAgainst(2.29999, 2.3, true, 1), "2.300");
  EXPECT_EQ(FixedAgainst(2.33, 2.34, true, 1), "2.33");
  EXPECT_EQ(FixedAgainst(2.3, 2.34, true, 1), "2.30");
  EXPECT_EQ(FixedAgainst(12.3, 10, true, 1), "12.3");
  EXPECT_EQ(FixedAgainst(NAN, 2.3, true, 1), "––");
}

TEST(NumberText, ALimitHasTheDecimalsThatItTakes) {
  EXPECT_EQ(DecimalsOf(10, 0), 0);
  EXPECT_EQ(DecimalsOf(10, 1), 1);
  EXPECT_EQ(DecimalsOf(2.3, 1), 1);
  EXPECT_EQ(DecimalsOf(2.34, 1), 2);
  EXPECT_EQ(DecimalsOf(1.0 / 3, 0), 3);
  EXPECT_EQ(DecimalsOf(NAN, 1), 1);
}

TEST(DrawText, WhatIsCutSaysSo) {
  UiHarness ui(800, 600);
  const ImFont* font = ui.style.body;
  const std::string text = "GPS error 2.6 m, limit 2.0 m. Landing on vision, not GPS.";
  EXPECT_EQ(FitWords(font, text, 1000), text);
  EXPECT_EQ(FitClauses(font, text, 1000), text);
  const float width = TextWidth(font, "GPS error 2.6 m, limit 2.0 m. Landing on");
  EXPECT_EQ(FitClauses(font, text, width), "GPS error 2.6 m, limit 2.0 m…");
  for (float room = 10; room < width; room += 10) {
    for (const std::string& cut : {FitWords(font, text, room), FitClauses(font, text, room)}) {
      EXPECT_LE(TextWidth(font, cut), room);
      EXPECT_TRUE(cut.empty() || cut.ends_with("…")) << cut;
    }
  }
  for (const float room : {90.0F, 160.0F, 300.0F}) {
    const std::vector<std::string> all = WrapText(font, text, room);
    for (std::size_t most = 1; most <= all.size(); ++most) {
      const std::vector<std::string> lines = WrapText(font, text, room, most);
      ASSERT_FALSE(lines.empty());
      ASSERT_LE(lines.size(), most);
      EXPECT_EQ(lines.back().ends_with("…"), most < all.size()) << room << " px, " << most;
      EXPECT_LE(TextWidth(font, lines.back()), room);
    }
  }
  // After a whole clause, where a word more had room.
  EXPECT_EQ(WrapText(font, text, width, 1),
            std::vector<std::string>{"GPS error 2.6 m, limit 2.0 m…"});
  EXPECT_EQ(WholeWords(font, "24 ms   10 Hz", TextWidth(font, "24 ms   10")), "24 ms   10");
}

TEST(Contour, ADiscOfHazardGivesOneClosedLineAtItsRim) {
  ImageU8 verdict(60, 60, 1);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      if (std::hypot(x - 30, y - 28) < 12) {
        verdict.at(x, y) = 2;
      }
    }
  }
  const auto lines = SafeContours(verdict);
  ASSERT_EQ(lines.size(), 1u);
  const auto& line = lines.front();
  EXPECT_EQ(line.front().x, line.back().x);
  EXPECT_EQ(line.front().y, line.back().y);
  for (const ImVec2& p : line) {
    EXPECT_NEAR(std::hypot(p.x - 30, p.y - 28), 12, 1.0);
  }
}

TEST(Contour, NoLineAlongTheRimOfTheMapButOneRoundAHoleInIt) {
  ImageU8 verdict(40, 40, 0);
  for (int y = 8; y < 32; ++y) {
    for (int x = 8; x < 32; ++x) {
      verdict.at(x, y) = x > 18 && x < 22 && y > 18 && y < 22 ? 0 : 1;
    }
  }
  const auto lines = SafeContours(verdict);
  ASSERT_EQ(lines.size(), 1u);
  for (const ImVec2& p : lines.front()) {
    EXPECT_LT(std::abs(p.x - 20), 3);
    EXPECT_LT(std::abs(p.y - 20), 3);
  }
}

TEST(PlotTicks, AreRoundAndInside) {
  EXPECT_EQ(RoundTicks(0, 42, 4), (std::vector<float>{0, 20, 40}));
  for (const float tick : RoundTicks(-1.6f, 1.6f, 5)) {
    EXPECT_LE(std::abs(tick), 1.6f);
  }
  EXPECT_TRUE(RoundTicks(1, 1, 4).empty());
}

}  // namespace
}  // namespace palace
