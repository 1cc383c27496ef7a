// Every lens family: Jacobians against differences, round trips, and the limits beyond which a
// model has no answer. Vectors of the reference libraries: camera_vectors_test.cpp.
#include "engine/camera/camera_model.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "engine/camera/cahvore.h"
#include "engine/camera/opencv_lens.h"
#include "engine/model/camera_numbers.h"
#include "tests/camera/sample_cameras.h"

namespace palace {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;

TEST(CameraModel, OpenCvProjectsTheSame) {
  constexpr std::uint64_t kSeed = 31;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  int compared = 0;
  for (const int coefficients : {0, 4, 5, 8, 12, 14, -4}) {
    for (int i = 0; i < 40; ++i) {
      const OpenCvModel model = RandomOpenCv(random, coefficients);
      const Eigen::Vector3d p_C(random.Uniform(-3, 3), random.Uniform(-3, 3), random.Uniform(4, 9));
      const auto pixel = ProjectCamera({model}, model.R_CF.transpose() * (p_C - model.t_CF));
      if (!pixel) {
        continue;  // beyond the fold; OpenCV does not look
      }
      const cv::Matx33d K(model.pinhole.fx_px, 0, model.pinhole.cx_px, 0, model.pinhole.fy_px,
                          model.pinhole.cy_px, 0, 0, 1);
      const std::vector<cv::Point3d> points = {{p_C.x(), p_C.y(), p_C.z()}};
      const std::vector<double> k(model.k.begin(), model.k.begin() + model.coefficients);
      std::vector<cv::Point2d> seen;
      if (coefficients < 0) {
        cv::fisheye::projectPoints(points, seen, cv::Vec3d(), cv::Vec3d(), K, k);
      } else {
        cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), K, k, seen);
      }
      EXPECT_NEAR(pixel->x(), seen[0].x, 1e-8) << coefficients;
      EXPECT_NEAR(pixel->y(), seen[0].y, 1e-8) << coefficients;
      ++compared;
    }
  }
  EXPECT_GT(compared, 200);
}

TEST(CameraModel, RaysInvertProjectionInEveryFamily) {
  constexpr std::uint64_t kSeed = 32;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  int checked = 0;
  for (int family = 0; family < kFamilies; ++family) {
    for (int i = 0; i < 200; ++i) {
      const CameraModel model = RandomCamera(random, family);
      SCOPED_TRACE(FamilyOf(model));
      const Eigen::Vector2d pixel(random.Uniform(0, 639), random.Uniform(0, 479));
      const auto ray = RayFromPixelCamera(model, pixel);
      if (!ray) {
        continue;
      }
      EXPECT_NEAR(ray->direction.norm(), 1, 1e-14);
      const double range = random.Uniform(0.5, 80) / model.unit_m;
      const auto back = ProjectCamera(model, ray->origin + range * ray->direction);
      ASSERT_TRUE(back);
      EXPECT_LT((*back - pixel).norm(), 1e-8);
      const auto far = ProjectDirection(model, ray->direction);
      ASSERT_TRUE(far);
      EXPECT_LT((*far - pixel).norm(), 1e-8);
      ++checked;
    }
  }
  EXPECT_GT(checked, 200 * kFamilies * 9 / 10);
}

