#include "engine/camera/pinhole.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"

namespace palace {
namespace {

// Erratum E1: tan, not arctan. Erratum E2: pixel centres.
TEST(Pinhole, FocalLengthOfTheThesisCamera) {
  const PinholeCamera camera = PinholeFromFov(640, 480, Rad(45));
  EXPECT_NEAR(camera.fx_px, 772.54834, 1e-5);
  EXPECT_EQ(camera.fy_px, camera.fx_px);
  EXPECT_EQ(camera.cx_px, 319.5);
  EXPECT_EQ(camera.cy_px, 239.5);
}

TEST(Pinhole, FieldOfViewReachesFromEdgeToEdge) {
  const PinholeCamera camera = PinholeFromFov(640, 480, Rad(60));
  const double left = std::atan(RayFromPixel(camera, {-0.5, 0}).x());
  const double right = std::atan(RayFromPixel(camera, {639.5, 0}).x());
  EXPECT_NEAR(Deg(right - left), 60, 1e-12);
}

TEST(Pinhole, ProjectionInvertsRay) {
  constexpr std::uint64_t kSeed = 4;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  const PinholeCamera camera{800, 600, 700, 650, 410, 290};
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d pixel(random.Uniform(-100, 900), random.Uniform(-100, 700));
    const auto back = ProjectPinhole(camera, RayFromPixel(camera, pixel) * random.Uniform(0.1, 90));
    ASSERT_TRUE(back.has_value());
    EXPECT_LT((*back - pixel).norm(), 1e-9);
  }
}

TEST(Pinhole, NothingBehindTheCameraOrWithoutNumbers) {
  const PinholeCamera camera = PinholeFromFov(640, 480, Rad(45));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(ProjectPinhole(camera, {0, 0, -5}));
  EXPECT_FALSE(ProjectPinhole(camera, {1, 1, 0}));
  EXPECT_FALSE(ProjectPinhole(camera, {0, 0, 1e-7}));
  EXPECT_FALSE(ProjectPinhole(camera, {nan, 0, 5}));
  EXPECT_FALSE(ProjectPinhole(camera, {0, 0, inf}));
}

TEST(Pinhole, PictureIncludesItsOuterHalfPixels) {
  const PinholeCamera camera = PinholeFromFov(640, 480, Rad(45));
  EXPECT_TRUE(InPicture(camera, {-0.5, -0.5}));
  EXPECT_TRUE(InPicture(camera, {639.5, 479.5}));
  EXPECT_FALSE(InPicture(camera, {639.6, 0}));
  EXPECT_FALSE(InPicture(camera, {0, -0.6}));
  EXPECT_FALSE(InPicture(camera, {std::nan(""), 0}));
}

}  // namespace
}  // namespace palace
