// How far a pose lays a frame aside, told by its picture of textured ground: shifts known exactly.
#include "engine/slad/terrain/sideways_registration.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::CameraPose;
using testing::Flat;
using testing::SeeWorld;

constexpr int kFused = 10;
constexpr double kTaken = 1 - 1.0 / (1 + kFused);
const GridGeometry kMap{100, 100, 0.15, 5, -7.5};

/// Waves of several lengths, so that no shift repeats.
double Grey(double n, double e) {
  return 128 + 30 * std::sin(9 * n + 2 * e) + 25 * std::sin(3 * n - 7 * e) +
         20 * std::sin(17 * e + 5 * n * n / 10);
}

struct Frame {
  RangeMap range;
  ImageU8 left;
};

/// Seen from `X_WC`, believed to be seen from `off_m` aside of it (north, east).
Frame Look(const RigidTransform& X_WC, const Eigen::Vector2d& off_m, double contrast,
           std::uint64_t seed) {
  Frame frame{SeeWorld(Flat(), X_WC, 0.1, seed, 1), ImageU8(640, 480)};
  RandomStream noise(seed, "grey");
  const PinholeCamera& camera = frame.range.camera;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const Eigen::Vector3d ray_W = X_WC.R * Eigen::Vector3d((x - camera.cx_px) / camera.fx_px,
                                                             (y - camera.cy_px) / camera.fy_px, 1);
      const Eigen::Vector3d p_W = X_WC.p - X_WC.p.z() / ray_W.z() * ray_W;
      const double grey = 128 + contrast * (Grey(p_W.x(), p_W.y()) - 128) + 2 * noise.Normal();
      frame.left.at(x, y) = static_cast<std::uint8_t>(std::clamp(grey, 0.0, 255.0));
    }
  }
  frame.range.pose = ViewPose{X_WC};
  frame.range.pose->X_WC.p.head<2>() += off_m;
  return frame;
}

TEST(SidewaysRegistration, TellsTheShiftToTwoCentimetres) {
  const Eigen::Vector2d shifts_m[] = {{0.1, 0}, {-0.07, 0.12}, {0.02, -0.31}, {0, 0}};
  for (const Eigen::Vector2d& off_m : shifts_m) {
    SCOPED_TRACE(off_m.transpose());
    SidewaysRegistration registration;
    const RigidTransform first = CameraPose(12, Rad(50)),
                         second = CameraPose(12.1, Rad(49.5), 0.15);
    const Frame before = Look(first, {0, 0}, 1, 1), now = Look(second, off_m, 1, 2);
    EXPECT_FALSE(registration.Add(before.range, before.left, kMap, kFused).told);
    const auto shift = registration.Add(now.range, now.left, kMap, kFused);
    ASSERT_TRUE(shift.told);
    EXPECT_NEAR(shift.by_m.x(), -kTaken * off_m.x(), 0.02);
    EXPECT_NEAR(shift.by_m.y(), -kTaken * off_m.y(), 0.02);
  }
}

TEST(SidewaysRegistration, SaysNothingWithoutTexture) {
  SidewaysRegistration registration;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Frame frame = Look(CameraPose(12, Rad(50)), {0.1 * double(seed), 0}, 0, seed);
    const auto shift = registration.Add(frame.range, frame.left, kMap, kFused);
    EXPECT_FALSE(shift.told);
    EXPECT_EQ(shift.by_m.norm(), 0);
  }
}

// Navigation that has moved for good is followed, within a few times the frames that are fused.
TEST(SidewaysRegistration, TheMapFollowsNavigation) {
  SidewaysRegistration registration;
  Frame frame = Look(CameraPose(12, Rad(50)), {0, 0}, 1, 1);
  registration.Add(frame.range, frame.left, kMap, kFused);
  frame = Look(CameraPose(12, Rad(50)), {0.2, 0}, 1, 2);
  double first_m = 0, last_m = 0;
  for (int i = 0; i < 60; ++i) {
    last_m = registration.Add(frame.range, frame.left, kMap, kFused).by_m.norm();
    first_m = i == 0 ? last_m : first_m;
  }
  EXPECT_NEAR(first_m, kTaken * 0.2, 0.02);
  EXPECT_LT(last_m, 0.01);
}

TEST(SidewaysRegistration, AMapThatMovesKeepsWhatItKnows) {
  SidewaysRegistration registration;
  const Frame before = Look(CameraPose(12, Rad(50)), {0, 0}, 1, 1),
              now = Look(CameraPose(12, Rad(50)), {0.1, -0.05}, 1, 2);
  registration.Add(before.range, before.left, kMap, kFused);
  GridGeometry moved = kMap;
  moved.north_min_m += 6 * kMap.cell_m;
  moved.east_min_m -= 4 * kMap.cell_m;
  const auto shift = registration.Add(now.range, now.left, moved, kFused);
  ASSERT_TRUE(shift.told);
  EXPECT_NEAR(shift.by_m.x(), -kTaken * 0.1, 0.02);
  EXPECT_NEAR(shift.by_m.y(), kTaken * 0.05, 0.02);
}

}  // namespace
}  // namespace palace
