#include "engine/camera/rectification.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "engine/camera/cahvor.h"
#include "engine/camera/pinhole.h"
#include "engine/core/random.h"

namespace palace {
namespace {

StereoRig PlainRig() {
  StereoRig rig;
  rig.left.pinhole = PinholeFromFov(160, 120, 0.8);
  rig.right.pinhole = rig.left.pinhole;
  return rig;
}

StereoFrame NoiseFrame(int width, int height) {
  RandomStream random(3);
  StereoFrame frame;
  frame.left = ImageU8(width, height);
  frame.right = ImageU8(width, height);
  for (ImageU8* image : {&frame.left, &frame.right}) {
    for (auto& pixel : image->pixels()) {
      pixel = static_cast<std::uint8_t>(random.Index(256));
    }
  }
  return frame;
}

/// A smooth pattern over directions: what any camera sees depends on the ray only.
double Pattern(const Eigen::Vector3d& ray) {
  return 128 + 50 * std::sin(14 * ray.x() / ray.z()) + 50 * std::cos(11 * ray.y() / ray.z());
}

TEST(Rectification, RectifiedRigsPassThrough) {
  const auto rectifier = StereoRectifier::Make(PlainRig());
  ASSERT_TRUE(rectifier.ok());
  const StereoFrame frame = NoiseFrame(160, 120);
  const auto pair = rectifier->Rectify(frame);
  ASSERT_TRUE(pair.ok());
  EXPECT_EQ(pair->left->pixels(), frame.left.pixels());
  EXPECT_EQ(pair->right->pixels(), frame.right.pixels());
  EXPECT_EQ(rectifier->R_C_Rect(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(rectifier->camera(), PlainRig().left.pinhole);
  EXPECT_EQ(rectifier->baseline_m(), 1.0);
}

TEST(Rectification, WrongSizesAreNamed) {
  const auto rectifier = StereoRectifier::Make(PlainRig());
  ASSERT_TRUE(rectifier.ok());
  const auto pair = rectifier->Rectify(NoiseFrame(80, 60));
  ASSERT_FALSE(pair.ok());
  EXPECT_NE(pair.error().message.find("80 x 60"), std::string::npos) << pair.error().message;
  EXPECT_NE(pair.error().message.find("160 x 120"), std::string::npos) << pair.error().message;
}

TEST(Rectification, ImpossibleRigsAreRefused) {
  StereoRig rig = PlainRig();
  rig.baseline_m = 0;
  EXPECT_FALSE(StereoRectifier::Make(rig).ok());
  rig = PlainRig();
  rig.right.pinhole.fx_px = -1;
  EXPECT_FALSE(StereoRectifier::Make(rig).ok());
  rig = PlainRig();
  rig.left.cahvor = CahvorModel{};
  EXPECT_FALSE(StereoRectifier::Make(rig).ok());
}

TEST(Rectification, PlumbBobIsUndone) {
  StereoRig rig = PlainRig();
  rig.rectified = false;
  rig.left.distortion = {-0.25, 0.06, 0.001, -0.002, 0};
  rig.right.distortion = {-0.20, 0.03, 0, 0, 0};
  const auto rectifier = StereoRectifier::Make(rig);
  ASSERT_TRUE(rectifier.ok());
  // Draw the raw left picture: solve the distortion for every raw pixel by fixed-point iteration.
  StereoFrame frame = NoiseFrame(160, 120);
  const auto& k = rig.left.distortion;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const Eigen::Vector3d raw =
          RayFromPixel(rig.left.pinhole, {static_cast<double>(x), static_cast<double>(y)});
      Eigen::Vector2d u = raw.head<2>();
      for (int i = 0; i < 30; ++i) {
        const double r2 = u.squaredNorm();
        const double radial = 1 + r2 * (k[0] + r2 * k[1]);
        const Eigen::Vector2d tangential(
            2 * k[2] * u.x() * u.y() + k[3] * (r2 + 2 * u.x() * u.x()),
            k[2] * (r2 + 2 * u.y() * u.y()) + 2 * k[3] * u.x() * u.y());
        u = (raw.head<2>() - tangential) / radial;
      }
      frame.left.at(x, y) = static_cast<std::uint8_t>(std::lround(Pattern({u.x(), u.y(), 1})));
    }
  }
  const auto pair = rectifier->Rectify(frame);
  ASSERT_TRUE(pair.ok());
  for (int y = 10; y < 110; ++y) {
    for (int x = 10; x < 150; ++x) {
      const double truth = Pattern(
          RayFromPixel(rectifier->camera(), {static_cast<double>(x), static_cast<double>(y)}));
      ASSERT_NEAR(pair->left->at(x, y), truth, 2.5) << x << ',' << y;
    }
  }
}

TEST(Rectification, CahvorPairIsAligned) {
  StereoRig rig;
  rig.rectified = false;
  CahvorModel left = CahvFromPinhole(PinholeFromFov(160, 120, 0.8),
                                     RotationFromEuler({0.01, 0.02, -0.01}), {0, 0, 0});
  left.R = {0.0004, -0.15, 0.05};
  CahvorModel right = CahvFromPinhole(PinholeFromFov(160, 120, 0.82),
                                      RotationFromEuler({-0.015, 0.01, 0.02}), {1.02, 0.01, 0.03});
  right.R = {0.0002, -0.12, 0.04};
  rig.left.cahvor = left;
  rig.right.cahvor = right;
  const auto rectifier = StereoRectifier::Make(rig);
  ASSERT_TRUE(rectifier.ok()) << rectifier.error().message;
  EXPECT_NEAR(rectifier->baseline_m(), (right.C - left.C).norm(), 1e-12);
  // A pattern at infinity: after alignment both cameras see the same picture.
  StereoFrame frame = NoiseFrame(160, 120);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const Eigen::Vector2d pixel(x, y);
      frame.left.at(x, y) = static_cast<std::uint8_t>(
          std::lround(Pattern(RayFromPixelCahvor(left, pixel)->direction)));
      frame.right.at(x, y) = static_cast<std::uint8_t>(
          std::lround(Pattern(RayFromPixelCahvor(right, pixel)->direction)));
    }
  }
  const auto pair = rectifier->Rectify(frame);
  ASSERT_TRUE(pair.ok());
  const Eigen::Matrix3d R_FC = PinholeFromCahv(left).R_CF.transpose();
  for (int y = 4; y < 116; ++y) {
    for (int x = 4; x < 156; ++x) {
      const Eigen::Vector3d ray_Rect =
          RayFromPixel(rectifier->camera(), {static_cast<double>(x), static_cast<double>(y)});
      const double truth = Pattern(R_FC * (rectifier->R_C_Rect() * ray_Rect));
      ASSERT_NEAR(pair->left->at(x, y), truth, 2.5) << x << ',' << y;
      ASSERT_NEAR(pair->right->at(x, y), truth, 2.5) << x << ',' << y;
    }
  }
}

}  // namespace
}  // namespace palace
