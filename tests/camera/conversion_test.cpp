// Conversions between lens families: exact where the form allows, refitted with an honest residual
// elsewhere, refused where the rays do not fit.
#include "engine/camera/conversion.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "engine/camera/cahvor.h"
#include "engine/camera/conversion_fit.h"
#include "engine/camera/conversion_targets.h"
#include "engine/camera/files/camera_files.h"
#include "tests/camera/reference_vectors.h"
#include "tests/camera/sample_cameras.h"

namespace palace {
namespace {

constexpr LensFamily kAll[] = {LensFamily::kCahv,    LensFamily::kCahvor,  LensFamily::kCahvore,
                               LensFamily::kTsai,    LensFamily::kPinhole, LensFamily::kOpenCv4,
                               LensFamily::kOpenCv5, LensFamily::kOpenCv8, LensFamily::kOpenCv12,
                               LensFamily::kFisheye};

/// The residual found by hand: random pixels, not the converter's grid.
double WorstOf(const CameraModel& from, const CameraModel& to, RandomStream& random) {
  double worst = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d pixel(random.Uniform(0, WidthOf(from) - 1),
                                random.Uniform(0, HeightOf(from) - 1));
    const auto ray = RayFromPixelCamera(from, pixel);
    if (ray) {
      const auto seen = ProjectDirection(to, ray->direction);
      EXPECT_TRUE(seen);
      worst = std::max(worst, seen ? (*seen - pixel).norm() : 0);
    }
  }
  return worst;
}

TEST(Conversion, NamesAreReadBack) {
  for (const LensFamily family : kAll) {
    EXPECT_EQ(LensFamilyFromName(LensFamilyName(family)), family);
  }
  EXPECT_FALSE(LensFamilyFromName("cahvoree"));
}

TEST(Conversion, PinholesFitEveryFamilyExactly) {
  RandomStream random(61);
  CahvorModel perpendicular = CahvFromPinhole({640, 480, 700, 710, 322, 239},
                                              RandomRotation(random), RandomVector(random, 4));
  for (const LensFamily family : kAll) {
    SCOPED_TRACE(LensFamilyName(family));
    const auto converted = ConvertCamera({perpendicular}, family);
    ASSERT_TRUE(converted.ok()) << converted.error().message;
    // A fisheye must imitate the tangent by a polynomial of theta.
    EXPECT_LT(converted->residual.max_px, family == LensFamily::kFisheye ? 1e-3 : 1e-9);
    EXPECT_NEAR(converted->lost_shear_px, 0, 1e-9);
    EXPECT_LT((CentreOf(converted->model) - perpendicular.C).norm(), 1e-9);
    const auto back = ConvertCamera(converted->model, LensFamily::kCahvor);
    ASSERT_TRUE(back.ok());
    EXPECT_LT(WorstOf({perpendicular}, back->model, random), 0.01);
  }
}

TEST(Conversion, TheLostShearIsTheResidual) {
  CahvorModel oblique = CahvFromPinhole({640, 480, 700, 700, 319.5, 239.5},
                                        Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  oblique.V += Eigen::Vector3d(7, 0, 0);  // K(1,0) = 7 px
  const auto pinhole = ConvertCamera({oblique}, LensFamily::kPinhole);
  ASSERT_TRUE(pinhole.ok());
  EXPECT_NEAR(pinhole->lost_shear_px, 7, 1e-12);
  EXPECT_NEAR(pinhole->residual.max_px, 7 * 319.5 / 700, 1e-9);
  const auto cahvore = ConvertCamera({oblique}, LensFamily::kCahvore);
  ASSERT_TRUE(cahvore.ok());
  EXPECT_LT(cahvore->residual.max_px, 1e-9);
  EXPECT_EQ(cahvore->lost_shear_px, 0);
}

/// Takes the row shear away, which most families cannot hold.
void MakePerpendicular(CameraModel& camera) {
  CahvorModel* base = std::get_if<CahvorModel>(&camera.lens);
  if (auto* cahvore = std::get_if<CahvoreModel>(&camera.lens)) {
    base = &cahvore->base;
  }
  if (base != nullptr) {
    const CahvPinhole pinhole = PinholeFromCahv(*base);
    base->V -= pinhole.shear_px * pinhole.R_CF.row(0).transpose();
  }
}

struct FitRow {
  const char* what;
  int source;  ///< family of sample_cameras.h
  LensFamily target;
  double worst_px;
};

TEST(Conversion, RefitsComeWithinAFractionOfAPixel) {
  const FitRow rows[] = {
      {"CAHVOR to OpenCV 5", 1, LensFamily::kOpenCv5, 0.5},
      {"CAHVOR to OpenCV 8", 1, LensFamily::kOpenCv8, 0.1},
      {"OpenCV 5 to CAHVOR", 9, LensFamily::kCahvor, 1.0},
      {"OpenCV 5 to CAHVORE", 9, LensFamily::kCahvore, 1.0},
      {"OpenCV 5 to OpenCV 8", 9, LensFamily::kOpenCv8, 1e-9},
      {"OpenCV 8 to OpenCV 5", 10, LensFamily::kOpenCv5, 0.2},
      {"Tsai to CAHVOR", 6, LensFamily::kCahvor, 0.05},
      {"Tsai to OpenCV 5", 6, LensFamily::kOpenCv5, 0.05},
      {"fisheye to CAHVORE", 13, LensFamily::kCahvore, 3.0},
      // An axis O beside A tilts the image plane; the fisheye cannot.
      {"CAHVORE fisheye to fisheye", 3, LensFamily::kFisheye, 6.0},
      {"CAHVORE perspective to CAHVOR", 2, LensFamily::kCahvor, 1e-8},
  };
  constexpr std::uint64_t kSeed = 62;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (const FitRow& row : rows) {
    for (int i = 0; i < 3; ++i) {
      SCOPED_TRACE(row.what);
      CameraModel source = RandomCamera(random, row.source);
      MakePerpendicular(source);
      const auto converted = ConvertCamera(source, row.target);
      ASSERT_TRUE(converted.ok()) << converted.error().message;
      EXPECT_LE(converted->residual.max_px, row.worst_px);
      EXPECT_LE(converted->residual.rms_px, converted->residual.max_px);
      EXPECT_EQ(converted->residual.unseen, 0);
      // The stated residual holds at pixels the converter never looked at.
      const double worst = WorstOf(InUnit(source, 1), converted->model, random);
      EXPECT_LE(worst, 1.05 * converted->residual.max_px + 1e-9);
    }
  }
}

/// 1024 x 768, a fisheye by the angle: 179 degrees from corner to corner at 400 px.
CameraModel WideCamera(double focal_px) {
  CahvoreModel wide;
  wide.base = CahvFromPinhole({1024, 768, focal_px, focal_px, 511.5, 383.5},
                              Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  wide.base.R = {0, 0.01, 0};
  wide.linearity = 0;
  return {wide};
}

/// The residual when a lost ray counts as one a picture's diagonal off.
double WorthOf(const ConvertedCamera& converted) {
  const Residual& r = converted.residual;
  const double diagonal_px = std::hypot(WidthOf(converted.model), HeightOf(converted.model));
  return std::sqrt((1 - r.UnseenShare()) * r.rms_px * r.rms_px +
                   r.UnseenShare() * diagonal_px * diagonal_px);
}

TEST(Conversion, AFamilyThatContainsAnotherNeverFitsWorse) {
  constexpr std::uint64_t kSeed = 64;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  const std::vector<LensFamily> chains[] = {
      {LensFamily::kPinhole, LensFamily::kOpenCv4, LensFamily::kOpenCv5, LensFamily::kOpenCv8,
       LensFamily::kOpenCv12},
      {LensFamily::kPinhole, LensFamily::kCahvor, LensFamily::kCahvore},
      {LensFamily::kPinhole, LensFamily::kTsai},
  };
  std::vector<CameraModel> sources = {WideCamera(random.Uniform(400, 600))};
  for (const int family : {1, 6, 13}) {
    sources.push_back(RandomCamera(random, family));
    MakePerpendicular(sources.back());
  }
  for (const CameraModel& source : sources) {
    SCOPED_TRACE(FamilyOf(source));
    for (const auto& chain : chains) {
      double smaller_px = std::numeric_limits<double>::infinity();
      for (const LensFamily family : chain) {
        const auto converted = ConvertCamera(source, family);
        ASSERT_TRUE(converted.ok()) << converted.error().message;
        const double worth_px = WorthOf(*converted);
        EXPECT_LE(worth_px, 1.01 * smaller_px + 1e-3) << LensFamilyName(family);
        smaller_px = worth_px;
      }
    }
  }
}

TEST(Conversion, WideLensesLeaveTheStartOfTheFit) {
  // The start alone: 1611 px. Pinhole: 333 px.
  const auto brown = ConvertCamera(WideCamera(400), LensFamily::kOpenCv4);
  ASSERT_TRUE(brown.ok());
  EXPECT_LT(brown->residual.rms_px, 200);
  EXPECT_LT(brown->residual.UnseenShare(), 0.03);
  const auto rational = ConvertCamera(WideCamera(450), LensFamily::kOpenCv8);  // 159 degrees
  ASSERT_TRUE(rational.ok());
  EXPECT_LT(rational->residual.max_px, 0.2);
  EXPECT_EQ(rational->residual.unseen, 0);
}

TEST(Conversion, FitsEndWhereNoParameterHelps) {
  constexpr std::uint64_t kSeed = 65;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (int i = 0; i < 5; ++i) {
    CameraModel source = RandomCamera(random, 1);
    MakePerpendicular(source);
    std::vector<RaySample> samples;
    for (int k = 0; k < 300; ++k) {
      const Eigen::Vector2d pixel(random.Uniform(0, 639), random.Uniform(0, 479));
      if (const auto ray = RayFromPixelCamera(source, pixel)) {
        samples.push_back({pixel, ray->direction});
      }
    }
    for (const LensFamily family :
         {LensFamily::kPinhole, LensFamily::kOpenCv4, LensFamily::kOpenCv5, LensFamily::kTsai}) {
      SCOPED_TRACE(LensFamilyName(family));
      const ConversionTarget target = ConversionTargets(source, family, 0.6).front();
      const auto fit = FitTarget(samples, samples, target, target.start);
      ASSERT_TRUE(fit);
      EXPECT_LT(GradientCosine(samples, target, fit->x), 0.01);
      EXPECT_GT(GradientCosine(samples, target, target.start), 0.1);
    }
  }
}

TEST(Conversion, PrismTermsDoNotTurnTheCameraForALittleShear) {
  constexpr std::uint64_t kSeed = 66;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (int i = 0; i < 3; ++i) {
    CameraModel source{RandomCahvor(random)};
    MakePerpendicular(source);
    auto& cahvor = std::get<CahvorModel>(source.lens);
    cahvor.V += PinholeFromCahv(cahvor).R_CF.row(0).transpose();  // K(1,0) = 1 px
    const auto converted = ConvertCamera(source, LensFamily::kOpenCv12);
    ASSERT_TRUE(converted.ok());
    const double cosine = RotationOf(source).row(2).dot(RotationOf(converted->model).row(2));
    EXPECT_GT(cosine, std::cos(0.01)) << "the axis turns";
    const PinholeCamera before = PinholeFromCahv(cahvor).camera;
    const PinholeCamera after = std::get<OpenCvModel>(converted->model.lens).pinhole;
    EXPECT_NEAR(after.cx_px, before.cx_px, 7);
    EXPECT_NEAR(after.cy_px, before.cy_px, 7);
    EXPECT_LT(converted->residual.rms_px, 0.25);
  }
}

TEST(Conversion, MetresAndMillimetresMeet) {
  RandomStream random(63);
  const TsaiModel tsai = RandomTsai(random);  // millimetres
  const auto cahvor = ConvertCamera({tsai, 0.001}, LensFamily::kCahvor);
  ASSERT_TRUE(cahvor.ok());
  EXPECT_LT((CentreOf(cahvor->model) - CentreOf({tsai}) * 0.001).norm(), 1e-12);
  const auto back = ConvertCamera(cahvor->model, LensFamily::kTsai);
  ASSERT_TRUE(back.ok());
  const auto file =
      ParseCameraText(CameraToText(back->model, CameraFormat::kWillson).value(), "b.cpcc");
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->unit_m, 0.001);
  EXPECT_LT((CentreOf(*file) - CentreOf({tsai})).norm(), 1e-9) << "millimetres";
}

TEST(Conversion, WhatDoesNotFitIsRefusedWithTheReason) {
  CahvoreModel fisheye;
  fisheye.base = CahvFromPinhole({640, 480, 150, 150, 319.5, 239.5}, Eigen::Matrix3d::Identity(),
                                 Eigen::Vector3d::Zero());
  const auto narrow = ConvertCamera({fisheye}, LensFamily::kOpenCv5);
  ASSERT_FALSE(narrow.ok());
  EXPECT_NE(narrow.error().message.find("beyond the range of opencv5"), std::string::npos);
  EXPECT_NE(narrow.error().message.find("153 degrees"), std::string::npos)
      << narrow.error().message;
  CameraModel no_size{fisheye};
  SetSize(no_size, 0, 0);
  const auto sizeless = ConvertCamera(no_size, LensFamily::kFisheye);
  ASSERT_FALSE(sizeless.ok());
  EXPECT_NE(sizeless.error().message.find("--size"), std::string::npos);
  OpenCvModel folded;
  folded.pinhole = {640, 480, 100, 100, 320, 240};
  folded.coefficients = 4;
  folded.k = {-0.3, 0, 0, 0};
  EXPECT_FALSE(ConvertCamera({folded}, LensFamily::kCahvor).ok());
}

TEST(Conversion, MovingPupilsAreNamed) {
  CahvoreModel model;
  model.base = CahvFromPinhole({640, 480, 300, 300, 319.5, 239.5}, Eigen::Matrix3d::Identity(),
                               Eigen::Vector3d::Zero());
  model.E = {0.01, 0, 0};
  const auto converted = ConvertCamera({model}, LensFamily::kFisheye);
  ASSERT_TRUE(converted.ok());
  const double theta = std::hypot(319.5, 239.5) / 300;
  EXPECT_NEAR(converted->lost_pupil_m, 0.01 * (theta / std::sin(theta) - 1), 1e-12);
}

}  // namespace
}  // namespace palace
