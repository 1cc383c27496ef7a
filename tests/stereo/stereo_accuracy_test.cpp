// Stereo on ray-cast ground with exact depths: the thesis's rig at 50 ft, nadir and 45 degrees.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "engine/core/hash.h"
#include "engine/core/units.h"
#include "engine/stereo/stereo.h"
#include "tests/support/synthetic_stereo.h"

namespace palace {
namespace {

using synthetic::Box;
using synthetic::Pair;
using synthetic::World;

constexpr double kHeight_m = 50 * kMetresPerFoot;

Result<StereoResult> Match(const Pair& pair, const StereoSettings& settings = {}) {
  const DisparityWindow window =
      PredictWindow(pair.camera, pair.baseline_m, pair.X_WC, 0, 2, settings);
  StereoMatcher matcher;
  return matcher.Match(pair.left, pair.right, pair.camera, pair.baseline_m, window, settings, {});
}

struct Accuracy {
  double rms_px = 0;      ///< of errors below 1 px
  double outliers = 0;    ///< share of errors above 1 px
  double lock_px = 0;     ///< largest |mean error| over ten bins of the true fraction
  double coverage = 0;    ///< known share of pixels both cameras see
  double normalised = 0;  ///< standard deviation of error / sigma
};

Accuracy Measure(const Pair& pair, const RangeMap& range) {
  const double fb = pair.camera.fx_px * pair.baseline_m;
  std::array<double, 10> bin_sum{};
  std::array<int, 10> bin_count{};
  double square = 0;
  double normalised = 0;
  int good = 0;
  int bad = 0;
  int seen = 0;
  for (int y = 0; y < pair.camera.height; ++y) {
    for (int x = 0; x < pair.camera.width; ++x) {
      const double truth = fb / pair.depth_m.at(x, y);
      if (x - truth < 8) {
        continue;  // not in the right picture
      }
      ++seen;
      const double error = range.disparity_px.at(x, y) - truth;
      if (std::isnan(error)) {
        continue;
      }
      if (std::abs(error) > 1) {
        ++bad;
        continue;
      }
      ++good;
      square += error * error;
      const double ratio = error / range.disparity_sigma_px.at(x, y);
      normalised += ratio * ratio;
      const auto bin = static_cast<std::size_t>((truth - std::floor(truth)) * 10) % 10;
      bin_sum[bin] += error;
      ++bin_count[bin];
    }
  }
  Accuracy accuracy;
  accuracy.rms_px = std::sqrt(square / good);
  accuracy.normalised = std::sqrt(normalised / good);
  accuracy.outliers = static_cast<double>(bad) / (good + bad);
  accuracy.coverage = static_cast<double>(good + bad) / seen;
  for (std::size_t k = 0; k < bin_sum.size(); ++k) {
    if (bin_count[k] > 500) {
      accuracy.lock_px = std::max(accuracy.lock_px, std::abs(bin_sum[k] / bin_count[k]));
    }
  }
  return accuracy;
}

/// Mean height of the inner box top minus that of the ground around it, metres.
double MeasuredBoxHeight(const Pair& pair, const RangeMap& range, const Box& box) {
  double top = 0;
  double ground = 0;
  int top_count = 0;
  int ground_count = 0;
  for (int y = 0; y < pair.camera.height; ++y) {
    for (int x = 0; x < pair.camera.width; ++x) {
      const float depth = range.depth_m.at(x, y);
      if (std::isnan(depth)) {
        continue;
      }
      const Eigen::Vector3d ray =
          RayFromPixel(pair.camera, {static_cast<double>(x), static_cast<double>(y)});
      const Eigen::Vector3d truth = pair.X_WC * (ray * pair.depth_m.at(x, y));
      const double height = HeightFromDown((pair.X_WC * (ray * depth)).z());
      const double away =
          std::max(std::abs(truth.x() - box.north_m), std::abs(truth.y() - box.east_m));
      if (truth.z() < -0.9 * box.height_m && away < box.side_m / 2 - 0.05) {
        top += height;
        ++top_count;
      } else if (std::abs(truth.z()) < 0.01 && away > box.side_m && away < box.side_m + 0.6) {
        ground += height;
        ++ground_count;
      }
    }
  }
  return top / top_count - ground / ground_count;
}

struct ViewRow {
  const char* name;
  double tilt_deg;
  double ground_north_m;  ///< where the axis meets the ground
};

class StereoView : public testing::TestWithParam<ViewRow> {};

TEST_P(StereoView, MeasuresTexturedGroundToATenthOfAPixel) {
  const double north = GetParam().ground_north_m;
  World world;
  world.boxes = {{north, 1.0, 0.5}, {north + 1.5, -1.5, 0.3}};
  const Pair pair = synthetic::MakePair(world, kHeight_m, Rad(GetParam().tilt_deg));
  const auto result = Match(pair);
  ASSERT_TRUE(result.ok()) << result.error().message;
  const Accuracy accuracy = Measure(pair, result->range);
  const double wide = MeasuredBoxHeight(pair, result->range, world.boxes[0]);
  const double narrow = MeasuredBoxHeight(pair, result->range, world.boxes[1]);
  std::printf(
      "%s: rms %.3f px, lock %.3f px, outliers %.4f, coverage %.3f, error/sigma %.2f, "
      "6-inch boxes %.1f cm (0.5 m) %.1f cm (0.3 m), rows %.3f px\n",
      GetParam().name, accuracy.rms_px, accuracy.lock_px, accuracy.outliers, accuracy.coverage,
      accuracy.normalised, 100 * wide, 100 * narrow, result->quality.row_error_px);
  EXPECT_LT(accuracy.rms_px, 0.12);
  EXPECT_LE(accuracy.lock_px, 0.08);
  EXPECT_LT(accuracy.outliers, 0.01);
  EXPECT_GT(accuracy.coverage, 0.9);
  EXPECT_NEAR(wide, 0.1524, 0.04);
  EXPECT_GT(accuracy.normalised, 0.5);
  EXPECT_LT(accuracy.normalised, 1.6);
  EXPECT_LT(result->quality.row_error_px, 0.1);
}

INSTANTIATE_TEST_SUITE_P(FiftyFeet, StereoView,
                         testing::Values(ViewRow{"Nadir", -90, 0},
                                         ViewRow{"Slant", -45, kHeight_m}),
                         [](const auto& row) { return std::string(row.param.name); });

// A slope sweeps disparity through every fraction of a pixel: mean error per fraction is the lock.
TEST(StereoAccuracy, DoesNotLockToWholePixels) {
  World world;
  world.slope_north = 0.2;
  const Pair pair = synthetic::MakePair(world, kHeight_m, Rad(-90));
  const auto result = Match(pair);
  ASSERT_TRUE(result.ok()) << result.error().message;
  const Accuracy accuracy = Measure(pair, result->range);
  std::printf("Slope: rms %.3f px, lock %.3f px\n", accuracy.rms_px, accuracy.lock_px);
  EXPECT_LE(accuracy.lock_px, 0.04);
  EXPECT_LT(accuracy.rms_px, 0.12);
}

struct LightRow {
  const char* name;
  double gain;
  double offset;
};

TEST(StereoAccuracy, ToleratesCamerasOfDifferentBrightness) {
  for (const LightRow& row : {LightRow{"brighter", 1.2, 20}, LightRow{"darker", 0.8, -10}}) {
    SCOPED_TRACE(row.name);
    const Pair pair = synthetic::MakePair({}, kHeight_m, Rad(-45), 2, row.gain, row.offset);
    const auto result = Match(pair);
    ASSERT_TRUE(result.ok());
    const Accuracy accuracy = Measure(pair, result->range);
    std::printf("%s: rms %.3f px, coverage %.3f, exposure ratio %.3f\n", row.name, accuracy.rms_px,
                accuracy.coverage, result->quality.exposure_ratio);
    EXPECT_LT(accuracy.rms_px, 0.12);
    EXPECT_LT(accuracy.outliers, 0.01);
    EXPECT_GT(accuracy.coverage, 0.9);
    EXPECT_NEAR(result->quality.exposure_ratio, row.gain + row.offset / 128, 0.05);
  }
}

TEST(StereoAccuracy, DepthFollowsDisparityAndSigma) {
  const Pair pair = synthetic::MakePair({}, kHeight_m, Rad(-90), 2, 1, 0, 320, 240);
  const auto result = Match(pair);
  ASSERT_TRUE(result.ok());
  const RangeMap& range = result->range;
  const double fb = pair.camera.fx_px * pair.baseline_m;
  int known = 0;
  for (std::size_t i = 0; i < range.depth_m.pixels().size(); ++i) {
    const float d = range.disparity_px.pixels()[i];
    const float z = range.depth_m.pixels()[i];
    ASSERT_EQ(std::isnan(d), std::isnan(z));
    ASSERT_EQ(std::isnan(d), std::isnan(range.depth_sigma_m.pixels()[i]));
    ASSERT_EQ(std::isnan(d), std::isnan(range.disparity_sigma_px.pixels()[i]));
    if (!std::isnan(d)) {
      ++known;
      ASSERT_NEAR(z, fb / d, 1e-4);
      ASSERT_NEAR(range.depth_sigma_m.pixels()[i],
                  z * z * range.disparity_sigma_px.pixels()[i] / fb, 1e-4);
    }
  }
  EXPECT_NEAR(result->quality.coverage, known / (320.0 * 240.0), 1e-12);
  EXPECT_NEAR(result->quality.median_depth_m, kHeight_m, 0.05);
}

TEST(StereoAccuracy, SameBitsForAnyNumberOfThreads) {
  const Pair pair = synthetic::MakePair({{{14, 1, 0.6, 0.4}}}, kHeight_m, Rad(-45));
  const int threads = cv::getNumThreads();
  std::vector<StereoResult> results;
  // One thread last: TBB does not raise a limit again within a process.
  for (const int count : {3, 2, 1}) {
    cv::setNumThreads(count);
    auto result = Match(pair);
    ASSERT_TRUE(result.ok());
    results.push_back(std::move(result).value());
  }
  cv::setNumThreads(threads);
  const auto bits = [](const ImageF& image) {
    ContentHash hash;
    hash.Add(image.pixels());
    return hash.value();
  };
  for (std::size_t k = 1; k < results.size(); ++k) {
    EXPECT_EQ(bits(results[0].range.disparity_px), bits(results[k].range.disparity_px));
    EXPECT_EQ(bits(results[0].range.disparity_sigma_px), bits(results[k].range.disparity_sigma_px));
    EXPECT_EQ(bits(results[0].range.depth_m), bits(results[k].range.depth_m));
  }
}

}  // namespace
}  // namespace palace