TEST(CameraModel, WhereProjectAnswersNoOtherDirectionSharesThePixel) {
  constexpr std::uint64_t kSeed = 39;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  int checked = 0;
  for (int i = 0; i < 800; ++i) {
    const int coefficients[] = {4, 5, 8, 12, 14};
    OpenCvModel model = RandomOpenCv(random, coefficients[i % 5]);
    const double strong = i % 2 == 0 ? 0.02 : 0.003;  // most lenses: under 0.002
    for (const std::size_t sideways : {2, 3, 8, 9, 10, 11}) {
      const bool has = sideways < static_cast<std::size_t>(model.coefficients);
      model.k[sideways] = has ? random.Uniform(-strong, strong) : 0;
    }
    model.t_CF.setZero();
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3d p_C(random.Uniform(-2, 2), random.Uniform(-2, 2), 1);
      const Eigen::Vector3d p = model.R_CF.transpose() * p_C;
      const auto pixel = ProjectOpenCv(model, p);
      if (pixel) {
        const auto ray = RayFromPixelOpenCv(model, *pixel);
        ASSERT_TRUE(ray) << p_C.transpose();
        EXPECT_LT((ray->direction - p.normalized()).norm(), 1e-8) << p_C.transpose();
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 8000);
}

TEST(CameraModel, PointsBeyondAFoldOfTheTangentialTermsHaveNoPixel) {
  OpenCvModel model;
  model.pinhole = {640, 480, 500, 500, 320, 240};
  model.coefficients = 4;
  model.k = {-0.3, 0.0407, 0.003, 0};  // det J <= 0 for y/z from -1.38 to -1.58, over 0 after it
  EXPECT_TRUE(ProjectOpenCv(model, {0, -1.37, 1}));
  EXPECT_FALSE(ProjectOpenCv(model, {0, -1.5, 1}));
  EXPECT_FALSE(ProjectOpenCv(model, {0, -1.6, 1}));
  EXPECT_TRUE(ProjectOpenCv(model, {0, 1.6, 1}));
}

TEST(CameraModel, NothingOnTheAxisBehindAMovingPupil) {
  constexpr std::uint64_t kSeed = 40;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (int i = 0; i < 100; ++i) {
    const CahvoreModel model = RandomCahvore(random, 0.5 * (i % 3) - 0.5);
    for (const double range : {1e-3, 1.0, 30.0, 1e5}) {
      EXPECT_FALSE(ProjectCahvore(model, model.base.C - range * model.base.O)) << range;
    }
  }
}

TEST(CameraModel, JacobiansAreTheDifferencesInEveryFamily) {
  constexpr std::uint64_t kSeed = 33;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  int checked = 0;
  for (int family = 0; family < kFamilies; ++family) {
    for (int i = 0; i < 50; ++i) {
      const CameraModel model = RandomCamera(random, family);
      SCOPED_TRACE(FamilyOf(model));
      const auto ray =
          RayFromPixelCamera(model, {random.Uniform(20, 620), random.Uniform(20, 460)});
      if (!ray) {
        continue;
      }
      const double range = 5 / model.unit_m;
      const Eigen::Vector3d p = ray->origin + range * ray->direction;
      const auto jacobian = JacobianOfCamera(model, p);
      ASSERT_TRUE(jacobian);
      const double h = 1e-4 * range;
      for (int axis = 0; axis < 3; ++axis) {
        const auto at = [&](double steps) {
          return ProjectCamera(model, p + steps * h * Eigen::Vector3d::Unit(axis)).value();
        };
        // Fourth-order central difference.
        const Eigen::Vector2d slope = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
        EXPECT_LT((jacobian->dpixel_dp.col(axis) - slope).norm(),
                  1e-7 * jacobian->dpixel_dp.norm());
      }
      ++checked;
    }
  }
  EXPECT_GT(checked, 50 * kFamilies * 9 / 10);
}

TEST(CameraModel, MovedAndScaledCamerasSeeTheSame) {
  constexpr std::uint64_t kSeed = 34;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (int family = 0; family < kFamilies; ++family) {
    const CameraModel model = RandomCamera(random, family);
    SCOPED_TRACE(FamilyOf(model));
    const Eigen::Matrix3d R_GF = RandomRotation(random);
    const Eigen::Vector3d t_GF = RandomVector(random, 3);
    const CameraModel moved = MovedCamera(model, R_GF, t_GF);
    const CameraModel metric = InUnit(model, 1);
    const auto ray = RayFromPixelCamera(model, {300, 200});
    ASSERT_TRUE(ray);
    const Eigen::Vector3d p = ray->origin + 7 * ray->direction / model.unit_m;
    EXPECT_LT((ProjectCamera(moved, R_GF * p + t_GF).value() - Eigen::Vector2d(300, 200)).norm(),
              1e-8);
    EXPECT_LT((ProjectCamera(metric, p * model.unit_m).value() - Eigen::Vector2d(300, 200)).norm(),
              1e-8);
    EXPECT_EQ(metric.unit_m, 1);
    EXPECT_LT((CentreOf(moved) - (R_GF * CentreOf(model) + t_GF)).norm(), 1e-9 / model.unit_m);
  }
}

TEST(CameraModel, NumbersTellTheModelToTheBit) {
  constexpr std::uint64_t kSeed = 36;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (int family = 0; family < kFamilies; ++family) {
    const CameraModel model = RandomCamera(random, family);
    SCOPED_TRACE(FamilyOf(model));
    const std::vector<double> row = NumbersOf(model);
    const auto again = CameraFromNumbers(row);
    ASSERT_TRUE(again);
    EXPECT_EQ(NumbersOf(*again), row);
    EXPECT_EQ(RayFromPixelCamera(*again, {50, 60})->direction,
              RayFromPixelCamera(model, {50, 60})->direction);
    for (std::size_t size = 0; size < row.size(); ++size) {
      EXPECT_FALSE(CameraFromNumbers({row.begin(), row.begin() + static_cast<long>(size)}));
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::vector<double> damaged = row;
      damaged[i] = NAN;
      EXPECT_FALSE(CameraFromNumbers(damaged)) << i;
    }
    std::vector<double> longer = row;
    longer.push_back(0);
    EXPECT_FALSE(CameraFromNumbers(longer));
  }
  EXPECT_FALSE(CameraFromNumbers({7, 1, 1})) << "no such family";
  EXPECT_FALSE(CameraFromNumbers({0, 1, 1, -3, 480})) << "no such size";
}

CahvoreModel Fisheye() {
  CahvoreModel model;
  model.base = CahvFromPinhole({640, 480, 200, 200, 319.5, 239.5}, Eigen::Matrix3d::Identity(),
                               Eigen::Vector3d::Zero());
  return model;
}

struct LimitRow {
  const char* what;
  CameraModel model;
  Eigen::Vector3d inside;
  Eigen::Vector3d outside;
};

TEST(CameraModel, NothingBeyondTheLimitsOfEachFamily) {
  const CahvorModel cahv = Fisheye().base;
  CahvorModel barrel = cahv;
  barrel.R = {0, -0.21, 0};  // turns back at tan = sqrt(1 / 0.63) = 1.26
  CahvorModel scaled = cahv;
  scaled.R = {-1.5, 0, 0};  // mirrors every ray
  CahvoreModel narrow = Fisheye();
  narrow.linearity = 0.9;  // ends at 100 degrees
  CahvoreModel perspective = Fisheye();
  perspective.linearity = 1;
  TsaiModel tsai;
  tsai.dpx = tsai.dpy = 0.01;
  tsai.f = 8;
  tsai.kappa1 = -0.004;  // Rd ends at 9.13, Ru at 6.09 mm: tan 0.761
  OpenCvModel brown;
  brown.pinhole = {640, 480, 500, 500, 320, 240};
  brown.coefficients = 5;
  brown.k = {-0.3, 0, 0, 0, 0};  // ends at tan = sqrt(1 / 0.9) = 1.054
  OpenCvModel rational = brown;
  rational.coefficients = 8;
  rational.k = {0, 0, 0, 0, 0, -1.0, 0, 0};  // pole at tan = 1
  OpenCvModel fisheye = brown;
  fisheye.lens = OpenCvLens::kFisheye;
  fisheye.coefficients = 4;
  fisheye.k = {-0.2, 0, 0, 0};  // ends at theta = sqrt(1 / 0.6) = 1.291, tan 3.48
  const auto at = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return Eigen::Vector3d(9 * std::sin(angle), 0, 9 * std::cos(angle));
  };
  const LimitRow rows[] = {
      {"CAHV, behind", {cahv}, {1, 1, 1}, {1, 1, -1}},
      {"CAHV, in the focal plane", {cahv}, {1, 1, 0.01}, {1, 1, 0}},
      {"CAHV, not finite", {cahv}, {0, 0, 1}, {NAN, 0, 1}},
      {"CAHV, at the centre", {cahv}, {0, 0, 1}, {0, 0, 0}},
      {"CAHVOR, fold", {barrel}, {1.25, 0, 1}, {1.27, 0, 1}},
      {"CAHVOR, behind", {barrel}, {0.1, 0, 1}, {0.1, 0, -1}},
      {"CAHVOR, mirrored", {barrel}, {0, 0, 1}, {NAN, NAN, NAN}},
      {"CAHVORE fisheye, on the axis behind", {Fisheye()}, at(170), at(180)},
      {"CAHVORE general", {narrow}, at(99), at(101)},
      {"CAHVORE perspective", {perspective}, at(89), at(91)},
      {"CAHVORE, at the centre", {Fisheye()}, {0, 0, 1}, {0, 0, 0}},
      {"Tsai, fold", {tsai}, {0.75, 0, 1}, {0.77, 0, 1}},
      {"Tsai, behind", {tsai}, {0, 0, 1}, {0, 0, -1}},
      {"OpenCV, fold", {brown}, {1.05, 0, 1}, {1.06, 0, 1}},
      {"OpenCV, pole", {rational}, {0.99, 0, 1}, {1.01, 0, 1}},
      {"OpenCV, behind", {brown}, {0, 0, 1}, {0, 0, -1}},
      {"fisheye, fold", {fisheye}, {3.4, 0, 1}, {3.6, 0, 1}},
      {"fisheye, on the axis behind", {fisheye}, {0, 0, 1}, {0, 0, -1}},
  };
  for (const LimitRow& row : rows) {
    SCOPED_TRACE(row.what);
    EXPECT_TRUE(ProjectCamera(row.model, row.inside));
    EXPECT_FALSE(ProjectCamera(row.model, row.outside));
    EXPECT_FALSE(JacobianOfCamera(row.model, row.outside));
  }
  EXPECT_FALSE(ProjectCamera({scaled}, {0.1, 0, 1}));
}

