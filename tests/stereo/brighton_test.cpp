// A real pair: nadir drone photographs of a beach park, disparities near 390 px.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/camera/files/rig_file.h"
#include "engine/camera/rectification.h"
#include "engine/stereo/stereo.h"
#include "tests/support/reference_data.h"

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

struct Matched {
  RangeMap range;
  StereoQuality quality;
};

/// Nothing where the photographs are absent.
std::optional<Matched> MatchPair(const std::string& rig) {
  const auto file = LoadRigFile(std::filesystem::path(PALACE_SOURCE_DIR) /
                                ("tests/support/brighton/" + rig + ".toml"));
  EXPECT_TRUE(file.ok());
  const auto left = file->folder / file->left_pattern;
  if (!std::filesystem::exists(left)) {
    return std::nullopt;
  }
  StereoFrame frame{{}, ReadPicture(left), ReadPicture(file->folder / file->right_pattern)};
  const auto rectifier = StereoRectifier::Make(file->rig);
  EXPECT_TRUE(rectifier.ok());
  const auto pair = rectifier->Rectify(frame);
  EXPECT_TRUE(pair.ok());
  StereoMatcher matcher;
  auto result = matcher.Match(
      *pair->left, *pair->right, rectifier->camera(), rectifier->baseline_m(),
      {file->rig.min_disparity_px, file->rig.num_disparities}, StereoSettings{}, frame.time);
  EXPECT_TRUE(result.ok());
  return Matched{std::move(result->range), result->quality};
}

TEST(Brighton, GroundLiesAFlightHeightBelow) {
  const auto matched = MatchPair("pair_25_26");
  if (!matched) {
    GTEST_SKIP() << NoReferenceData("brighton_beach_rect");
  }
  const StereoQuality& quality = matched->quality;
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

/// Standard deviation, by 1.48 times the median distance, of the depths of a window about their
/// plane; NaN when less than 90 % of it is known. The plane is fitted twice, the second time
/// without what is further than three deviations off.
double PlaneResidual(const ImageF& depth_m, int x0, int y0, int side) {
  std::vector<Eigen::Vector4d> rows;  // 1, x, y, depth
  for (int y = y0; y < y0 + side; ++y) {
    for (int x = x0; x < x0 + side; ++x) {
      if (!std::isnan(depth_m.at(x, y))) {
        rows.emplace_back(1, x - x0, y - y0, depth_m.at(x, y));
      }
    }
  }
  if (static_cast<double>(rows.size()) < 0.9 * side * side) {
    return NAN;
  }
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  double deviation = INFINITY;
  for (int pass = 0; pass < 2; ++pass) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector4d& row : rows) {
      if (pass == 0 || std::abs(row.head<3>().dot(plane) - row[3]) < 3 * deviation) {
        normal += row.head<3>() * row.head<3>().transpose();
        right += row.head<3>() * row[3];
      }
    }
    plane = normal.ldlt().solve(right);
    std::vector<double> distances;
    for (const Eigen::Vector4d& row : rows) {
      distances.push_back(std::abs(row.head<3>().dot(plane) - row[3]));
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    deviation = 1.4826 * *middle;
  }
  return deviation;
}

// Every 2 m window that is at least 90 % known counts; which of them lie on road or lawn is not
// chosen by hand. The flattest tenth of them is ground without grass tufts or kerbs: the noise
// floor of the map, to be compared with the set's own 2.2 cm.
TEST(Brighton, FlatGroundIsFlatToTwoCentimetres) {
  for (const char* rig : {"pair_25_26", "pair_33_34"}) {
    SCOPED_TRACE(rig);
    const auto matched = MatchPair(rig);
    if (!matched) {
      GTEST_SKIP() << NoReferenceData("brighton_beach_rect");
    }
    constexpr int kSide_px = 59;  // 2 m at 39 m
    const ImageF& depth_m = matched->range.depth_m;
    std::vector<double> residuals;
    for (int y = 0; y + kSide_px <= depth_m.height(); y += kSide_px) {
      for (int x = 0; x + kSide_px <= depth_m.width(); x += kSide_px) {
        const double residual = PlaneResidual(depth_m, x, y, kSide_px);
        if (!std::isnan(residual)) {
          residuals.push_back(residual);
        }
      }
    }
    ASSERT_GT(residuals.size(), 40U);
    std::sort(residuals.begin(), residuals.end());
    const auto at = [&](double share) {
      return 100 *
             residuals[static_cast<std::size_t>(share * static_cast<double>(residuals.size() - 1))];
    };
    std::printf(
        "%s: %zu windows; plane residual %.2f cm (flattest), %.2f (10 %%), %.2f (25 %%), "
        "%.2f (median) cm\n",
        rig, residuals.size(), at(0), at(0.1), at(0.25), at(0.5));
    EXPECT_LE(at(0.1), 2.2);
  }
}

}  // namespace
}  // namespace palace
