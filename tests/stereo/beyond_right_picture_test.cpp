// Ground that only the left camera sees: a pattern that repeats makes pits there, which are
// refused.
#include "engine/stereo/beyond_right_picture.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/stereo/stereo.h"

namespace palace {
namespace {

constexpr double kBaseline_m = 1;
constexpr double kHeight_m = 6;

RigidTransform Pose(double tilt_deg, double roll_deg, double ground_m) {
  RigidTransform X_WC;
  X_WC.R = RotationFromEuler({Rad(roll_deg), 0, 0.7}) * CameraRotationFromTilt(Rad(tilt_deg));
  X_WC.p = {40, -20, -kHeight_m - ground_m};
  return X_WC;
}

struct PoseRow {
  const char* name;
  double tilt_deg;
  double roll_deg;
};

// Against the plain way: the ray of each pixel, cut with the ground.
TEST(BeyondRightPicture, KeepsWhatTheRightCameraCanSee) {
  RandomStream random(7, "ranges");
  for (const PoseRow& row : {PoseRow{"down", -90, 0}, PoseRow{"slant", -45, 0},
                             PoseRow{"rolled", -45, 12}, PoseRow{"over the horizon", -10, -5}}) {
    SCOPED_TRACE(row.name);
    const RigidTransform X_WC = Pose(row.tilt_deg, row.roll_deg, 2);
    RangeMap range;
    range.camera = PinholeFromFov(160, 120, Rad(45));
    range.baseline_m = kBaseline_m;
    for (ImageF* layer :
         {&range.disparity_px, &range.disparity_sigma_px, &range.depth_m, &range.depth_sigma_m}) {
      *layer = ImageF(160, 120);
      for (float& value : layer->pixels()) {
        value = static_cast<float>(random.Uniform(0, 60));
      }
    }
    const RangeMap before = range;
    RefuseBeyondRightPicture(X_WC, 2, range);
    int refused = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        const double down = (X_WC.R * RayFromPixel(range.camera, {1.0 * x, 1.0 * y})).z();
        const double ground_px = std::max(0.0, range.FocalTimesBaseline() * down / kHeight_m);
        const bool shared = x >= ground_px || before.disparity_px.at(x, y) >= 0.92 * ground_px;
        refused += shared ? 0 : 1;
        for (const ImageF* layer : {&range.disparity_px, &range.disparity_sigma_px, &range.depth_m,
                                    &range.depth_sigma_m}) {
          ASSERT_EQ(std::isfinite(layer->at(x, y)), shared) << x << ',' << y;
        }
      }
    }
    EXPECT_GT(refused, 0);
  }
}

// Level ground 100 px of disparity away whose texture repeats every 40 px: left of column 100 the
// true match is missing, and the same texture 40 px on looks as good.
TEST(BeyondRightPicture, APatternThatRepeatsMakesNoPit) {
  constexpr int kWidth = 320;
  constexpr int kRows = 64;
  constexpr int kGround_px = 100;
  constexpr int kPeriod_px = 40;
  const PinholeCamera camera = PinholeFromFov(kWidth, kRows, Rad(45));
  RandomStream random(3, "texture");
  ImageU8 left(kWidth, kRows);
  ImageU8 right(kWidth, kRows);
  for (int y = 0; y < kRows; ++y) {
    std::vector<std::uint8_t> texture(kPeriod_px);
    for (std::uint8_t& grey : texture) {
      grey = static_cast<std::uint8_t>(random.Uniform(20, 235));
    }
    std::vector<std::uint8_t> ground(kWidth + kGround_px);
    for (std::size_t x = 0; x < ground.size(); ++x) {
      // It repeats at the left rim alone, or nothing in the picture could be matched.
      ground[x] =
          x < 160 ? texture[x % kPeriod_px] : static_cast<std::uint8_t>(random.Uniform(20, 235));
    }
    for (int x = 0; x < kWidth; ++x) {
      left.at(x, y) = ground[static_cast<std::size_t>(x)];
      right.at(x, y) = ground[static_cast<std::size_t>(x + kGround_px)];
    }
  }
  StereoMatcher matcher;
  const double height_m = camera.fx_px * kBaseline_m / kGround_px;
  auto found = matcher.Match(left, right, camera, kBaseline_m, {32, 96}, {}, {});
  ASSERT_TRUE(found.ok()) << found.error().message;
  const auto pits = [&] {
    int count = 0;
    for (const float depth : found->range.depth_m.pixels()) {
      count += depth > 1.2 * height_m ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(pits(), 100);
  RigidTransform X_WC;
  X_WC.R = CameraRotationFromTilt(Rad(-90));
  X_WC.p.z() = -height_m;
  RefuseBeyondRightPicture(X_WC, 0, found->range);
  EXPECT_EQ(pits(), 0);
  EXPECT_TRUE(std::isfinite(found->range.depth_m.at(kWidth / 2, kRows / 2)));
}

}  // namespace
}  // namespace palace