TEST(CameraModel, PixelsThatNoRayReachesHaveNoRay) {
  TsaiModel tsai;
  tsai.dpx = tsai.dpy = 0.01;
  tsai.f = 8;
  tsai.kappa1 = -0.004;
  EXPECT_TRUE(RayFromPixelCamera({tsai}, {910, 0}));
  EXPECT_FALSE(RayFromPixelCamera({tsai}, {915, 0}));
  OpenCvModel brown;
  brown.pinhole = {640, 480, 500, 500, 320, 240};
  brown.coefficients = 5;
  brown.k = {-0.3, 0, 0, 0, 0};  // largest radius 2/3 * 1.054 * 500 = 351 px
  EXPECT_TRUE(RayFromPixelCamera({brown}, {320 + 351, 240}));
  EXPECT_FALSE(RayFromPixelCamera({brown}, {320 + 352, 240}));
  CahvorModel barrel = Fisheye().base;
  barrel.R = {0, -0.21, 0};  // largest radius 2/3 * 1.26 * 200 = 168 px
  EXPECT_TRUE(RayFromPixelCamera({barrel}, {319.5 + 167.9, 239.5}));
  EXPECT_FALSE(RayFromPixelCamera({barrel}, {319.5 + 168.1, 239.5}));
  CahvoreModel fisheye = Fisheye();  // 180 degrees at 200 pi = 628 px
  EXPECT_TRUE(RayFromPixelCamera({fisheye}, {319.5 + 628, 239.5}));
  EXPECT_FALSE(RayFromPixelCamera({fisheye}, {319.5 + 629, 239.5}));
  EXPECT_FALSE(RayFromPixelCamera({fisheye}, {NAN, 0}));
}

}  // namespace
}  // namespace palace
