// Every lens family against vectors of the reference libraries and figures that were published.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/camera/cahvore.h"
#include "engine/camera/camera_model.h"
#include "engine/camera/opencv_lens.h"
#include "engine/model/camera_numbers.h"
#include "tests/camera/reference_vectors.h"
#include "tests/camera/sample_cameras.h"

namespace palace {
namespace {

using nlohmann::json;
using Matrix23 = Eigen::Matrix<double, 2, 3>;

TEST(CameraVectors, JplModelsProjectAndBackProject) {
  const auto vectors = ReadVectors("camera_models.json");
  if (!vectors) {
    GTEST_SKIP() << NoReferenceData("cahvor_vectors");
  }
  int rows = 0;
  for (const json& entry : vectors->at("models")) {
    SCOPED_TRACE(entry.at("id").get<std::string>());
    const CameraModel model = JplModelFrom(entry);
    for (const json& row : entry.at("project")) {
      const Eigen::Vector3d p = Vector3From(row.at("P"));
      const auto pixel = ProjectCamera(model, p);
      const auto jacobian = JacobianOfCamera(model, p);
      ASSERT_TRUE(pixel && jacobian) << row;
      EXPECT_LT((*pixel - Vector2From(row.at("px"))).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_EQ(*pixel, jacobian->pixel);
      Matrix23 expected;
      expected << Vector3From(row.at("dpx_dP").at(0)).transpose(),
          Vector3From(row.at("dpx_dP").at(1)).transpose();
      EXPECT_LT((jacobian->dpixel_dp - expected).cwiseAbs().maxCoeff(),
                1e-9 * expected.cwiseAbs().maxCoeff())
          << jacobian->dpixel_dp << "\n"
          << expected;
      ++rows;
    }
    for (const json& row : entry.at("backproject")) {
      const auto ray = RayFromPixelCamera(model, Vector2From(row.at("px")));
      ASSERT_TRUE(ray) << row;
      EXPECT_LT((ray->direction - Vector3From(row.at("ray"))).norm(), 1e-12);
      EXPECT_LT((ray->origin - Vector3From(row.at("origin"))).norm(), 1e-12);
      ++rows;
    }
  }
  EXPECT_GE(rows, 90);
}

TEST(CameraVectors, TsaiModelsOfWillson) {
  const auto vectors = ReadVectors("tsai.json");
  if (!vectors) {
    GTEST_SKIP() << NoReferenceData("cahvor_vectors");
  }
  int rows = 0;
  for (const json& entry : vectors->at("models")) {
    SCOPED_TRACE(entry.at("id").get<std::string>());
    const CameraModel model{TsaiFrom(entry), 0.001};
    for (const json& row : entry.at("project")) {
      const auto pixel = ProjectCamera(model, Vector3From(row.at("P_world")));
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - Vector2From(row.at("px_distorted"))).norm(), 1e-9);
    }
    for (const json& row : entry.at("backproject_to_z")) {
      const auto ray = RayFromPixelCamera(model, Vector2From(row.at("px_distorted")));
      ASSERT_TRUE(ray);
      const double along = (row.at("zw").get<double>() - ray->origin.z()) / ray->direction.z();
      const Eigen::Vector3d p = ray->origin + along * ray->direction;
      EXPECT_LT((p - Vector3From(row.at("P_world"))).norm(), 1e-7) << "millimetres";
      ++rows;
    }
  }
  EXPECT_GE(rows, 12);
}

/// Published self-test of mrcal: p, and its pixel to about 1e-8. It scales p to length 1, which
/// counts where the pupil moves.
TEST(CameraModel, AgreesWithFiguresPublishedByMrcal) {
  const Eigen::Vector3d p(-1.1, 0.3, 1.0);
  OpenCvModel opencv;
  opencv.pinhole = {0, 0, 1512, 1112, 500, 333};
  opencv.coefficients = 5;
  opencv.k = {-0.012, 0.035, -0.001, 0.002, 0.019};
  const auto pixel = ProjectCamera({opencv}, p);
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), -1292.8121176, 1e-6);
  EXPECT_NEAR(pixel->y(), 691.9401448, 1e-6);
  CahvoreModel cahvore;
  cahvore.base = CahvFromPinhole({0, 0, 4842.918, 4842.771, 1970.528, 1085.302},
                                 Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  const double alpha = -0.001, beta = 0.002;
  cahvore.base.O = {std::sin(alpha) * std::cos(beta), std::sin(beta),
                    std::cos(alpha) * std::cos(beta)};
  cahvore.base.R = {-0.637, -0.002, 0.016};
  cahvore.E = {1e-2, 2e-2, 3e-2};
  const auto wide = ProjectCamera({cahvore}, p.normalized());
  ASSERT_TRUE(wide);
  EXPECT_NEAR(wide->x(), 489.05797783, 1e-6);
  EXPECT_NEAR(wide->y(), 1495.37110356, 1e-6);
}

}  // namespace
}  // namespace palace
