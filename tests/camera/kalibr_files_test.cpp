// EuRoC's sensor.yaml and Kalibr's camchain.yaml: the lens and the place that they tell, and what
// of them is refused. That they survive damage and cuts: the tests of all camera files.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "engine/camera/files/camera_files.h"
#include "engine/camera/files/rig_file.h"
#include "engine/camera/rectification.h"
#include "engine/core/random.h"
#include "tests/camera/camera_file_texts.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

CameraModel Read(const std::string& text, std::optional<StereoSide> side = {}) {
  const auto model = ParseCameraText(text, "f.yaml", {side, {}});
  EXPECT_TRUE(model.ok()) << model.error().message;
  return model.ok() ? *model : CameraModel{};
}

std::string Refusal(const std::string& text, std::optional<StereoSide> side = {}) {
  const auto model = ParseCameraText(text, "f.yaml", {side, {}});
  return model.ok() ? "" : model.error().message;
}

TEST(EurocSensor, TellsLensSizeAndPlaceInTheBody) {
  const CameraModel camera = Read(kEurocText);
  const auto& model = std::get<OpenCvModel>(camera.lens);
  EXPECT_EQ(model.pinhole, (PinholeCamera{752, 480, 458.654, 457.296, 367.215, 248.375}));
  EXPECT_EQ(model.lens, OpenCvLens::kPolynomial);
  EXPECT_EQ(model.coefficients, 4);
  EXPECT_EQ(model.k[3], 1.76187114e-05);
  EXPECT_TRUE(camera.pose_is_known);
  EXPECT_LT(
      (CentreOf(camera) - Vector3d(-0.0216401454975, -0.064676986768, 0.00981073058949)).norm(),
      1e-12)
      << "the last column of T_BS";
  EXPECT_LT((RotationOf(camera).transpose() * Vector3d::UnitZ() -
             Vector3d(0.00414029679422, 0.025715529948, 0.999660727178))
                .norm(),
            1e-9)
      << "the axis is the third column of T_BS";
}

TEST(KalibrChain, TellsBothCamerasInTheFrameOfTheFirst) {
  const CameraModel left = Read(kKalibrText, StereoSide::kLeft);
  EXPECT_FALSE(left.pose_is_known);
  EXPECT_EQ(std::get<OpenCvModel>(left.lens).pinhole.fx_px, 461.6);
  const CameraModel right = Read(kKalibrText, StereoSide::kRight);
  const auto& model = std::get<OpenCvModel>(right.lens);
  EXPECT_EQ(model.lens, OpenCvLens::kFisheye);
  EXPECT_EQ(model.k[2], -0.022) << "a list of items";
  EXPECT_EQ(model.t_CF, Vector3d(-0.11, 0.0004, -0.0008)) << "rows that go on in the next line";
  EXPECT_TRUE(right.pose_is_known);
  EXPECT_NEAR(CentreOf(right).x(), 0.11, 1e-4) << "cam1 stands to the right";
}

/// As the formats define their lenses: Brown's radial and tangential terms, Kannala and Brandt's
/// odd polynomial of the angle.
TEST(KalibrLenses, ProjectAsTheirDefinitionSays) {
  constexpr std::uint64_t kSeed = 14;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  const CameraModel radtan = Read(kEurocText);
  const CameraModel fisheye = Read(kKalibrText, StereoSide::kRight);
  for (int i = 0; i < 200; ++i) {
    const double x = 1.2 * random.Uniform() - 0.6, y = 0.8 * random.Uniform() - 0.4;
    const double r2 = x * x + y * y;
    {
      const double radial = 1 - 0.28340811 * r2 + 0.07395907 * r2 * r2;
      const double p1 = 0.00019359, p2 = 1.76187114e-05;
      const Vector2d pixel(
          458.654 * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + 367.215,
          457.296 * (y * radial + 2 * p2 * x * y + p1 * (r2 + 2 * y * y)) + 248.375);
      const auto& m = std::get<OpenCvModel>(radtan.lens);
      const Vector3d p_B = m.R_CF.transpose() * (3 * Vector3d(x, y, 1) - m.t_CF);
      EXPECT_LT((ProjectCamera(radtan, p_B).value() - pixel).norm(), 1e-9);
    }
    {
      const double theta = std::atan(std::sqrt(r2)), t2 = theta * theta;
      const double bent =
          theta * (1 + t2 * (-0.013 + t2 * (0.021 + t2 * (-0.022 + t2 * 0.0092)))) / std::sqrt(r2);
      const Vector2d pixel(460.2 * bent * x + 378.5, 458.6 * bent * y + 254.9);
      const auto& m = std::get<OpenCvModel>(fisheye.lens);
      const Vector3d p_C0 = m.R_CF.transpose() * (3 * Vector3d(x, y, 1) - m.t_CF);
      EXPECT_LT((ProjectCamera(fisheye, p_C0).value() - pixel).norm(), 1e-9);
    }
  }
}

