#include "engine/navigation/monocular_position.h"

#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "tests/support/reference_data.h"

namespace palace {
namespace {

Eigen::Vector3d Vector(const nlohmann::json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

TEST(MonocularPosition, AgreesWithTheReferenceVectors) {
  std::ifstream file(ReferenceData("cahvor_vectors/monocular.json"));
  if (!file) {
    GTEST_SKIP() << NoReferenceData("cahvor_vectors");
  }
  const nlohmann::json data = nlohmann::json::parse(file);
  int count = 0;
  for (const nlohmann::json& c : data.at("cases")) {
    MonocularInput in;
    in.attitude = {Rad(c.at("roll_deg").get<double>()), Rad(c.at("pitch_deg").get<double>()),
                   Rad(c.at("yaw_deg").get<double>())};
    in.tilt_rad = Rad(c.at("tilt_deg_theta_C").get<double>());
    in.focal_x_px = in.focal_y_px = c.at("focal_px").get<double>();
    in.pixel = {c.at("x_img").get<double>(), c.at("y_img").get<double>()};
    in.laser_m = c.at("laser_Z_CC").get<double>();
    in.p_WS = Vector(c.at("site_NED"));
    const auto found = PositionFromPixel(in);
    ASSERT_TRUE(found.ok()) << count;
    const nlohmann::json& expected = c.at("expected");
    EXPECT_NEAR(found->Z_IC_m, expected.at("Z_IC").get<double>(), 1e-9) << count;
    EXPECT_NEAR(found->Z_CF_m, expected.at("Z_CF").get<double>(), 1e-9) << count;
    EXPECT_LT((found->P_CF - Vector(expected.at("P_CF"))).norm(), 1e-9) << count;
    EXPECT_LT((found->P_IF - Vector(expected.at("P_IF_camera_to_feature_NED"))).norm(), 1e-9);
    EXPECT_LT((found->p_WC - Vector(expected.at("camera_NED"))).norm(), 1e-9) << count;
    ++count;
  }
  EXPECT_GE(count, 5);
}

TEST(MonocularPosition, FocalLengthUsesTheTangent) {
  EXPECT_NEAR(FocalFromFieldOfView(640, Rad(45)), 772.5483399593904, 1e-9);
}

// The world the other way round: project a point of flat ground, then ask where the camera was.
TEST(MonocularPosition, ReturnsTheCameraForAnyPose) {
  const std::uint64_t seed = 2004;
  SCOPED_TRACE(seed);
  RandomStream random(seed);
  int tried = 0;
  while (tried < 200) {
    MonocularInput in;
    in.attitude = {Rad(random.Uniform(-28, 28)), Rad(random.Uniform(-28, 28)),
                   Rad(random.Uniform(-180, 180))};
    in.tilt_rad = Rad(random.Uniform(-85, -20));
    in.focal_x_px = 772.5;
    in.focal_y_px = 386.25;
    in.pixel = {random.Uniform(-320, 320), random.Uniform(-120, 120)};
    const Eigen::Vector3d p_WC(random.Uniform(-90, 90), random.Uniform(-90, 90),
                               random.Uniform(-60, -3));
    const Eigen::Matrix3d R_WC =
        RotationFromEuler(in.attitude) * CameraRotationFromTilt(in.tilt_rad);
    const Eigen::Vector3d axis = R_WC.col(2);
    const Eigen::Vector3d ray =
        R_WC * Eigen::Vector3d(in.pixel.x() / 772.5, in.pixel.y() / 386.25, 1);
    if (axis.z() < 0.05 || ray.z() < 0.11) {
      continue;
    }
    in.laser_m = -p_WC.z() / axis.z();
    in.p_WS = p_WC - p_WC.z() / ray.z() * ray;
    const auto found = PositionFromPixel(in);
    ASSERT_TRUE(found.ok()) << tried << found.error().message;
    EXPECT_LT((found->p_WC - p_WC).norm(), 1e-9) << tried;
    const Eigen::Vector3d lever(0.6, -0.5, 0.3);
    const Eigen::Vector3d p_WB = BodyFromCamera(found->p_WC, in.attitude, lever);
    EXPECT_LT((p_WB + RotationFromEuler(in.attitude) * lever - p_WC).norm(), 1e-9);
    ++tried;
  }
}

struct BadInput {
  const char* name;
  void (*spoil)(MonocularInput&);
};

class Refusal : public testing::TestWithParam<BadInput> {};
TEST_P(Refusal, IsAnError) {
  MonocularInput in;
  in.tilt_rad = Rad(-45);
  in.focal_x_px = in.focal_y_px = 772.5;
  in.laser_m = 20;
  ASSERT_TRUE(PositionFromPixel(in).ok());
  GetParam().spoil(in);
  EXPECT_FALSE(PositionFromPixel(in).ok());
}
INSTANTIATE_TEST_SUITE_P(
    Inputs, Refusal,
    testing::Values(
        BadInput{"NoLaser", [](MonocularInput& in) { in.laser_m = NAN; }},
        BadInput{"NegativeLaser", [](MonocularInput& in) { in.laser_m = -3; }},
        BadInput{"AxisAboveHorizon", [](MonocularInput& in) { in.attitude.pitch_rad = Rad(50); }},
        BadInput{"RayNearHorizon", [](MonocularInput& in) { in.pixel.y() = -700; }},
        BadInput{"PixelUnknown", [](MonocularInput& in) { in.pixel.x() = NAN; }},
        BadInput{"AttitudeUnknown", [](MonocularInput& in) { in.attitude.roll_rad = NAN; }},
        BadInput{"NoFocal", [](MonocularInput& in) { in.focal_x_px = 0; }}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace palace
