// Marks of flags lie on the flagged cells, whatever the scale, and nowhere else.
#include "gui/widgets/map/flag_marks.h"

#include <gtest/gtest.h>

#include "tests/support/ui_harness.h"

namespace palace {
namespace {

constexpr int kCells = 100;
constexpr float kSide = 300;

/// Corners of all that `draw` adds to the canvas.
std::vector<ImVec2> Drawn(UiHarness& ui, const std::function<void(UiFrame&)>& draw) {
  std::vector<ImVec2> corners;
  ui.Frame([&](UiFrame& frame) {
    const int before = Canvas()->VtxBuffer.Size;
    draw(frame);
    for (int k = before; k < Canvas()->VtxBuffer.Size; ++k) {
      corners.push_back(Canvas()->VtxBuffer[k].pos);
    }
  });
  return corners;
}

TEST(FlagMarks, EveryKindIsMarkedOnItsCellsOnly) {
  for (const float scale : {1.0f, 1.5f}) {
    UiHarness ui(400, 400, scale);
    const Rect square{10, 20, kSide, kSide};
    for (const unsigned flag : {kFlagThinStructure, kFlagNoTexture, kFlagShadow, kFlagMotion,
                                kFlagElevated, kFlagUnexplained}) {
      Grid<std::uint8_t> flags(kCells, kCells, kFlagNone);
      for (int r = 30; r < 40; ++r) {
        for (int c = 60; c < 75; ++c) {
          flags.at(r, c) = static_cast<std::uint8_t>(flag);
        }
      }
      const auto corners =
          Drawn(ui, [&](UiFrame& frame) { DrawFlagsOnMap(frame.style, square, flags); });
      EXPECT_FALSE(corners.empty()) << flag;
      const float reach = 5 * scale;
      for (const ImVec2& p : corners) {
        EXPECT_GE(p.x, 10 + 60 * 3 - reach) << flag;
        EXPECT_LE(p.x, 10 + 75 * 3 + reach) << flag;
        EXPECT_GE(p.y, 20 + 30 * 3 - reach) << flag;
        EXPECT_LE(p.y, 20 + 40 * 3 + reach) << flag;
      }
      EXPECT_EQ(FlagsPresent(flags), flag);
    }
  }
}

// A post is one cell wide, a wire two: neither falls between the marks of an area.
TEST(FlagMarks, OneCellIsMarkedWhereverItLies) {
  UiHarness ui(400, 400);
  const Rect square{10, 20, kSide, kSide};
  for (const Cell cell : {Cell{0, 0}, {99, 99}, {31, 62}, {50, 7}, {52, 7}, {53, 8}}) {
    Grid<std::uint8_t> flags(kCells, kCells, kFlagNone);
    flags.at(cell) = kFlagUnexplained;
    const auto corners =
        Drawn(ui, [&](UiFrame& frame) { DrawFlagsOnMap(frame.style, square, flags); });
    ASSERT_FALSE(corners.empty()) << cell.row << ' ' << cell.col;
    for (const ImVec2& p : corners) {
      EXPECT_NEAR(p.x, 10 + 3 * cell.col + 1.5, 5.5) << cell.col;
      EXPECT_NEAR(p.y, 20 + 3 * cell.row + 1.5, 5.5) << cell.row;
    }
  }
}

TEST(FlagMarks, NothingWithoutFlags) {
  UiHarness ui(400, 400);
  const Rect square{10, 20, kSide, kSide};
  for (const Grid<std::uint8_t>& flags :
       {Grid<std::uint8_t>(), Grid<std::uint8_t>(kCells, kCells, kFlagNone)}) {
    EXPECT_TRUE(
        Drawn(ui, [&](UiFrame& frame) { DrawFlagsOnMap(frame.style, square, flags); }).empty());
    EXPECT_EQ(FlagsPresent(flags), 0u);
  }
  for (const bool in_row : {true, false}) {
    EXPECT_EQ(FlagLegendSize(ui.style, 0, in_row).x, 0);
    EXPECT_EQ(FlagLegendSize(ui.style, 0, in_row).y, 0);
  }
}

/// Looking straight down from 10 m: the cell straight below is in the middle of the picture.
TEST(FlagMarks, OnThePictureTheMarkIsWhereTheCellIsSeen) {
  UiHarness ui(700, 520);
  const GridGeometry geometry{21, 21, 0.2, -2.1, -2.1};
  Grid<std::uint8_t> flags(21, 21, kFlagNone);
  flags.at(10, 10) = kFlagMotion;
  const PinholeCamera camera{640, 480, 700, 700, 319.5, 239.5};
  RigidTransform X_WC;
  X_WC.R = CameraRotationFromTilt(-1.5707963267948966);
  X_WC.p = {0, 0, -10};
  const PictureView view{camera, X_WC, {20, 10, 640, 480}};
  for (const bool known : {true, false}) {
    const GridF height_m(21, 21, known ? 0.0f : kUnknownValue);
    const auto corners = Drawn(ui, [&](UiFrame& frame) {
      DrawFlagsOnPicture(frame.style, view, geometry, height_m, flags);
    });
    EXPECT_EQ(corners.empty(), !known);
    for (const ImVec2& p : corners) {
      EXPECT_NEAR(p.x, 20 + 320, 5);
      EXPECT_NEAR(p.y, 10 + 240, 5);
    }
  }
}

}  // namespace
}  // namespace palace
