#include "engine/slad/terrain/refused_pixels.h"

#include <limits>

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr int kWidth = 40, kHeight = 20;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr double kDepth_m = 10;

const RigidTransform kDown{CameraRotationFromTilt(Rad(-90)), {0, 0, -kDepth_m}};

/// Straight down from 10 m on level ground; a pixel is 0.25 m wide.
RangeMap LevelRange() {
  RangeMap range;
  range.camera = PinholeCamera{};
  range.camera.width = kWidth;
  range.camera.height = kHeight;
  range.camera.fx_px = range.camera.fy_px = 40;
  range.camera.cx_px = kWidth / 2.0;
  range.camera.cy_px = kHeight / 2.0;
  range.depth_m = ImageF(kWidth, kHeight, float(kDepth_m));
  range.depth_sigma_m = ImageF(kWidth, kHeight, 0.01F);
  range.pose = ViewPose{kDown};
  return range;
}

/// One cell a pixel: heading north, columns of the picture go east, rows south.
Grid<PixelCount> Counted(const RangeMap& range) {
  GridGeometry geometry;
  geometry.cell_m = 0.25;
  geometry.rows = kHeight;
  geometry.cols = kWidth;
  // Pixel centres fall into the middle of cells.
  geometry.north_min_m = -kHeight * 0.125 + 0.125;
  geometry.east_min_m = -kWidth * 0.125 - 0.125;
  Grid<PixelCount> counts(geometry.rows, geometry.cols);
  CountPixels(range, geometry, counts);
  return counts;
}

TEST(RefusedPixels, EveryPixelIsCountedWhereItLies) {
  const auto counts = Counted(LevelRange());
  for (const PixelCount& count : counts.cells()) {
    ASSERT_EQ(count.known, 1);
    ASSERT_EQ(count.refused, 0);
  }
}

TEST(RefusedPixels, AGapLiesOnTheGroundBehindIt) {
  RangeMap range = LevelRange();
  // What ends the gap on one side stands 4 m up: the gap counts on the ground, at the far depth.
  range.depth_m.at(17, 8) = 6;
  range.depth_m.at(18, 8) = range.depth_m.at(19, 8) = kNone;
  range.depth_sigma_m.at(20, 8) = kNone;  // a depth without sigma is unknown, too
  const auto counts = Counted(range);
  for (int x = 18; x <= 20; ++x) {
    EXPECT_EQ(counts.at(8, x).refused, 1) << x;
  }
  EXPECT_EQ(counts.at(8, 21).refused, 0);
  float refused = 0;
  for (const PixelCount& count : counts.cells()) {
    refused += count.refused;
  }
  EXPECT_EQ(refused, 3);
}

TEST(RefusedPixels, FewPixelsSayNothing) {
  EXPECT_EQ((PixelCount{0, 0}.RefusedShare()), 0);
  EXPECT_EQ((PixelCount{5, 6}.RefusedShare()), 0);
  EXPECT_EQ((PixelCount{9, 3}.RefusedShare()), 0.25);
}

TEST(RefusedPixels, GapsAtThePicturesEdgeCountNowhere) {
  RangeMap range = LevelRange();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < 7; ++x) {
      range.depth_m.at(x, y) = range.depth_m.at(kWidth - 1 - x, y) = kNone;
    }
  }
  for (int x = 0; x < kWidth; ++x) {
    range.depth_m.at(x, 3) = kNone;
  }
  const auto counts = Counted(range);
  for (const PixelCount& count : counts.cells()) {
    EXPECT_EQ(count.refused, 0);
  }
}

TEST(RefusedPixels, WhatLiesOutsideTheGridOrNowhereIsLeftOut) {
  RangeMap range = LevelRange();
  range.depth_m = ImageF(kWidth, kHeight, std::numeric_limits<float>::infinity());
  range.depth_m.at(3, 3) = range.depth_m.at(9, 3) = 1e30F;
  range.depth_m.at(4, 4) = -2;
  const auto counts = Counted(range);
  for (const PixelCount& count : counts.cells()) {
    EXPECT_EQ(count.known + count.refused, 0);
  }
}

}  // namespace
}  // namespace palace
