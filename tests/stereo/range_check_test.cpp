// The rig's scale against the laser: right, wrong, noisy, and with the spot on a bush.
#include "engine/stereo/range_check.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/core/random.h"

namespace palace {
namespace {

constexpr double kDepth_m = 15.24;

/// A flat range map whose depths are `scale` times the truth, with noise of `sigma_m`.
RangeMap FlatMap(double scale, double sigma_m, std::uint64_t seed) {
  RangeMap map;
  map.camera = PinholeFromFov(64, 48, 0.785398);
  map.depth_m = ImageF(64, 48);
  RandomStream random(seed);
  for (float& depth : map.depth_m.pixels()) {
    depth = static_cast<float>(scale * kDepth_m + sigma_m * random.Normal());
  }
  return map;
}

RangeCheck Checked(double scale, double laser_sigma_m, std::uint64_t seed, int pairs = 40) {
  RangeCheck check;
  RandomStream random(seed, "laser");
  for (int i = 0; i < pairs; ++i) {
    const double laser_m = kDepth_m + laser_sigma_m * random.Normal();
    check.Add(FlatMap(scale, 0.05, seed + static_cast<std::uint64_t>(i)), {0, 0, laser_m});
  }
  return check;
}

TEST(RangeCheck, FindsTheScaleWithinItsSigma) {
  int inside = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double scale = 0.9 + 0.001 * trial;
    const RangeAgreement found =
        Checked(scale, 0.05, static_cast<std::uint64_t>(1000 * trial)).agreement();
    inside += std::abs(found.ratio - scale) < 3 * found.sigma ? 1 : 0;
    EXPECT_NEAR(found.ratio, scale, 0.005) << "trial " << trial;
  }
  EXPECT_GE(inside, kTrials * 95 / 100);
}

TEST(RangeCheck, SaysNothingBeforeItHasSeenEnough) {
  EXPECT_TRUE(std::isnan(Checked(1, 0.03, 1, RangeCheck::kLeastPairs - 1).agreement().ratio));
  EXPECT_NEAR(Checked(1, 0.03, 1, RangeCheck::kLeastPairs).agreement().ratio, 1, 0.01);
}

TEST(RangeCheck, ABushUnderAFewSpotsDoesNotMoveIt) {
  RangeCheck check = Checked(1, 0.03, 5, 30);
  for (int i = 0; i < 9; ++i) {
    check.Add(FlatMap(1, 0.05, 99), {0, 0, kDepth_m - 1.5});
  }
  EXPECT_NEAR(check.agreement().ratio, 1, 0.005);
}

TEST(RangeCheck, UnknownPixelsAndSpotsOutsideThePictureDoNotCount) {
  RangeCheck check;
  RangeMap empty = FlatMap(1, 0, 1);
  for (float& depth : empty.depth_m.pixels()) {
    depth = NAN;
  }
  for (int i = 0; i < 50; ++i) {
    check.Add(empty, {0, 0, kDepth_m});
    check.Add(FlatMap(1, 0, 1), {100, 0, kDepth_m});
    check.Add(FlatMap(1, 0, 1), {0, 0, -kDepth_m});
    check.Add(FlatMap(1, 0, 1), {0, 0, NAN});
  }
  EXPECT_EQ(check.agreement().pairs, 0);
  EXPECT_TRUE(std::isnan(check.agreement().ratio));
}

}  // namespace
}  // namespace palace
