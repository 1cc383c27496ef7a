// The glide slope keeps the site at the image centre and ends where the vehicle settles.
#include "engine/flight/glide_slope.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"

namespace palace {
namespace {

TEST(GlideSlope, SiteStaysAtTheImageCentre) {
  RandomStream random(4);
  for (int trial = 0; trial < 200; ++trial) {
    GlideSlope slope;
    slope.p_WS = {random.Uniform(-20, 20), random.Uniform(-20, 20), random.Uniform(-2, 2)};
    slope.heading_rad = random.Uniform(-3, 3);
    slope.slope_rad = random.Uniform(Rad(25), Rad(90));
    slope.p_BC = {0.8, -0.5, 0.3};
    const double height = random.Uniform(kSettleHeight_m, 20);
    const RigidTransform X_WB{slope.LevelRotation(), slope.BodyAt(height)};
    const RigidTransform X_BC{CameraRotationFromTilt(-slope.slope_rad), slope.p_BC};
    const Eigen::Vector3d p_CS = (X_WB * X_BC).Inverse() * slope.p_WS;
    EXPECT_GT(p_CS.z(), 0);
    EXPECT_NEAR(p_CS.x() / p_CS.z(), 0, 1e-9) << "trial " << trial;
    EXPECT_NEAR(p_CS.y() / p_CS.z(), 0, 1e-9) << "trial " << trial;
    EXPECT_NEAR(slope.SkidHeight(X_WB.p), height, 1e-9);
    EXPECT_NEAR(slope.Deviation(X_WB.p), 0, 1e-9);
    EXPECT_NEAR(slope.Deviation(X_WB.p + slope.LevelRotation().col(1) * 0.7), 0.7, 1e-9);
  }
}

TEST(GlideSlope, AboveSiteMeansSkidsAboveSite) {
  GlideSlope slope;
  slope.p_WS = {3, 4, -1};
  slope.heading_rad = 1.1;
  slope.slope_rad = Rad(45);
  const RigidTransform X_WB{slope.LevelRotation(), slope.BodyAboveSite(2)};
  EXPECT_TRUE((X_WB * SkidCentreBody()).isApprox(Eigen::Vector3d(3, 4, -3), 1e-12));
}

}  // namespace
}  // namespace palace
