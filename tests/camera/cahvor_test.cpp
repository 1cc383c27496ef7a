// CAHV and CAHVOR: hidden pinhole, limits, scale and shift. Vectors of every family:
// camera_model_test.cpp.
#include "engine/camera/cahvor.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/frames.h"
#include "engine/core/random.h"
#include "tests/camera/reference_vectors.h"

namespace palace {
namespace {

using nlohmann::json;

CahvorModel Example() {
  CahvorModel model;
  model.width = 640;
  model.height = 480;
  model.C = {0, -0.528, 0};
  model.A = Eigen::Vector3d(0.7071, 0.004, 0.7071).normalized();
  model.H = {225.6, 770, 228};
  model.V = {-372, 9, 718};
  model.O = Eigen::Vector3d(0.7085, 0.0075, 0.7057).normalized();
  model.R = {0.0004, -0.21, 0.09};
  return model;
}

TEST(CahvorVectors, InternalsAndPinholeAgreeWithTheReference) {
  const auto vectors = ReadVectors("camera_models.json");
  if (!vectors) {
    GTEST_SKIP() << NoReferenceData("cahvor_vectors");
  }
  for (const json& entry : vectors->at("models")) {
    SCOPED_TRACE(entry.at("id").get<std::string>());
    const CahvorModel model = CahvorFrom(entry);
    const CahvInternals internals = InternalsOf(model);
    EXPECT_NEAR(internals.hs_px, entry.at("internal").at("hs").get<double>(), 1e-9);
    EXPECT_NEAR(internals.hc_px, entry.at("internal").at("hc").get<double>(), 1e-9);
    EXPECT_NEAR(internals.vs_px, entry.at("internal").at("vs").get<double>(), 1e-9);
    EXPECT_NEAR(internals.vc_px, entry.at("internal").at("vc").get<double>(), 1e-9);
    EXPECT_NEAR(internals.theta_rad, entry.at("internal").at("theta").get<double>(), 1e-9);
    const CahvPinhole pinhole = PinholeFromCahv(model);
    const json& K = entry.at("pinhole").at("K");
    EXPECT_NEAR(pinhole.camera.fx_px, K.at(0).at(0).get<double>(), 1e-9);
    EXPECT_NEAR(pinhole.camera.fy_px, K.at(1).at(1).get<double>(), 1e-9);
    EXPECT_NEAR(pinhole.shear_px, K.at(1).at(0).get<double>(), 1e-9);
    for (int row = 0; row < 3; ++row) {
      const Eigen::Vector3d expected = Vector3From(
          entry.at("pinhole").at("R_cam_from_world_rows").at(static_cast<std::size_t>(row)));
      EXPECT_LT((pinhole.R_CF.row(row).transpose() - expected).norm(), 1e-12);
    }
  }
}

TEST(Cahvor, ScaleAndShiftMoveThePixels) {
  const CahvorModel model = Example();
  const Eigen::Vector3d p = model.C + Eigen::Vector3d(10, 1, 11);
  const Eigen::Vector2d pixel = ProjectCahvor(model, p).value();
  const CahvorModel scaled = ScaleCahvor(model, 0.5, 0.25);
  EXPECT_EQ(scaled.width, 320);
  EXPECT_EQ(scaled.height, 120);
  EXPECT_LT(
      (ProjectCahvor(scaled, p).value() - pixel.cwiseProduct(Eigen::Vector2d(0.5, 0.25))).norm(),
      1e-10);
  const CahvorModel shifted = ShiftCahvor(model, 100, -7);
  EXPECT_LT((ProjectCahvor(shifted, p).value() - (pixel - Eigen::Vector2d(100, -7))).norm(), 1e-10);
  // Averaging 2 x 2 pixels: x' = (x + 0.5) / 2 - 0.5.
  const CahvorModel binned = ShiftCahvor(ScaleCahvor(model, 0.5, 0.5), 0.25, 0.25);
  EXPECT_LT((ProjectCahvor(binned, p).value() - ((pixel.array() + 0.5) / 2 - 0.5).matrix()).norm(),
            1e-10);
}

TEST(Cahvor, RayInvertsProjection) {
  constexpr std::uint64_t kSeed = 9;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  const CahvorModel model = Example();
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d pixel(random.Uniform(0, 639), random.Uniform(0, 479));
    const auto ray = RayFromPixelCahvor(model, pixel);
    ASSERT_TRUE(ray.has_value());
    EXPECT_NEAR(ray->direction.norm(), 1, 1e-14);
    const auto back = ProjectCahvor(model, ray->origin + random.Uniform(0.5, 80) * ray->direction);
    ASSERT_TRUE(back.has_value());
    EXPECT_LT((*back - pixel).norm(), 1e-9);
  }
}

TEST(Cahvor, NothingBehindTheCameraOrBeyondTheDistortion) {
  CahvorModel model = Example();
  EXPECT_FALSE(ProjectCahvor(model, model.C - 5 * model.A));
  EXPECT_FALSE(ProjectCahvor(model, {std::nan(""), 0, 0}));
  // r (1 - 0.21 r^2 ...) turns back at large angles: two points would share a pixel.
  model.R = {0, -0.21, 0};
  const Eigen::Vector3d across = model.O.unitOrthogonal();
  EXPECT_TRUE(ProjectCahvor(model, model.C + 10 * model.O + 11 * across));
  EXPECT_FALSE(ProjectCahvor(model, model.C + 10 * model.O + 14 * across));
}

TEST(Cahvor, PinholeRoundTripIsExact) {
  const PinholeCamera camera{640, 480, 770, 765, 322, 241};
  const Eigen::Matrix3d R_CF = RotationFromEuler({0.1, -0.4, 2.0}).transpose();
  const CahvPinhole back = PinholeFromCahv(CahvFromPinhole(camera, R_CF, {1, 2, 3}));
  EXPECT_NEAR(back.camera.fx_px, 770, 1e-9);
  EXPECT_NEAR(back.camera.fy_px, 765, 1e-9);
  EXPECT_NEAR(back.camera.cx_px, 322, 1e-9);
  EXPECT_NEAR(back.camera.cy_px, 241, 1e-9);
  EXPECT_NEAR(back.shear_px, 0, 1e-9);
  EXPECT_LT((back.R_CF - R_CF).norm(), 1e-12);
}

}  // namespace
}  // namespace palace
