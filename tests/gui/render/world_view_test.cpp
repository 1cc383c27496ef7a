// The true world from outside: what the camera sees lies where its rays meet the ground, and is
// drawn where it lies.
#include "gui/render/world_view_renderer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/units.h"
#include "engine/world/scene_library.h"
#include "tests/gui/render/gl_fixture.h"

namespace palace {
namespace {

PinholeCamera Camera(double fov_deg) {
  const double f = 320 / std::tan(Rad(fov_deg) / 2);
  return {640, 480, f, f, 319.5, 239.5};
}

RigidTransform At(double height_m, double tilt_deg) {
  return {CameraRotationFromTilt(Rad(tilt_deg)), {0, 0, -height_m}};
}

TEST(ViewFrustum, StraightDownIsARectangleOfTheFieldOfView) {
  const ViewFrustum frustum = CastFrustum(Ground{}, Camera(60), At(10, -90));
  const double half_wide = 10 * std::tan(Rad(30)), half_high = half_wide * 480 / 640;
  for (const Eigen::Vector3d& corner : frustum.corners_W) {
    EXPECT_NEAR(std::abs(corner.y()), half_wide, 1e-6);
    EXPECT_NEAR(std::abs(corner.x()), half_high, 1e-6);
    EXPECT_NEAR(corner.z(), 0, 1e-6);
  }
  EXPECT_EQ(frustum.outline_W.front(), frustum.outline_W.back());
  double area = 0;
  for (const auto& [a, b, c] : frustum.patch_W) {
    area += (b - a).cross(c - a).norm() / 2;
  }
  EXPECT_NEAR(area, 4 * half_wide * half_high, 1e-6);
}

TEST(ViewFrustum, GroundBeyondReachAndSkyAreCutOff) {
  const ViewFrustum frustum = CastFrustum(Ground{}, Camera(60), At(15, -10));
  ASSERT_FALSE(frustum.outline_W.empty());
  double farthest = 0;
  for (const Eigen::Vector3d& p : frustum.outline_W) {
    EXPECT_NEAR(p.z(), 0, 1e-6);
    farthest = std::max(farthest, (p - frustum.apex_W).norm());
  }
  EXPECT_LE(farthest, ViewFrustum::kReach_m);
  EXPECT_GT(farthest, 0.99 * ViewFrustum::kReach_m);
  EXPECT_TRUE(CastFrustum(Ground{}, Camera(20), At(15, 0)).outline_W.empty()) << "horizon only";
}

TEST(ViewFrustum, RisesWithTheGround) {
  Ground ground;
  ground.rise_north = std::tan(Rad(5));
  for (const auto& triangle : CastFrustum(ground, Camera(45), At(15, -45)).patch_W) {
    for (const Eigen::Vector3d& p : triangle) {
      EXPECT_NEAR(-p.z(), ground.Height(p.x(), p.y()), 1e-6);
    }
  }
}

class WorldViewGl : public GlTest {};

/// Where the picture is redder than it is blue.
Eigen::Vector2d MiddleOfRed(const ImageRgba& picture, int& count) {
  Eigen::Vector2d sum(0, 0);
  count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (picture.at(x, y).r > picture.at(x, y).b + 25) {
        sum += Eigen::Vector2d(x, y);
        ++count;
      }
    }
  }
  return sum / std::max(count, 1);
}

TEST_F(WorldViewGl, SeenGroundIsRedWhereItLies) {
  const World world = MakeScene("empty", 1).value();
  auto renderer = WorldViewRenderer::Create(world, nullptr);
  ASSERT_TRUE(renderer.ok()) << renderer.error().message;
  // Straight down from 15 m over a place 6 m north and 4 m east; the eye 60 m above the origin.
  RigidTransform X_WC = At(15, -90);
  X_WC.p += Eigen::Vector3d(6, 4, 0);
  const ViewFrustum frustum = CastFrustum(world.ground, Camera(30), X_WC);
  WorldView view;
  view.eye = {400, 400, 800, 800, 199.5, 199.5};
  view.X_WE = At(60, -90);
  view.frustum = &frustum;
  Framebuffer target;
  ASSERT_TRUE((*renderer)->Render(view, target, 1));
  int count = 0;
  const Eigen::Vector2d middle = MiddleOfRed(target.ReadRgba(), count);
  const double px_per_m = 800.0 / 60;
  EXPECT_NEAR(middle.x(), 199.5 + 4 * px_per_m, 3);
  EXPECT_NEAR(middle.y(), 199.5 - 6 * px_per_m, 3) << "north is up";
  const double wide_m = 2 * 15 * std::tan(Rad(15));
  EXPECT_NEAR(count, wide_m * wide_m * 0.75 * px_per_m * px_per_m, 0.15 * count);

  view.frustum = nullptr;
  ASSERT_TRUE((*renderer)->Render(view, target, 1));
  MiddleOfRed(target.ReadRgba(), count);
  EXPECT_EQ(count, 0) << "the world is grey";
}

}  // namespace
}  // namespace palace