TEST(KalibrLenses, NoneIsAPinhole) {
  const std::string none = Replaced(
      Replaced(kEurocText, "radial-tangential", "none"),
      "distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]\n", "");
  EXPECT_EQ(std::get<OpenCvModel>(Read(none).lens).coefficients, 0);
  const std::string empty = none + "distortion_coefficients: []\n";
  EXPECT_EQ(std::get<OpenCvModel>(Read(empty).lens).coefficients, 0);
  EXPECT_EQ(FamilyOf(Read(empty)), "pinhole");
}

class RigOfForeignFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = OwnPath();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  StereoRig Rig(const std::string& left, const std::string& right) {
    std::ofstream(folder_ / "rig.toml")
        << "[left]\nmodel_file = \"" << left << "\"\n[right]\nmodel_file = \"" << right
        << "\"\n[rig]\n[mount]\ntilt_deg = -90\n[images]\nleft = \"l*\"\nright = \"r*\"\n"
           "rate_hz = 20\n";
    const auto file = LoadRigFile(folder_ / "rig.toml");
    EXPECT_TRUE(file.ok()) << file.error().message;
    return file.ok() ? file->rig : StereoRig{};
  }
  void Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  std::filesystem::path folder_;
};

TEST_F(RigOfForeignFiles, TwoSensorFilesAreAPair) {
  Write("cam0.yaml", kEurocText);
  std::string right = Replaced(kEurocText, "-0.0216401454975", "-0.0198435579556");
  right = Replaced(Replaced(right, "-0.064676986768", "0.0453689425024"), "0.00981073058949",
                   "0.00786212447038");
  Write("cam1.yaml", right);
  const StereoRig rig = Rig("cam0.yaml", "cam1.yaml");
  EXPECT_NEAR(rig.baseline_m, 0.1100780, 1e-6) << "the distance of the two last columns";
  EXPECT_FALSE(rig.rectified);
  EXPECT_EQ(rig.left.pinhole.width, 752);
  EXPECT_EQ(rig.rate_hz, 20);
  EXPECT_TRUE(StereoRectifier::Make(rig).ok());
}

TEST_F(RigOfForeignFiles, OneChainIsAPair) {
  Write("camchain.yaml", kKalibrText);
  const StereoRig rig = Rig("camchain.yaml", "camchain.yaml");
  EXPECT_NEAR(rig.baseline_m, 0.110003636, 1e-8) << "the length of the last column";
  const auto rectifier = StereoRectifier::Make(rig);
  ASSERT_TRUE(rectifier.ok()) << rectifier.error().message;
  EXPECT_NEAR(rectifier->baseline_m(), rig.baseline_m, 1e-12);
}

struct WrongYaml {
  const char* what;
  const std::string& text;
  const char* replace;
  const char* with;
  const char* message;
};

