// Stereo on ray-cast ground with exact depths: the thesis's rig at 50 ft, nadir and 45 degrees.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/core/hash.h"
#include "engine/core/units.h"
#include "engine/stereo/accuracy.h"
#include "engine/stereo/stereo.h"
#include "tests/support/synthetic_stereo.h"

namespace palace {
namespace {

using synthetic::Pair;

constexpr double kHeight_m = 50 * kMetresPerFoot;
constexpr double kBoxHeight_m = 0.1524;  // 6 inches

PinholeCamera ThesisCamera() { return PinholeFromFov(640, 480, Rad(45)); }

Result<StereoResult> Match(const StereoView& view, const ImageU8& left, const ImageU8& right,
                           const StereoSettings& settings = {}) {
  const DisparityWindow window =
      PredictWindow(view.camera, view.baseline_m, view.X_WC, 0, 2, settings);
  StereoMatcher matcher;
  return matcher.Match(left, right, view.camera, view.baseline_m, window, settings, {});
}

Result<StereoResult> Match(const Pair& pair) {
  const DisparityWindow window =
      PredictWindow(pair.camera, pair.baseline_m, pair.X_WC, 0, 2, StereoSettings{});
  StereoMatcher matcher;
  return matcher.Match(pair.left, pair.right, pair.camera, pair.baseline_m, window, {}, {});
}

Result<StereoResult> MatchExposed(const StereoView& view, double noise_grey) {
  return Match(view, Expose(view.left_grey, {noise_grey}, 1),
               Expose(view.right_grey, {noise_grey}, 2));
}

DisparityAccuracy Compare(const StereoView& view, const RangeMap& range) {
  return CompareDisparity(range.disparity_px, range.disparity_sigma_px,
                          DisparityFromDepth(view.depth_m, view.camera.fx_px * view.baseline_m));
}

double MeanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

double ShareBelow(const std::vector<double>& values, double limit) {
  double below = 0;
  for (const double value : values) {
    below += value <= limit ? 1 : 0;
  }
  return below / static_cast<double>(values.size());
}

/// Stones are near the size of a pixel: with fewer rays their edges alias.
int SamplesFor(GroundTexture texture) { return texture == GroundTexture::kGravel ? 4 : 3; }

struct ViewRow {
  GroundTexture texture;
  double tilt_deg;
  double share_within_1_5_deg = 0.95;  ///< of slope errors on lander-size patches
};

std::string NameOfRow(const testing::TestParamInfo<ViewRow>& row) {
  return std::string(NameOf(row.param.texture)) + (row.param.tilt_deg < -60 ? "Nadir" : "Slant");
}

/// Boxes 0.3 and 0.5 m wide, 6 inches high, and four 2 m ramps of 5 degrees, on level ground.
struct Obstacles {
  explicit Obstacles(double north_m) {
    for (int i = -1; i <= 1; ++i) {
      for (int j = 0; j <= 1; ++j) {
        small.push_back({north_m + 2.2 * i, -1.0 + 2.0 * j, 0.3, 0.3});
        wide.push_back({north_m + 2.2 * i + 1.1, -1.0 + 2.0 * j, 0.5, 0.5});
      }
    }
    for (const double east_m : {-3.4, 3.4}) {
      for (const double from_m : {-1.7, 1.7}) {
        ramps.push_back({north_m + from_m, east_m, 2.0, 2.0});
      }
    }
  }
  std::vector<Solid> Solids() const {
    std::vector<Solid> solids;
    for (const auto* boxes : {&small, &wide}) {
      for (const Patch& box : *boxes) {
        solids.push_back(
            MakeBox(box.north_m, box.east_m, box.size_north_m, box.size_east_m, kBoxHeight_m));
      }
    }
    for (const Patch& ramp : ramps) {
      solids.push_back(MakeWedge(ramp.north_m, ramp.east_m, 2, 2, Rad(5)));
    }
    return solids;
  }
  std::vector<Patch> small, wide, ramps;
};

std::vector<double> HeightsOf(const MeasuredView& view, const std::vector<Patch>& boxes) {
  std::vector<double> heights;
  for (const Patch& box : boxes) {
    heights.push_back(MeasuredHeight(view, box, kBoxHeight_m));
  }
  return heights;
}

class FiftyFeet : public testing::TestWithParam<ViewRow> {};

TEST_P(FiftyFeet, MeasuresSixInchObjectsAndFiveDegreeRampsWithHonestSigmas) {
  const double north_m = GetParam().tilt_deg < -60 ? 0 : kHeight_m;
  const Obstacles obstacles(north_m);
  World world;
  world.ground.texture = GetParam().texture;
  world.solids = obstacles.Solids();
  const StereoView view = ViewFrom(world, ThesisCamera(), kHeight_m, Rad(GetParam().tilt_deg),
                                   SamplesFor(GetParam().texture));
  for (const double noise_grey : {1.0, 2.0, 4.0}) {
    SCOPED_TRACE(noise_grey);
    const auto result = MatchExposed(view, noise_grey);
    ASSERT_TRUE(result.ok()) << result.error().message;
    const DisparityAccuracy accuracy = Compare(view, result->range);
    const MeasuredView measured{view.camera, view.X_WC, result->range.depth_m, view.depth_m};
    const double small_m = MeanOf(HeightsOf(measured, obstacles.small));
    const double wide_m = MeanOf(HeightsOf(measured, obstacles.wide));
    std::vector<double> ramps_deg, slope_errors_deg;
    for (const Patch& ramp : obstacles.ramps) {
      const Patch inside{ramp.north_m, ramp.east_m, 1.8, 1.8};
      ramps_deg.push_back(Deg(MeasureSlope(measured, inside).slope_rad));
    }
    for (const PatchSlope& slope : SlopesOverGround(measured, view.baseline_m, 3.6)) {
      slope_errors_deg.push_back(Deg(slope.error_rad));
    }
    std::printf(
        "noise %.0f: coverage %.3f, outliers %.4f, rms %.3f px, lock %.3f px, error/sigma %.2f; "
        "boxes %.1f cm (0.3 m) %.1f cm (0.5 m); ramps %.2f deg; slopes within 0.5: %.2f, within "
        "1.5: %.2f of %zu\n",
        noise_grey, accuracy.coverage, accuracy.outliers, accuracy.rms_px, accuracy.lock_px,
        accuracy.normalised, 100 * small_m, 100 * wide_m, MeanOf(ramps_deg),
        ShareBelow(slope_errors_deg, 0.5), ShareBelow(slope_errors_deg, 1.5),
        slope_errors_deg.size());
    EXPECT_GE(accuracy.normalised, 0.8);
    EXPECT_LE(accuracy.normalised, 1.25);
    EXPECT_LT(accuracy.outliers, 0.002);
    if (noise_grey > 2) {
      continue;  // weak texture is mostly noise then: the sigmas say so
    }
    EXPECT_GT(accuracy.coverage, 0.97);
    EXPECT_NEAR(small_m, kBoxHeight_m, 0.03);
    EXPECT_NEAR(wide_m, kBoxHeight_m, 0.03);
    EXPECT_NEAR(MeanOf(ramps_deg), 5, 0.5);
    ASSERT_FALSE(slope_errors_deg.empty());
    EXPECT_GE(ShareBelow(slope_errors_deg, 0.5), 0.5);
    EXPECT_GE(ShareBelow(slope_errors_deg, 1.5), GetParam().share_within_1_5_deg);
  }
}

INSTANTIATE_TEST_SUITE_P(Views, FiftyFeet,
                         testing::Values(ViewRow{GroundTexture::kGravel, -90},
                                         ViewRow{GroundTexture::kGravel, -45},
                                         ViewRow{GroundTexture::kGrass, -90},
                                         ViewRow{GroundTexture::kGrass, -45},
                                         ViewRow{GroundTexture::kAsphalt, -90},
                                         ViewRow{GroundTexture::kAsphalt, -45, 0.9}),
                         NameOfRow);

// A slope sweeps disparity through every fraction of a pixel: mean error per fraction is the lock.
class LockCurve : public testing::TestWithParam<ViewRow> {};

TEST_P(LockCurve, IsFlat) {
  World world;
  world.ground.texture = GetParam().texture;
  world.ground.rise_north = GetParam().tilt_deg < -60 ? 0.15 : 0;
  const StereoView view = ViewFrom(world, ThesisCamera(), kHeight_m, Rad(GetParam().tilt_deg),
                                   SamplesFor(GetParam().texture));
  const auto result = MatchExposed(view, 2);
  ASSERT_TRUE(result.ok()) << result.error().message;
  const DisparityAccuracy accuracy = Compare(view, result->range);
  std::printf("lock %.4f px, rms %.3f px, error/sigma %.2f\n", accuracy.lock_px, accuracy.rms_px,
              accuracy.normalised);
  for (const double mean : accuracy.mean_error_px) {
    EXPECT_FALSE(std::isnan(mean)) << "every fraction must be met";
  }
  EXPECT_LE(accuracy.lock_px, 0.05);
  EXPECT_GE(accuracy.normalised, 0.8);
  EXPECT_LE(accuracy.normalised, 1.2);
}

INSTANTIATE_TEST_SUITE_P(
    Views, LockCurve,
    testing::Values(ViewRow{GroundTexture::kGravel, -90}, ViewRow{GroundTexture::kGravel, -45},
                    ViewRow{GroundTexture::kGrass, -90}, ViewRow{GroundTexture::kGrass, -45},
                    ViewRow{GroundTexture::kAsphalt, -90}, ViewRow{GroundTexture::kAsphalt, -45}),
    NameOfRow);

// At 10 ft and 45 degrees disparity changes by half a pixel a row: neither flattened nor noisier.
TEST(StereoAccuracy, SteepGroundIsMeasuredLikeLevelGround) {
  World world;
  world.ground.texture = GroundTexture::kGrass;
  const StereoView view = ViewFrom(world, ThesisCamera(), 10 * kMetresPerFoot, Rad(-45), 3);
  const auto result = MatchExposed(view, 2);
  ASSERT_TRUE(result.ok()) << result.error().message;
  const DisparityAccuracy accuracy = Compare(view, result->range);
  std::printf("10 ft: rms %.3f px, coverage %.3f, error/sigma %.2f\n", accuracy.rms_px,
              accuracy.coverage, accuracy.normalised);
  EXPECT_LT(accuracy.rms_px, 0.06);
  EXPECT_GT(accuracy.coverage, 0.97);
  EXPECT_LE(accuracy.normalised, 1.25);
  EXPECT_GE(accuracy.normalised, 0.8);
}

// ---- cameras that differ ----

cv::Mat Matrix(ImageF& image) {
  return cv::Mat(image.height(), image.width(), CV_32F, image.pixels().data());
}

/// Darker towards the corners, by `share` at the farthest.
ImageF Vignetted(ImageF image, double share) {
  const double cx = image.width() / 2.0, cy = image.height() / 2.0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double r2 = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (cx * cx + cy * cy);
      image.at(x, y) *= static_cast<float>(1 - share * r2);
    }
  }
  return image;
}

