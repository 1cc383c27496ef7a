#include "engine/tracking/picture_shift.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "tests/tracking/ground_world.h"

namespace palace {
namespace {

const PinholeCamera kCamera{640, 480, 772.548, 772.548, 319.5, 239.5};

RigidTransform CameraAt(const EulerAngles& attitude, double height_m = 15) {
  return {RotationFromEuler(attitude) * CameraRotationFromTilt(Rad(-45)),
          {-height_m, 0, -height_m}};
}

PicturePyramid Seen(GroundWorld& ground, const RigidTransform& X_WC, double gain = 1) {
  ImageU8 picture = ground.Render(kCamera, X_WC, 2);
  for (std::uint8_t& grey : picture.pixels()) {
    grey = static_cast<std::uint8_t>(std::min(255.0, gain * grey));
  }
  return MakePyramid(picture);
}

struct Turn {
  const char* name;
  EulerAngles by;
};

class Turns : public testing::TestWithParam<Turn> {};

// The middle moves as the middle of the first picture is seen by the second camera; within an
// eighth, for what turns about the axis and nearer ground at the lower edge do not quite cancel.
TEST_P(Turns, MoveThePictureAsTheirGeometrySays) {
  GroundWorld ground(3);
  const RigidTransform X_WC0 = CameraAt({}), X_WC1 = CameraAt(GetParam().by);
  const Eigen::Vector3d p_C1 = X_WC1.R.transpose() * X_WC0.R.col(2);
  const Eigen::Vector2d expected = kCamera.fx_px * p_C1.head<2>() / p_C1.z();
  const auto shift = ShiftBetween(Seen(ground, X_WC0), Seen(ground, X_WC1));
  ASSERT_TRUE(shift);
  EXPECT_NEAR(shift->x(), expected.x(), 0.15 + 0.12 * expected.norm());
  EXPECT_NEAR(shift->y(), expected.y(), 0.15 + 0.12 * expected.norm());
  const auto dimmed = ShiftBetween(Seen(ground, X_WC0), Seen(ground, X_WC1, 0.9));
  ASSERT_TRUE(dimmed);
  EXPECT_NEAR((*dimmed - *shift).norm(), 0, 0.3) << "a little less light";
}

/// A fifth of the contrast below the middle, without an edge there.
PicturePyramid SeenAbove(GroundWorld& ground, const RigidTransform& X_WC) {
  ImageU8 picture = ground.Render(kCamera, X_WC, 2);
  const auto& all = picture.pixels();
  const double mean = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  for (int y = picture.height() / 2; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      std::uint8_t& grey = picture.row(y)[x];
      grey = static_cast<std::uint8_t>(std::lround(mean + 0.2 * (grey - mean)));
    }
  }
  return MakePyramid(picture);
}

// A turn that is known is told of the middle wherever the texture lies; unknown, yaw is a tenth off.
TEST_P(Turns, ThatAreKnownMoveTheMiddleWhereverTheTextureLies) {
  GroundWorld ground(3);
  const RigidTransform X_WC0 = CameraAt({}), X_WC1 = CameraAt(GetParam().by);
  const Eigen::Matrix3d turn = X_WC1.R.transpose() * X_WC0.R;
  const Eigen::Vector2d expected = kCamera.fx_px * turn.col(2).head<2>() / turn(2, 2);
  const PicturePyramid before = TurnedAroundMiddle(SeenAbove(ground, X_WC0), kCamera, turn);
  const auto shift = ShiftBetween(before, SeenAbove(ground, X_WC1));
  ASSERT_TRUE(shift);
  EXPECT_NEAR(shift->x(), expected.x(), 0.15 + 0.02 * expected.norm());
  EXPECT_NEAR(shift->y(), expected.y(), 0.15 + 0.02 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Table, Turns,
                         testing::Values(Turn{"None", {}}, Turn{"PitchALittle", {0, Rad(0.05), 0}},
                                         Turn{"Pitch", {0, Rad(0.5), 0}},
                                         Turn{"PitchMuch", {0, Rad(-1.5), 0}},
                                         Turn{"Yaw", {0, 0, Rad(1)}}, Turn{"Roll", {Rad(1), 0, 0}},
                                         Turn{"All", {Rad(0.4), Rad(0.6), Rad(-0.7)}}),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(PictureShift, IsUnknownWithoutTextureAndBetweenDifferentScenes) {
  GroundWorld ground(3), elsewhere(4);
  const PicturePyramid seen = Seen(ground, CameraAt({}));
  EXPECT_FALSE(ShiftBetween(seen, MakePyramid(ImageU8(640, 480, 0))));
  EXPECT_FALSE(ShiftBetween(MakePyramid(ImageU8(640, 480, 90)), seen));
  EXPECT_FALSE(ShiftBetween(seen, Seen(elsewhere, CameraAt({}))));
  EXPECT_FALSE(ShiftBetween(seen, MakePyramid(ImageU8(320, 240, 90))));
  EXPECT_FALSE(ShiftBetween(MakePyramid(ImageU8(16, 16)), MakePyramid(ImageU8(16, 16))));
}

}  // namespace
}  // namespace palace