TEST(KalibrFiles, WhatIsWrongIsNamedWithLineKeyAndLimit) {
  constexpr const char* kRead = "PALACE reads pinhole with radtan";
  const WrongYaml rows[] = {
      {"the IMU's file", kEurocText, "sensor_type: camera", "sensor_type: imu",
       "f.yaml:2: sensor_type = imu: no camera"},
      {"omni", kEurocText, "camera_model: pinhole", "camera_model: omni", kRead},
      {"line of omni", kEurocText, "camera_model: pinhole", "camera_model: omni",
       "f.yaml:14: camera_model = omni"},
      {"double sphere", kKalibrText, "camera_model: pinhole\n  distortion_coeffs:\n",
       "camera_model: ds\n  distortion_coeffs:\n", "cam1.camera_model = ds: PALACE reads"},
      {"fov", kKalibrText, "distortion_model: equidistant", "distortion_model: fov", kRead},
      {"no lens", kEurocText, "camera_model: pinhole\n", "", "camera_model is missing"},
      {"no distortion", kEurocText, "distortion_model: radial-tangential\n", "",
       "distortion_model is missing"},
      {"no intrinsics", kKalibrText, "  intrinsics: [460.2, 458.6, 378.5, 254.9]\n", "",
       "cam1.intrinsics is missing"},
      {"intrinsics of omni", kEurocText, "intrinsics: [", "intrinsics: [1.3, ",
       "f.yaml:15: intrinsics = [1.3, 458.654, 457.296, 367.215, 248.375]: more than 4 numbers"},
      {"focal 0", kEurocText, "[458.654", "[0", "fu fv must lie within 0.001 .. 1000000"},
      {"negative focal", kEurocText, "457.296", "-457.296", "fu fv must lie within"},
      {"centre", kEurocText, "367.215", "1e7", "cu cv must lie within -1000000 .. 1000000"},
      {"3 coefficients", kEurocText, ", 1.76187114e-05]", "]", "3 numbers, it must have 4"},
      {"5 coefficients", kKalibrText, "  - 0.0092\n", "  - 0.0092\n  - 0.1\n",
       "f.yaml:19: cam1.distortion_coeffs"},
      {"wild coefficient", kEurocText, "-0.28340811", "-283", "must lie within -100 .. 100"},
      {"infinite coefficient", kEurocText, "-0.28340811", "inf", "not a list of finite numbers"},
      {"an alias", kKalibrText, "[460.2, 458.6, 378.5, 254.9]", "*id001",
       "f.yaml:25: cam1.intrinsics = *id001: not a list"},
      {"size", kEurocText, "[752, 480]", "[752, 0]", "f.yaml:13: resolution = [752, 0]: sides"},
      {"half a size", kEurocText, "[752, 480]", "[752]", "1 numbers, it must have 2"},
      {"rate", kEurocText, "rate_hz: 20", "rate_hz: -20",
       "f.yaml:12: rate_hz = -20: the rate in hertz must lie within 0.001 .. 1000"},
      {"no pose", kEurocText, "T_BS:\n  cols: 4\n  rows: 4\n  data: [", "junk: [", "unknown key"},
      {"pose of 12", kEurocText, ",\n         0.0, 0.0, 0.0, 1.0]", "]",
       "T_BS.data = [0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216...: 12 numbers"},
      {"3 rows", kEurocText, "rows: 4", "rows: 3", "f.yaml:7: T_BS.rows = 3: must be a whole"},
      {"last row", kEurocText, "0.0, 0.0, 0.0, 1.0]", "0.0, 0.0, 0.1, 1.0]",
       "the last row of a 4x4 pose must be 0 0 0 1"},
      {"mirrored", kEurocText, "[0.0148655429818, -0.999880929698, 0.00414029679422",
       "[-0.0148655429818, 0.999880929698, -0.00414029679422", "is no rotation"},
      {"millimetres", kEurocText, "-0.0216401454975", "-216.4",
       "the offset in metres must lie within -100 .. 100"},
      {"misspelt", kKalibrText, "cam_overlaps: [0]", "cam_overlap: [0]",
       "f.yaml:17: cam1.cam_overlap = [0]: unknown key; known are camera_model"},
      {"a term of another lens", kEurocText, "rate_hz: 20", "rate_hz: 20\nxi: 1.2",
       "f.yaml:13: xi = 1.2: unknown key"},
      {"no T_cn_cnm1", kKalibrText, "  T_cn_cnm1:\n", "  T_cam_imu:\n",
       "cam1.T_cn_cnm1 is missing"},
      {"one camera", kKalibrText, "cam1:\n", "cam2:\n", "f.yaml: cam1 is missing; the left camera"},
  };
  for (const WrongYaml& row : rows) {
    SCOPED_TRACE(row.what);
    const std::string refusal =
        Refusal(Replaced(row.text, row.replace, row.with), StereoSide::kRight);
    EXPECT_NE(refusal.find(row.message), std::string::npos) << refusal;
    EXPECT_EQ(refusal.rfind("f.yaml", 0), 0u) << refusal;
  }
  EXPECT_NE(Refusal(kKalibrText).find("holds two cameras (cam0, cam1); choose one with --camera"),
            std::string::npos)
      << Refusal(kKalibrText);
}

TEST(KalibrFiles, HeadersOfOtherWritersChangeNothing) {
  for (const char* header : {"%YAML:1.0\n---\n", "# written by hand\n\n", "\xEF\xBB\xBF"}) {
    EXPECT_EQ(std::get<OpenCvModel>(Read(header + kEurocText).lens).pinhole.fx_px, 458.654);
    EXPECT_EQ(
        std::get<OpenCvModel>(Read(header + kKalibrText, StereoSide::kRight).lens).pinhole.fx_px,
        460.2);
  }
  std::string crlf = kEurocText;
  for (std::size_t at = 0; (at = crlf.find('\n', at)) != std::string::npos; at += 2) {
    crlf.insert(at, "\r");
  }
  EXPECT_EQ(std::get<OpenCvModel>(Read(crlf).lens).k,
            std::get<OpenCvModel>(Read(kEurocText).lens).k);
}

/// Aliases of aliases grow without end where a parser resolves them; ours takes them as words.
TEST(KalibrFiles, BombsAndMegabytesCostNothing) {
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string one = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + one + ", " + one + ", " +
            one + ", " + one + "]\n";
  }
  EXPECT_NE(Refusal(bomb + "cam0:\n  camera_model: pinhole\n  distortion_model: none\n"
                           "  intrinsics: *a29\n  resolution: [752, 480]\n")
                .find("cam0.intrinsics = *a29"),
            std::string::npos);
  constexpr std::size_t kSize = 4 << 20;
  for (const auto& [start, part] :
       {std::pair{"cam0:\n", "  - [1,\n"}, {"cam0:\n", "  a:\n"}, {"T_BS:\n", "  - - 1\n"}}) {
    std::string text = start;
    while (text.size() < kSize) {
      text += part;
    }
    EXPECT_FALSE(ParseCameraText(text, "large").ok()) << part;
  }
}

}  // namespace
}  // namespace palace