ImageF Blurred(ImageF image, double sigma_px) {
  cv::Mat view = Matrix(image);
  cv::GaussianBlur(view, view, {0, 0}, sigma_px);
  return image;
}

/// Moved down by a fraction of a row.
ImageF MovedDown(ImageF image, double rows) {
  cv::Mat view = Matrix(image);
  const cv::Matx23d shift(1, 0, 0, 0, 1, rows);
  cv::Mat moved;
  cv::warpAffine(view, moved, shift, view.size(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  moved.copyTo(view);
  return image;
}

struct DifferenceRow {
  const char* name;
  Exposure exposure;
  double vignetting = 0;
  double blur_px = 0;
  double rows = 0;
  double most_rms_px = 0;
};

TEST(StereoAccuracy, ToleratesCamerasThatDiffer) {
  World world;
  world.ground.texture = GroundTexture::kGravel;
  const StereoView view = ViewFrom(world, ThesisCamera(), kHeight_m, Rad(-45), 4);
  const ImageU8 left = Expose(view.left_grey, {}, 1);
  for (const DifferenceRow& row : {DifferenceRow{"alike", {}, 0, 0, 0, 0.09},
                                   DifferenceRow{"brighter", {2, 1.2, 20}, 0, 0, 0, 0.09},
                                   DifferenceRow{"darker", {2, 0.8, -10}, 0, 0, 0, 0.09},
                                   DifferenceRow{"vignetting 30 %", {}, 0.3, 0, 0, 0.09},
                                   DifferenceRow{"blur 0.7 px", {}, 0, 0.7, 0, 0.12},
                                   DifferenceRow{"rows 0.25 px", {}, 0, 0, 0.25, 0.12},
                                   DifferenceRow{"rows 0.5 px", {}, 0, 0, 0.5, 0.18}}) {
    SCOPED_TRACE(row.name);
    ImageF grey = view.right_grey;
    grey = row.vignetting > 0 ? Vignetted(std::move(grey), row.vignetting) : std::move(grey);
    grey = row.blur_px > 0 ? Blurred(std::move(grey), row.blur_px) : std::move(grey);
    grey = row.rows > 0 ? MovedDown(std::move(grey), row.rows) : std::move(grey);
    const auto result = Match(view, left, Expose(grey, row.exposure, 2));
    ASSERT_TRUE(result.ok());
    const DisparityAccuracy accuracy = Compare(view, result->range);
    const StereoQuality& quality = result->quality;
    std::printf(
        "%-16s rms %.3f px, coverage %.3f, outliers %.4f, error/sigma %.2f; exposure %.2f, "
        "rows %.2f +- %.2f px\n",
        row.name, accuracy.rms_px, accuracy.coverage, accuracy.outliers, accuracy.normalised,
        quality.exposure_ratio, quality.row_shift_px, quality.row_spread_px);
    EXPECT_LT(accuracy.rms_px, row.most_rms_px);
    EXPECT_LT(accuracy.outliers, 0.001);
    EXPECT_GT(accuracy.coverage, 0.98);
    EXPECT_NEAR(quality.row_shift_px, row.rows, 0.1);
    EXPECT_LT(quality.row_spread_px, 0.2);
    EXPECT_NEAR(quality.exposure_ratio,
                (1 - row.vignetting / 3) * row.exposure.gain + row.exposure.offset / 128, 0.06);
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
