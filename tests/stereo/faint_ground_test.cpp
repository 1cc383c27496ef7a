// What the half-size picture may fill: ground that is too faint for the full one, and nothing else.
#include "engine/stereo/faint_ground.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "engine/camera/pinhole.h"
#include "engine/core/units.h"
#include "engine/stereo/accuracy.h"
#include "engine/stereo/disparity.h"
#include "engine/stereo/hidden.h"
#include "engine/stereo/stereo.h"
#include "engine/world/painted_things.h"
#include "engine/world/ray_pictures.h"

namespace palace {
namespace {

constexpr double kHeight_m = 15;
constexpr double kNoise_grey = 2.5;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

struct FaintPair {
  StereoView view;
  ImageU8 left, right;
  DisparityWindow window;
  ImageF true_px;
};

FaintPair Draw(GroundTexture texture, double tilt_rad, bool boxes) {
  const double north_m = tilt_rad < Rad(-60) ? 0 : kHeight_m;
  World world;
  world.ground.texture = texture;
  for (int k = 0; boxes && k < 12; ++k) {
    const double size_m = 0.5 + 0.2 * (k % 4);
    world.solids.push_back(MakeBox(north_m - 3 + 1.8 * (k / 4), -4 + 2.1 * (k % 4), size_m, size_m,
                                   0.4 + 0.3 * (k % 5)));
  }
  FaintPair pair;
  pair.view = ViewFrom(world, PinholeFromFov(640, 480, Rad(45)), kHeight_m, tilt_rad, 3);
  pair.left = Expose(pair.view.left_grey, {kNoise_grey}, 1);
  pair.right = Expose(pair.view.right_grey, {kNoise_grey, 1.03, 4}, 2);
  pair.window = PredictWindow(pair.view.camera, pair.view.baseline_m, pair.view.X_WC, 0, 3, {});
  pair.true_px =
      DisparityFromDepth(pair.view.depth_m, pair.view.camera.fx_px * pair.view.baseline_m);
  return pair;
}

/// As the matcher does, in the full picture alone.
SubpixelDisparity FullSizeOnly(const FaintPair& pair) {
  const StereoSettings settings;
  SubpixelDisparity full = RefineDisparity(
      pair.left, pair.right, MatchWholePixels(pair.left, pair.right, pair.window, settings),
      {.window_px = settings.refine_window_px | 1, .max_sigma_px = settings.max_sigma_px});
  RefuseHidden(settings.max_refined_left_right_px, full.disparity_px, full.sigma_px);
  return full;
}

RangeMap Filled(const FaintPair& pair) {
  auto result = StereoMatcher().Match(pair.left, pair.right, pair.view.camera, pair.view.baseline_m,
                                      pair.window, {}, Timestamp{});
  EXPECT_TRUE(result.ok());
  return result->range;
}

/// Only what was unknown before.
ImageF Gained(const ImageF& before, ImageF after) {
  for (std::size_t k = 0; k < after.pixels().size(); ++k) {
    if (std::isfinite(before.pixels()[k])) {
      if (std::isfinite(after.pixels()[k])) {
        EXPECT_EQ(after.pixels()[k], before.pixels()[k]) << "measured in full and changed";
      }
      after.pixels()[k] = kUnknown;
    }
  }
  return after;
}

TEST(FaintGround, SnowIsKnownToItsSigma) {
  for (const double tilt_deg : {-90.0, -50.0}) {
    for (const bool boxes : {false, true}) {
      const FaintPair pair = Draw(GroundTexture::kSnow, Rad(tilt_deg), boxes);
      const SubpixelDisparity full = FullSizeOnly(pair);
      const RangeMap filled = Filled(pair);
      const auto before = CompareDisparity(full.disparity_px, full.sigma_px, pair.true_px);
      const auto all =
          CompareDisparity(filled.disparity_px, filled.disparity_sigma_px, pair.true_px);
      const auto gained = CompareDisparity(Gained(full.disparity_px, filled.disparity_px),
                                           filled.disparity_sigma_px, pair.true_px);
      std::printf(
          "%3.0f deg, boxes %d: known %.3f, then %.3f; gained rms %.3f px, %.2f sigma, "
          "%.4f wrong\n",
          tilt_deg, boxes, before.coverage, all.coverage, gained.rms_px, gained.normalised,
          gained.outliers);
      EXPECT_LT(before.coverage, 0.5);
      EXPECT_GT(all.coverage, 0.7);
      // Boxes of the same faint snow: beside their edges the wider window is wrong more often.
      EXPECT_LT(gained.outliers, boxes ? 0.025 : 0.003);
      EXPECT_GT(gained.normalised, 0.8);
      EXPECT_LT(gained.normalised, 1.6);
    }
  }
}

/// On gravel what the full picture refuses is hidden from one camera or lies beside an edge.
TEST(FaintGround, WhatIsRefusedForAnotherReasonStaysUnknown) {
  for (const double tilt_deg : {-90.0, -50.0}) {
    const FaintPair pair = Draw(GroundTexture::kGravel, Rad(tilt_deg), true);
    const SubpixelDisparity full = FullSizeOnly(pair);
    const RangeMap filled = Filled(pair);
    const ImageF gained = Gained(full.disparity_px, filled.disparity_px);
    for (const float d : gained.pixels()) {
      ASSERT_TRUE(std::isnan(d));
    }
  }
}

/// A pool beside faint ground: the ground is filled, the water's even grey is not.
TEST(FaintGround, StillWaterStaysUnknown) {
  FaintPair pair = Draw(GroundTexture::kSnow, Rad(-90), false);
  const PaintedPool pool{0.5, 0.4, 1.5, 90};
  const RigidTransform& X_WC = pair.view.X_WC;
  PaintPool(pool, pair.view.camera, X_WC, pair.view.left_grey);
  PaintPool(pool, pair.view.camera, {X_WC.R, X_WC.p + pair.view.baseline_m * X_WC.R.col(0)},
            pair.view.right_grey);
  pair.left = Expose(pair.view.left_grey, {kNoise_grey}, 1);
  pair.right = Expose(pair.view.right_grey, {kNoise_grey}, 2);
  const RangeMap filled = Filled(pair);
  int inside = 0, known_inside = 0, outside = 0, known_outside = 0;
  for (int y = 20; y < 460; ++y) {
    for (int x = 80; x < 620; ++x) {
      const double depth_m = static_cast<double>(pair.view.depth_m.at(x, y));
      const Eigen::Vector3d p =
          X_WC * Eigen::Vector3d(depth_m * (x - pair.view.camera.cx_px) / pair.view.camera.fx_px,
                                 depth_m * (y - pair.view.camera.cy_px) / pair.view.camera.fy_px,
                                 depth_m);
      const double from_middle_m =
          std::hypot(p.x() - pool.north_m, p.y() - pool.east_m) - pool.radius_m;
      const bool known = std::isfinite(filled.disparity_px.at(x, y));
      // A window of the half picture reaches 0.17 m over the rim.
      inside += from_middle_m < -0.3 ? 1 : 0;
      known_inside += from_middle_m < -0.3 && known ? 1 : 0;
      outside += from_middle_m > 0.3 ? 1 : 0;
      known_outside += from_middle_m > 0.3 && known ? 1 : 0;
    }
  }
  ASSERT_GT(inside, 5000);
  std::printf("known in the water %.4f, beside it %.3f\n",
              static_cast<double>(known_inside) / inside,
              static_cast<double>(known_outside) / outside);
  EXPECT_LT(known_inside, 0.01 * inside);
  EXPECT_GT(known_outside, 0.8 * outside);
}

TEST(FaintGround, NothingIsAskedOfAPictureThatIsKnownOrOfOneThatTellsNoNoise) {
  const FaintPair gravel = Draw(GroundTexture::kGravel, Rad(-90), false);
  EXPECT_TRUE(
      FindFaintGround(gravel.left, gravel.right, FullSizeOnly(gravel).disparity_px).empty());
  const FaintPair snow = Draw(GroundTexture::kSnow, Rad(-90), false);
  const ImageF nothing(640, 480, kUnknown);
  EXPECT_TRUE(FindFaintGround(snow.left, snow.right, nothing).empty());
  EXPECT_FALSE(FindFaintGround(snow.left, snow.right, FullSizeOnly(snow).disparity_px).empty());
}

/// A refined disparity of something far away may lie a pixel below 0: no column is left of the
/// picture for it.
TEST(FaintGround, DisparitiesBelowZeroAreNoColumn) {
  const FaintPair snow = Draw(GroundTexture::kSnow, Rad(-90), false);
  ImageF disparity = FullSizeOnly(snow).disparity_px;
  for (int y = 0; y < disparity.height(); ++y) {
    disparity.at(0, y) = -1;
  }
  const ImageU8 faint = FindFaintGround(snow.left, snow.right, disparity);
  ASSERT_FALSE(faint.empty());
  EXPECT_EQ(faint.width(), 640);
}

TEST(FaintGround, SameBitsForAnyNumberOfThreads) {
  const FaintPair pair = Draw(GroundTexture::kSnow, Rad(-50), true);
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const RangeMap one = Filled(pair);
  cv::setNumThreads(2);
  const RangeMap two = Filled(pair);
  cv::setNumThreads(threads);
  const auto bits = [](const ImageF& image) {
    std::vector<std::uint32_t> values;
    for (const float v : image.pixels()) {
      values.push_back(std::bit_cast<std::uint32_t>(v));
    }
    return values;
  };
  EXPECT_EQ(bits(one.disparity_px), bits(two.disparity_px));
  EXPECT_EQ(bits(one.disparity_sigma_px), bits(two.disparity_sigma_px));
}

/// A ramp of disparities comes back as it was, between the middles of the half picture's pixels
/// too. Nothing is filled where a window meets a step, where a value stands out of its window by
/// more than its sigma, or where it is too uncertain.
TEST(FaintGround, FillsBetweenTheMiddlesOfLargerPixelsButNotBesideAStep) {
  constexpr int kWidth = 80, kRows = 40, kStepAt = 40;
  constexpr int kReach = 8;  // of a window of 9 pixels of the half picture
  const auto truth = [](double x, double y) {
    return 10 + 0.02 * x - 0.03 * y + (x > kStepAt - 0.5 ? 8 : 0);
  };
  SubpixelDisparity half{ImageF(kWidth / 2, kRows / 2), ImageF(kWidth / 2, kRows / 2, 0.1F)};
  for (int y = 0; y < kRows / 2; ++y) {
    for (int x = 0; x < kWidth / 2; ++x) {
      half.disparity_px.at(x, y) = static_cast<float>(truth(2 * x + 0.5, 2 * y + 0.5) / 2);
    }
  }
  half.sigma_px.at(3, 3) = 0.3F;
  half.disparity_px.at(8, 8) = kUnknown;
  half.disparity_px.at(30, 10) += 0.25F;
  const SubpixelDisparity none{ImageF(kWidth, kRows, kUnknown), ImageF(kWidth, kRows, kUnknown)};
  SubpixelDisparity filled = none;
  FillFaintGround(ImageU8(kWidth, kRows, kFaint), half, 0.5, filled);
  // At the rim of the picture windows are one-sided.
  for (int y = kReach; y < kRows - kReach; ++y) {
    for (int x = kReach; x < kWidth - kReach; ++x) {
      const auto within = [&](int i, int j, int reach) {
        return std::abs(x / 2 - i) <= reach && std::abs(y / 2 - j) <= reach;
      };
      const bool left_out = within(3, 3, 0) || within(8, 8, 0) || within(30, 10, 0) ||
                            std::abs(x - kStepAt + 0.5) < kReach;
      ASSERT_EQ(std::isnan(filled.disparity_px.at(x, y)), left_out) << x << " " << y;
      if (!left_out) {
        const bool beside = within(8, 8, 1) || within(30, 10, 1) ||
                            std::abs(x - kStepAt + 0.5) < kReach + 2;  // one-sided
        EXPECT_NEAR(filled.disparity_px.at(x, y), truth(x, y), beside ? 0.15 : 1e-4);
        EXPECT_NEAR(filled.sigma_px.at(x, y), 0.2, 1e-6);
      }
    }
  }
  SubpixelDisparity untouched = none;
  FillFaintGround(ImageU8(kWidth, kRows, kNoiseAlone), half, 0.5, untouched);
  for (const float d : untouched.disparity_px.pixels()) {
    ASSERT_TRUE(std::isnan(d));
  }
}

}  // namespace
}  // namespace palace
