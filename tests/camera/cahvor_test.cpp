// CAHV and CAHVOR against vectors of JPL's own library, and the alignment of a pair.
#include "engine/camera/cahvor.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/core/random.h"

namespace palace {
namespace {

using nlohmann::json;

std::filesystem::path VectorFile(const char* name) {
  return std::filesystem::path(PALACE_SHARED_DATA_DIR) / "cahvor_vectors" / name;
}

Eigen::Vector3d Vector(const json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

CahvorModel ModelFrom(const json& entry) {
  CahvorModel model;
  model.width = entry.at("image_size").at(0).get<int>();
  model.height = entry.at("image_size").at(1).get<int>();
  model.C = Vector(entry.at("C"));
  model.A = Vector(entry.at("A"));
  model.H = Vector(entry.at("H"));
  model.V = Vector(entry.at("V"));
  model.O = entry.contains("O") ? Vector(entry.at("O")) : model.A;
  model.R = entry.contains("R") ? Vector(entry.at("R")) : Eigen::Vector3d::Zero();
  return model;
}

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

TEST(CahvorVectors, ProjectionAndRaysAgreeWithTheReference) {
  std::ifstream file(VectorFile("camera_models.json"));
  if (!file) {
    GTEST_SKIP() << "no " << VectorFile("camera_models.json");
  }
  int points = 0;
  int rays = 0;
  const json vectors = json::parse(file);
  for (const json& entry : vectors.at("models")) {
    const std::string type = entry.at("type");
    if (type != "CAHV" && type != "CAHVOR") {
      continue;
    }
    SCOPED_TRACE(entry.at("id").get<std::string>());
    const CahvorModel model = ModelFrom(entry);
    for (const json& row : entry.at("project")) {
      const auto pixel = ProjectCahvor(model, Vector(row.at("P")));
      ASSERT_TRUE(pixel.has_value()) << row;
      EXPECT_NEAR(pixel->x(), row.at("px").at(0).get<double>(), 1e-9);
      EXPECT_NEAR(pixel->y(), row.at("px").at(1).get<double>(), 1e-9);
      ++points;
    }
    for (const json& row : entry.at("backproject")) {
      const auto ray = RayFromPixelCahvor(
          model, {row.at("px").at(0).get<double>(), row.at("px").at(1).get<double>()});
      ASSERT_TRUE(ray.has_value()) << row;
      EXPECT_LT((ray->direction - Vector(row.at("ray"))).norm(), 1e-12);
      EXPECT_LT((ray->origin - Vector(row.at("origin"))).norm(), 1e-12);
      ++rays;
    }
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
  }
  EXPECT_GE(points, 40);
  EXPECT_GE(rays, 40);
}

TEST(CahvorVectors, AlignmentIsNearTheReference) {
  std::ifstream file(VectorFile("stereo_alignment.json"));
  std::ifstream models_file(VectorFile("camera_models.json"));
  if (!file || !models_file) {
    GTEST_SKIP() << "no " << VectorFile("stereo_alignment.json");
  }
  const json vectors = json::parse(file);
  const auto model = [&](const char* id) { return ModelFrom(vectors.at("models").at(id)); };
  const auto pair = AlignPair(model("cahvor_640_landing_left"), model("cahvor_640_landing_right"));
  ASSERT_TRUE(pair.has_value());
  // JPL takes the axis from the linearised models, we from A itself: 0.002 degrees apart, and so
  // are the extents.
  const CahvInternals internals = InternalsOf(pair->left);
  EXPECT_NEAR(internals.hs_px, 752.3818, 0.2);
  EXPECT_NEAR(internals.hc_px, 322.1251, 0.2);
  EXPECT_NEAR(internals.vs_px, 769.8522, 0.2);
  EXPECT_NEAR(internals.vc_px, 251.2258, 0.2);
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

TEST(Cahvor, AlignedRowsAreEqualAndDisparityIsFocalBaselineOverDepth) {
  const CahvorModel left = Example();
  CahvorModel right = Example();
  right.C = {0.05, 0.528, -0.02};  // a fore-aft offset, where projecting the baseline first fails
  right.A = Eigen::Vector3d(0.704, -0.011, 0.7101).normalized();
  const auto pair = AlignPair(left, right);
  ASSERT_TRUE(pair.has_value());
  const double hs = InternalsOf(pair->left).hs_px;
  const double baseline = (right.C - left.C).norm();
  constexpr std::uint64_t kSeed = 10;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(random.Uniform(10, 20), random.Uniform(-4, 4), random.Uniform(10, 20));
    const auto a = ProjectCahvor(pair->left, p);
    const auto b = ProjectCahvor(pair->right, p);
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->y(), b->y(), 1e-9);
    EXPECT_NEAR(a->x() - b->x(), hs * baseline / (p - left.C).dot(pair->left.A), 1e-9);
  }
}

TEST(Cahvor, NoAlignmentAlongTheBaseline) {
  const CahvorModel left = Example();
  CahvorModel right = left;
  EXPECT_FALSE(AlignPair(left, right)) << "no baseline";
  right.C = left.C + left.A;
  EXPECT_FALSE(AlignPair(left, right)) << "cameras one behind the other";
}

}  // namespace
}  // namespace palace
