// A real pair: nadir drone photographs of a beach park, disparities near 390 px.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/camera/rectification.h"
#include "engine/camera/rig_file.h"
#include "engine/stereo/stereo.h"

namespace palace {
namespace {

ImageU8 ReadPicture(const std::filesystem::path& path) {
  const cv::Mat picture = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
  ImageU8 image(picture.cols, picture.rows);
  for (int y = 0; y < picture.rows; ++y) {
    std::copy_n(picture.ptr<std::uint8_t>(y), picture.cols, image.row(y));
  }
  return image;
}

TEST(Brighton, GroundLiesAFlightHeightBelow) {
  const auto file = LoadRigFile(std::filesystem::path(PALACE_SOURCE_DIR) /
                                "tests/support/brighton/pair_25_26.toml");
  ASSERT_TRUE(file.ok()) << file.error().message;
  const auto left = file->folder / file->left_pattern;
  if (!std::filesystem::exists(left)) {
    GTEST_SKIP() << "no " << left;
  }
  StereoFrame frame{{}, ReadPicture(left), ReadPicture(file->folder / file->right_pattern)};
  const auto rectifier = StereoRectifier::Make(file->rig);
  ASSERT_TRUE(rectifier.ok());
  const auto pair = rectifier->Rectify(frame);
  ASSERT_TRUE(pair.ok()) << pair.error().message;
  StereoMatcher matcher;
  const auto result = matcher.Match(
      *pair->left, *pair->right, rectifier->camera(), rectifier->baseline_m(),
      {file->rig.min_disparity_px, file->rig.num_disparities}, StereoSettings{}, frame.time);
  ASSERT_TRUE(result.ok()) << result.error().message;
  const StereoQuality& quality = result->quality;
  std::printf("median depth %.2f m, coverage %.3f, sigma %.3f px, rows %.3f px\n",
              quality.median_depth_m, quality.coverage, quality.median_sigma_px,
              quality.row_error_px);
  // The set's README gives ground disparities of about 385-417 px: 37.4 .. 40.5 m. Both cameras see
  // 45 % of the picture, and half of that is a forest too tall for the window.
  EXPECT_NEAR(quality.median_depth_m, 38.9, 1.0);
  EXPECT_GT(quality.coverage, 0.2);
  EXPECT_LT(quality.row_error_px, 0.5);
  EXPECT_FALSE(quality.suspect_swapped);
}

}  // namespace
}  // namespace palace
