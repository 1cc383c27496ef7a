// Each workspace in each state against its golden picture in tests/golden.
//
// Both are reduced to means over 8 x 8 screen pixels; a block differs when a channel's means are
// more than 14 of 255 apart, and at most 0.5 % of the blocks may. Software GL and font versions
// move single edges by less; a word, a number, a colour or a control that moved or changed does not
// pass. Renew with build/release/tests/renew_golden, look at what changed, and commit it.
#include <filesystem>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "tests/gui/golden/workspace_pictures.h"

namespace palace {
namespace {

constexpr double kMostApart = 14, kMostBlocks = 0.005;

cv::Mat Blocks(const cv::Mat& half) {
  cv::Mat blocks;
  cv::resize(half, blocks, {}, 0.25, 0.25, cv::INTER_AREA);
  return blocks;
}

/// Share of blocks whose means differ; 1 where the sizes do.
double ShareApart(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.empty()) {
    return 1;
  }
  cv::Mat apart;
  cv::absdiff(Blocks(a), Blocks(b), apart);
  int count = 0;
  for (int y = 0; y < apart.rows; ++y) {
    for (int x = 0; x < apart.cols; ++x) {
      const cv::Vec3b d = apart.at<cv::Vec3b>(y, x);
      count += std::max({d[0], d[1], d[2]}) > kMostApart ? 1 : 0;
    }
  }
  return static_cast<double>(count) / (apart.rows * apart.cols);
}

class GoldenPictures : public testing::TestWithParam<golden::Shot> {};

TEST_P(GoldenPictures, LookAsTheyDid) {
  const golden::Shot& shot = GetParam();
  std::string why;
  const ImageRgba picture = golden::Draw(shot, why);
  ASSERT_EQ(why, "");
  const std::filesystem::path golden =
      std::filesystem::path(PALACE_SOURCE_DIR) / "tests/golden" / golden::FileOf(shot);
  const cv::Mat expected = cv::imread(golden.string(), cv::IMREAD_COLOR);
  ASSERT_FALSE(expected.empty()) << golden << " is missing; renew_golden makes it";
  const cv::Mat drawn = golden::HalfSize(picture);
  const double apart = ShareApart(drawn, expected);
  if (apart > kMostBlocks) {
    const auto folder = std::filesystem::path(PALACE_BINARY_DIR) / "golden_differences";
    std::filesystem::create_directories(folder);
    const auto file = folder / golden::FileOf(shot);
    cv::imwrite(file.string(), drawn);
    ADD_FAILURE() << 100 * apart << " % of the blocks differ (limit " << 100 * kMostBlocks
                  << " %): compare " << file << " with " << golden;
  }
}

INSTANTIATE_TEST_SUITE_P(Workspaces, GoldenPictures, testing::ValuesIn(golden::Shots()),
                         [](const auto& shot) {
                           std::string name =
                               shot.param.name + "_" + std::to_string(shot.param.width);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// The comparison itself: a changed word does not pass, a picture's noise does.
TEST(GoldenComparison, SeesAWordAndNotTheCompression) {
  cv::Mat a(360, 640, CV_8UC3, cv::Scalar(20, 16, 12)), b;
  cv::RNG random(7);
  cv::Mat noise(a.size(), CV_8UC3);
  random.fill(noise, cv::RNG::UNIFORM, 0, 6);
  b = a + noise;
  EXPECT_LT(ShareApart(a, b), kMostBlocks);
  cv::putText(b, "Confirmed 4.8 m clear", {40, 60}, cv::FONT_HERSHEY_SIMPLEX, 0.6,
              cv::Scalar(230, 230, 230));
  EXPECT_GT(ShareApart(a, b), kMostBlocks);
}

}  // namespace
}  // namespace palace
