#include "gui/render/map_colours.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "engine/core/units.h"

namespace palace {
namespace {

struct Published {
  const char* name;
  ColourMap map;
  int opencv_map;
};

/// OpenCV carries the published tables.
TEST(MapColoursTest, TablesFollowThePublishedOnes) {
  for (const Published& row : {Published{"viridis", ColourMap::kViridis, cv::COLORMAP_VIRIDIS},
                               Published{"cividis", ColourMap::kCividis, cv::COLORMAP_CIVIDIS},
                               Published{"magma", ColourMap::kMagma, cv::COLORMAP_MAGMA},
                               Published{"inferno", ColourMap::kInferno, cv::COLORMAP_INFERNO}}) {
    SCOPED_TRACE(row.name);
    cv::Mat index(1, 256, CV_8U), published;
    for (int i = 0; i < 256; ++i) {
      index.at<unsigned char>(0, i) = static_cast<unsigned char>(i);
    }
    cv::applyColorMap(index, published, row.opencv_map);
    for (int i = 0; i < 256; ++i) {
      const cv::Vec3b bgr = published.at<cv::Vec3b>(0, i);
      const Rgba8 ours = TableOf(row.map)[static_cast<std::size_t>(i)];
      EXPECT_NEAR(ours.r, bgr[2], 6) << i;
      EXPECT_NEAR(ours.g, bgr[1], 6) << i;
      EXPECT_NEAR(ours.b, bgr[0], 6) << i;
    }
  }
}

TEST(MapColoursTest, SafeDistanceRunsFromPaleToDark) {
  const ColourTable& table = TableOf(ColourMap::kSafeDistance);
  EXPECT_EQ(table.front(), RgbaFromHex(0xDCE9F7));
  EXPECT_EQ(table[51], RgbaFromHex(0x9CC3EA));
  EXPECT_EQ(table[204], RgbaFromHex(0x173D7A));
  EXPECT_EQ(table.back(), RgbaFromHex(0x0A2250));
}

TEST(MapColoursTest, UnknownIsNeverAColourOfTheMap) {
  for (const ColourMap map : {ColourMap::kViridis, ColourMap::kCividis, ColourMap::kMagma,
                              ColourMap::kInferno, ColourMap::kSafeDistance}) {
    EXPECT_EQ(ColourOf(kUnknownValue, {0, 1}, map), kUnknownColour);
    for (const Rgba8& entry : TableOf(map)) {
      EXPECT_NE(entry, kUnknownColour);
    }
  }
}

TEST(MapColoursTest, ValuesBeyondTheRangeTakeTheEndColours) {
  const ValueRange range{-1, 3};
  const ColourTable& table = TableOf(ColourMap::kViridis);
  EXPECT_EQ(ColourOf(-9, range, ColourMap::kViridis), table[0]);
  EXPECT_EQ(ColourOf(-1, range, ColourMap::kViridis), table[0]);
  EXPECT_EQ(ColourOf(1, range, ColourMap::kViridis), table[128]);
  EXPECT_EQ(ColourOf(99, range, ColourMap::kViridis), table[255]);
}

TEST(MapColoursTest, PictureKeepsRowZeroInTheNorth) {
  GridF values(2, 3, 0.0F);
  values.at(0, 2) = 1.0F;
  values.at(1, 0) = kUnknownValue;
  const ImageRgba picture = MapPicture(values, {0, 1}, ColourMap::kMagma);
  ASSERT_EQ(picture.width(), 3);
  ASSERT_EQ(picture.height(), 2);
  EXPECT_EQ(picture.at(2, 0), TableOf(ColourMap::kMagma)[255]);
  EXPECT_EQ(picture.at(0, 1), kUnknownColour);
}

TEST(MapColoursTest, RangesFollowTheLimits) {
  SladSettings settings;
  const MapRanges ranges = RangesFor(settings, {-0.5F, 1.5F});
  EXPECT_FLOAT_EQ(ranges.slope_rad.high,
                  static_cast<float>(Rad(2 * settings.limits.max_slope_deg)));
  EXPECT_FLOAT_EQ(ranges.roughness_m.high,
                  static_cast<float>(2.5 * settings.limits.max_deviation_m));
  EXPECT_FLOAT_EQ(ranges.safe_distance_m.high,
                  static_cast<float>(2.5 * settings.lander.clear_radius_m()));
  EXPECT_FLOAT_EQ(ranges.cost.high, 1.0F);
}

TEST(MapColoursTest, ElevationRangeIsRoundAndHoldsTheGround) {
  GridF heights(4, 4, 3.3F);
  heights.at(0, 0) = kUnknownValue;
  heights.at(0, 1) = 40.0F;  // a mast does not stretch the range
  const ValueRange range = ElevationRangeFor(heights);
  EXPECT_FLOAT_EQ(range.low, 3.0F);
  EXPECT_FLOAT_EQ(range.high, 5.0F);
  EXPECT_FLOAT_EQ(ElevationRangeFor(GridF(2, 2, kUnknownValue)).low, -0.5F);
}

HazardMaps Reasons(double north_min_m, std::initializer_list<std::uint8_t> reasons) {
  HazardMaps maps;
  maps.geometry = {1, static_cast<int>(reasons.size()), 1.0, north_min_m, 0};
  maps.reasons = Grid<std::uint8_t>(1, maps.geometry.cols);
  std::copy(reasons.begin(), reasons.end(), maps.reasons.cells().begin());
  maps.ground = Grid<GroundClass>(1, maps.geometry.cols);
  for (int col = 0; col < maps.geometry.cols; ++col) {
    maps.ground.at(0, col) =
        maps.reasons.at(0, col) == kHazardNone ? GroundClass::kLandable : GroundClass::kHazard;
  }
  return maps;
}

TEST(MapColoursTest, DifferenceTellsKeptLostGainedAndUnsafe) {
  const HazardMaps before = Reasons(0, {0, 0, kHazardSlope, kHazardSlope, kHazardUnknown});
  const HazardMaps now = Reasons(0, {0, kHazardStep, 0, kHazardSlope, kHazardUnknown});
  const ImageRgba picture = DifferencePicture(before, now);
  EXPECT_EQ(picture.at(0, 0), RgbaFromHex(0x2B6FB5));
  EXPECT_EQ(picture.at(1, 0), RgbaFromHex(0xF0963C));
  EXPECT_EQ(picture.at(2, 0), RgbaFromHex(0xF2F5F8));
  EXPECT_EQ(picture.at(3, 0), RgbaFromHex(0x161C22));
  EXPECT_EQ(picture.at(4, 0), kUnknownColour);
  // Another place altogether: nothing was known there.
  EXPECT_EQ(DifferencePicture(Reasons(50, {0, 0, 0, 0, 0}), now).at(0, 0), RgbaFromHex(0xF2F5F8));
}

}  // namespace
}  // namespace palace
