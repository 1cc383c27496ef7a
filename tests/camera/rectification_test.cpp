#include "engine/camera/rectification.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "engine/camera/cahvor.h"
#include "engine/camera/camera_model.h"
#include "engine/camera/pinhole.h"
#include "engine/camera/tsai.h"
#include "engine/core/frames.h"
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
  // Sizes that ask for more memory than there is, or that no stereo can look at.
  const std::pair<int, int> sizes[] = {
      {30000, 30000}, {60000, 64}, {64, 1}, {8192, 8192}, {16, 64}};
  for (const auto& [width, height] : sizes) {
    rig = PlainRig();
    for (RigCamera* camera : {&rig.left, &rig.right}) {
      camera->pinhole.width = width;
      camera->pinhole.height = height;
      camera->distortion[0] = 0.1;
    }
    EXPECT_FALSE(StereoRectifier::Make(rig).ok()) << width << " x " << height;
  }
  rig = PlainRig();
  rig.left.pinhole.fx_px = rig.right.pinhole.fx_px = 1e-200;
  rig.baseline_m = 1e-200;
  EXPECT_FALSE(StereoRectifier::Make(rig).ok()) << "their product is 0";
  rig = PlainRig();
  rig.left.model = CameraModel{CahvorModel{}};
  EXPECT_FALSE(StereoRectifier::Make(rig).ok());
  rig.left.model = CameraModel{
      CahvFromPinhole(PinholeFromFov(160, 120, 0.8), Eigen::Matrix3d::Identity(), {1, 0, 0})};
  rig.right.model = CameraModel{
      CahvFromPinhole(PinholeFromFov(160, 120, 0.8), Eigen::Matrix3d::Identity(), {0, 0, 0})};
  const auto exchanged = StereoRectifier::Make(rig);
  ASSERT_FALSE(exchanged.ok());
  EXPECT_NE(exchanged.error().message.find("exchange [left] and [right]"), std::string::npos);
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
  rig.left.model = CameraModel{left};
  rig.right.model = CameraModel{right};
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

/// A raw picture of the pattern at infinity through `camera`.
ImageU8 Draw(const CameraModel& camera) {
  ImageU8 image(WidthOf(camera), HeightOf(camera));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const auto ray = RayFromPixelCamera(camera, {static_cast<double>(x), static_cast<double>(y)});
      if (ray && ray->direction.z() > 0) {
        image.at(x, y) = static_cast<std::uint8_t>(std::lround(Pattern(ray->direction)));
      }
    }
  }
  return image;
}

TEST(Rectification, PairsOfEveryLensFamilyAreAligned) {
  const Eigen::Matrix3d R_FC = RotationFromEuler({0.01, -0.02, 0.01});
  const auto base = [&](double x) {
    return CahvFromPinhole(PinholeFromFov(160, 120, 0.9), R_FC.transpose(), {x, 0.01 * x, 0});
  };
  const auto cahvore = [&](double x) {
    CahvoreModel model;
    model.base = base(x);
    model.base.R = {0, 0.01, -0.004};
    model.E = {0.001, 0, 0};
    return CameraModel{model};
  };
  const auto tsai = [&](double x) {
    const CahvPinhole pinhole = PinholeFromCahv(base(x));
    TsaiModel model;
    model.width = 160;
    model.height = 120;
    model.dpx = model.dpy = 1e-5;
    model.f = pinhole.camera.fx_px * 1e-5;
    model.Cx_px = pinhole.camera.cx_px;
    model.Cy_px = pinhole.camera.cy_px;
    model.kappa1 = 1e4;
    SetRotationOfTsai(model, pinhole.R_CF);
    model.T = -(pinhole.R_CF * pinhole.p_FC);
    return CameraModel{model};
  };
  const auto opencv = [&](double x, OpenCvLens lens) {
    const CahvPinhole pinhole = PinholeFromCahv(base(x));
    OpenCvModel model;
    model.pinhole = pinhole.camera;
    model.lens = lens;
    model.coefficients = 4;
    model.k = {-0.1, 0.02, 0.001, 0};
    model.R_CF = pinhole.R_CF;
    model.t_CF = -(pinhole.R_CF * pinhole.p_FC);
    return CameraModel{model};
  };
  const std::pair<CameraModel, CameraModel> pairs[] = {
      {cahvore(0), cahvore(1)},
      {tsai(0), tsai(1)},
      {opencv(0, OpenCvLens::kPolynomial), opencv(1, OpenCvLens::kPolynomial)},
      {opencv(0, OpenCvLens::kFisheye), opencv(1, OpenCvLens::kFisheye)},
      {cahvore(0), opencv(1, OpenCvLens::kPolynomial)},
  };
  for (const auto& [left, right] : pairs) {
    SCOPED_TRACE(FamilyOf(left) + ", " + FamilyOf(right));
    StereoRig rig;
    rig.rectified = false;
    rig.left.model = left;
    rig.right.model = right;
    const auto rectifier = StereoRectifier::Make(rig);
    ASSERT_TRUE(rectifier.ok()) << rectifier.error().message;
    EXPECT_NEAR(rectifier->baseline_m(), (CentreOf(right) - CentreOf(left)).norm(), 1e-12);
    StereoFrame frame;
    frame.left = Draw(left);
    frame.right = Draw(right);
    const auto pair = rectifier->Rectify(frame);
    ASSERT_TRUE(pair.ok());
    const Eigen::Matrix3d R_FRect = RotationOf(left).transpose() * rectifier->R_C_Rect();
    for (int y = 4; y < 116; ++y) {
      for (int x = 4; x < 156; ++x) {
        const double truth =
            Pattern(R_FRect * RayFromPixel(rectifier->camera(),
                                           {static_cast<double>(x), static_cast<double>(y)}));
        ASSERT_NEAR(pair->left->at(x, y), truth, 2.5) << x << ',' << y;
        ASSERT_NEAR(pair->right->at(x, y), truth, 2.5) << x << ',' << y;
      }
    }
  }
}

}  // namespace
}  // namespace palace
