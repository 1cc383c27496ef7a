// Linearised and aligned cameras against vectors of JPL's library, and what alignment promises in
// every geometry: equal rows, disparity = f b / depth, pictures used inside or covered.
#include "engine/camera/alignment.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/camera/cahvor.h"
#include "tests/camera/reference_vectors.h"
#include "tests/camera/sample_cameras.h"

namespace palace {
namespace {

using nlohmann::json;

void ExpectModel(const CahvorModel& model, const json& expected) {
  EXPECT_LT((model.A - Vector3From(expected.at("A"))).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((model.H - Vector3From(expected.at("H"))).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((model.V - Vector3From(expected.at("V"))).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(AlignmentVectors, LinearizedModelsAreThoseOfJpl) {
  const auto vectors = ReadVectors("camera_models.json");
  if (!vectors) {
    GTEST_SKIP() << NoReferenceData("cahvor_vectors");
  }
  int compared = 0;
  for (const json& entry : vectors->at("models")) {
    if (!entry.contains("linearize")) {
      continue;
    }
    SCOPED_TRACE(entry.at("id").get<std::string>());
    for (const json& row : entry.at("linearize")) {
      const auto field =
          row.at("minfov").get<int>() != 0 ? FieldOfView::kInside : FieldOfView::kCovering;
      const auto model = LinearizeCamera(JplModelFrom(entry), field);
      ASSERT_TRUE(model.ok()) << model.error().message;
      ExpectModel(*model, row);
      ++compared;
    }
  }
  EXPECT_GE(compared, 8);
}

TEST(AlignmentVectors, PairsAreThoseOfJpl) {
  const auto vectors = ReadVectors("stereo_alignment.json");
  if (!vectors) {
    GTEST_SKIP() << NoReferenceData("cahvor_vectors");
  }
  const CameraModel left = JplModelFrom(vectors->at("models").at("cahvor_640_landing_left"));
  const CameraModel right = JplModelFrom(vectors->at("models").at("cahvor_640_landing_right"));
  int compared = 0;
  for (const json& entry : vectors->at("stereo_alignment")) {
    SCOPED_TRACE(entry.at("id").get<std::string>());
    const std::string method = entry.at("method");
    AlignmentOptions options;
    if (method.find("cmod_cahv_warp_models") != std::string::npos) {
      options.form = AlignmentForm::kAverage;
    } else if (method.find("warp_models2") == std::string::npos) {
      options.form = AlignmentForm::kColumns;
    }
    if (entry.value("minfov", 1) == 0) {
      options.field = FieldOfView::kCovering;
    }
    const auto pair = AlignPair(left, right, options);
    ASSERT_TRUE(pair.ok()) << pair.error().message;
    ExpectModel(pair->left, entry);
    for (const json& row : entry.at("points")) {
      const Eigen::Vector3d p = Vector3From(row.at("P"));
      const auto a = ProjectCahvor(pair->left, p);
      const auto b = ProjectCahvor(pair->right, p);
      ASSERT_TRUE(a && b);
      EXPECT_LT((*a - Vector2From(row.at("left_px"))).norm(), 1e-9);
      EXPECT_LT((*b - Vector2From(row.at("right_px"))).norm(), 1e-9);
      EXPECT_NEAR(a->y(), b->y(), 1e-12 * 480);
    }
    ++compared;
  }
  EXPECT_GE(compared, 3);
  // The newer form is not in this file; its internals are published to six decimals.
  const auto newer = AlignPair(left, right);
  ASSERT_TRUE(newer.ok());
  const CahvInternals internals = InternalsOf(newer->left);
  EXPECT_NEAR(internals.hs_px, 752.381797, 1e-6);
  EXPECT_NEAR(internals.hc_px, 322.125077, 1e-6);
  EXPECT_NEAR(internals.vs_px, 769.852158, 1e-6);
  EXPECT_NEAR(internals.vc_px, 251.225816, 1e-6);
}

/// The pose of a second camera seen from the first: a turn and a place.
struct PairRow {
  const char* what;
  int family;  ///< of sample_cameras.h
  Eigen::Vector3d place;
  EulerAngles turn;
};

/// A random camera looking along z of F with x to the right, moved to the row's pose.
CameraModel Placed(RandomStream& random, int family, const Eigen::Vector3d& place,
                   const EulerAngles& turn) {
  const CameraModel camera = InUnit(RandomCamera(random, family), 1);
  const Eigen::Matrix3d R_FC = RotationFromEuler(turn);
  const Eigen::Matrix3d R_CF = RotationOf(camera);
  const Eigen::Matrix3d R_NewOld = R_FC * R_CF;
  return MovedCamera(camera, R_NewOld, place - R_NewOld * CentreOf(camera));
}

TEST(Alignment, RowsAreEqualAndDisparityIsFocalBaselineOverDepth) {
  const PairRow rows[] = {
      {"side by side", 1, {1, 0, 0}, {0, 0, 0}},
      {"fore and aft offset", 1, {1, 0.02, 0.1}, {0.01, -0.02, 0.015}},
      {"verging", 1, {1, 0, 0}, {0, -0.2, 0}},
      {"rolled", 1, {1, 0, 0}, {0, 0, 0.15}},
      {"steep against each other", 1, {1, 0, 0}, {0.15, 0, 0}},
      {"right camera left of the left one", 1, {-1, 0.01, 0}, {0.01, 0, 0}},
      {"linear", 0, {0.4, 0, 0}, {0.02, 0.01, 0}},
      {"fisheye", 3, {0.3, 0, 0.01}, {0.02, 0.02, 0.02}},
      {"general CAHVORE", 4, {0.3, 0, 0}, {-0.02, 0, 0}},
      {"Tsai", 6, {0.3, 0, 0}, {0, 0.02, 0.01}},
      {"OpenCV 8", 10, {0.3, 0, 0}, {0.01, 0.02, 0}},
  };
  constexpr std::uint64_t kSeed = 41;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (const PairRow& row : rows) {
    for (const AlignmentForm form :
         {AlignmentForm::kNormals, AlignmentForm::kColumns, AlignmentForm::kAverage}) {
      for (const FieldOfView field : {FieldOfView::kInside, FieldOfView::kCovering}) {
        SCOPED_TRACE(row.what);
        SCOPED_TRACE(static_cast<int>(form));
        const CameraModel left = Placed(random, row.family, {0, 0, 0}, {0, 0, 0});
        CameraModel right = Placed(random, row.family, row.place, row.turn);
        SetSize(right, 700, 500);  // of another size than the left one
        const auto pair = AlignPair(left, right, {form, field, {}});
        ASSERT_TRUE(pair.ok()) << pair.error().message;
        EXPECT_EQ(pair->left.width, 640);
        EXPECT_EQ(pair->right.height, 480);
        const CahvInternals internals = InternalsOf(pair->left);
        EXPECT_NEAR(internals.theta_rad, -std::numbers::pi / 2, 1e-9);
        EXPECT_LT((pair->left.C - CentreOf(left)).norm(), 1e-12);
        EXPECT_LT((pair->right.C - CentreOf(right)).norm(), 1e-12);
        const double side = row.place.x() < 0 ? -1 : 1;
        for (int i = 0; i < 20; ++i) {
          const Eigen::Vector3d p(random.Uniform(-3, 3), random.Uniform(-3, 3),
                                  random.Uniform(8, 20));
          const auto a = ProjectCahvor(pair->left, p);
          const auto b = ProjectCahvor(pair->right, p);
          ASSERT_TRUE(a && b);
          EXPECT_NEAR(a->y(), b->y(), 1e-9);
          const double depth = (p - pair->left.C).dot(pair->left.A);
          EXPECT_NEAR(a->x() - b->x(), side * internals.hs_px * row.place.norm() / depth, 1e-8);
        }
      }
    }
  }
}

TEST(Alignment, ThePictureIsUsedInsideOrCovered) {
  constexpr std::uint64_t kSeed = 42;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (const int family : {0, 1, 2, 8, 10}) {
    for (int i = 0; i < 20; ++i) {
      const CameraModel camera = Placed(random, family, {0, 0, 0}, {0, 0, 0});
      SCOPED_TRACE(FamilyOf(camera));
      const auto inside = LinearizeCamera(camera, FieldOfView::kInside);
      const auto covering = LinearizeCamera(camera, FieldOfView::kCovering);
      ASSERT_TRUE(inside.ok() && covering.ok());
      // Corners of the raw picture fall outside the first and inside the second.
      for (const Eigen::Vector2d& corner :
           {Eigen::Vector2d(0, 0), {639, 0}, {0, 479}, {639, 479}}) {
        const auto ray = RayFromPixelCamera(camera, corner);
        ASSERT_TRUE(ray);
        const Eigen::Vector3d p = inside->C + ray->direction;
        const Eigen::Vector2d in = ProjectCahvor(*inside, p).value();
        const Eigen::Vector2d cover = ProjectCahvor(*covering, p).value();
        constexpr double kSlack = 1e-6;
        EXPECT_FALSE(in.x() > kSlack && in.x() < 639 - kSlack && in.y() > kSlack &&
                     in.y() < 479 - kSlack);
        EXPECT_TRUE(cover.x() > -kSlack && cover.x() < 639 + kSlack && cover.y() > -kSlack &&
                    cover.y() < 479 + kSlack)
            << cover.transpose();
      }
    }
  }
}

TEST(Alignment, WideRaysEndAt75Degrees) {
  CahvoreModel fisheye;
  fisheye.base = CahvFromPinhole({640, 480, 150, 150, 319.5, 239.5}, Eigen::Matrix3d::Identity(),
                                 Eigen::Vector3d::Zero());  // 122 degrees to each side
  const auto linear = LinearizeCamera({fisheye}, FieldOfView::kCovering);
  ASSERT_TRUE(linear.ok()) << linear.error().message;
  EXPECT_NEAR(InternalsOf(*linear).hs_px, 639 / (2 * std::tan(75 * std::numbers::pi / 180)), 1e-9);
}

TEST(Alignment, ImpossiblePairsAreRefusedWithTheReason) {
  constexpr std::uint64_t kSeed = 43;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  const auto refusal = [](const CameraModel& left, const CameraModel& right) {
    const auto pair = AlignPair(left, right);
    return pair.ok() ? std::string() : pair.error().message;
  };
  const CameraModel left = Placed(random, 1, {0, 0, 0}, {0, 0, 0});
  EXPECT_NE(refusal(left, left).find("one place"), std::string::npos);
  EXPECT_NE(refusal(left, MovedCamera(left, Eigen::Matrix3d::Identity(), LinearPartOf(left).A))
                .find("along their baseline"),
            std::string::npos);
  EXPECT_NE(refusal(left, Placed(random, 1, {1, 0, 0}, {0, 1.5, 0})).find("overlap"),
            std::string::npos);
  CameraModel no_size = left;
  SetSize(no_size, 0, 0);
  EXPECT_NE(refusal(no_size, left).find("Dimensions"), std::string::npos);
  EXPECT_TRUE(AlignPair(no_size, Placed(random, 1, {1, 0, 0}, {0, 0, 0}),
                        {AlignmentForm::kAverage, FieldOfView::kInside, {}})
                  .ok())
      << "mean scale and centre need no picture";
  OpenCvModel folded;
  folded.pinhole = {640, 480, 300, 300, 320, 240};
  folded.coefficients = 4;
  folded.k = {-0.4, 0, 0, 0};
  folded.t_CF = {3, 0, 0};
  EXPECT_NE(refusal({folded}, left).find("left camera: the border pixel (0"), std::string::npos)
      << refusal({folded}, left);
  const CameraModel behind = Placed(random, 1, {1, 0, 0}, {0, std::numbers::pi, 0});
  EXPECT_NE(refusal(left, behind).find("axes are 180.0 degrees apart, the limit is 150"),
            std::string::npos)
      << refusal(left, behind);
}

}  // namespace
}  // namespace palace
