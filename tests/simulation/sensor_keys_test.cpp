// The keys of a vehicle file that say how its sensors err: each may be left out, each is checked,
// and cameras of any lens come from their files.
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "engine/camera/camera_model.h"
#include "engine/camera/files/camera_files.h"
#include "engine/camera/rectification.h"
#include "engine/core/units.h"
#include "engine/simulation/vehicle_file.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

std::string R50Text() { return std::string(VehicleText(kDefaultVehicle)); }

/// The R-50 with a line put before the one that begins so.
std::string With(const std::string& before, const std::string& line) {
  std::string text = R50Text();
  const std::size_t at = text.find("\n" + before);
  EXPECT_NE(at, std::string::npos) << before;
  return text.insert(at + 1, line + "\n");
}

std::string InCamera(const std::string& line) { return With("noise_grey", line); }

/// Every key that r50.toml shows behind a "# ", switched on, but camera files.
std::string EverythingOn() {
  std::string text =
      std::regex_replace(R50Text(), std::regex("\n# (left|right)_model_file[^\n]*"), std::string());
  return std::regex_replace(text, std::regex("\n# (\\w+ = |\\[clock\\])"), "\n$1");
}

TEST(SensorKeys, WhatIsLeftOutIsOff) {
  int left_out = 0;
  for (const SensorValue& value : DefaultVehicle().sensor_values) {
    left_out += value.given ? 0 : 1;
  }
  EXPECT_EQ(left_out, 35);
  const SensorFigures& s = DefaultVehicle().sensors;
  for (const double off :
       {s.camera.exposure_s, s.camera.line_delay_s, s.camera.blur_px, s.camera.vignetting,
        s.camera.full_well_electrons, s.camera.latency_s, s.camera.dropped, s.camera.repeated,
        s.gps.latency_jitter_s, s.gps.drift_horizontal_m, s.gps.dropout, s.imu.gyro_scale,
        s.imu.misalignment_rad, s.imu.vibration_mps2, s.imu.gyro_quantum_rad_s, s.attitude.delay_s,
        s.laser.footprint_rad, s.laser.spike, DefaultVehicle().clock_drift}) {
    EXPECT_EQ(off, 0);
  }
  EXPECT_EQ(s.camera.gain, 1);
  EXPECT_TRUE(std::isinf(s.imu.gyro_limit_rad_s));
}

// The file of the R-50 shows every key that there is, and all of them may be on.
TEST(SensorKeys, TheR50ShowsThemAll) {
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>("shown", EverythingOn()),
        std::pair<std::string, std::string>("corpus", [] {
          std::ifstream file(PALACE_SOURCE_DIR "/tests/fuzz/corpus/vehicle/worn.toml");
          return std::string(std::istreambuf_iterator<char>(file), {});
        }())}) {
    SCOPED_TRACE(name);
    const auto vehicle = ParseVehicle(text, "worn.toml");
    ASSERT_TRUE(vehicle) << vehicle.error().message;
    for (const SensorValue& value : vehicle->sensor_values) {
      EXPECT_TRUE(value.given) << value.name;
    }
    const SensorFigures& s = vehicle->sensors;
    EXPECT_NEAR(s.camera.exposure_s, 0.004, 1e-12);
    EXPECT_NEAR(s.camera.line_delay_s, 20e-6, 1e-12);
    EXPECT_EQ(s.camera.exposure_samples, 4);
    EXPECT_NEAR(s.imu.gyro_scale, 1e-3, 1e-12);
    EXPECT_NEAR(s.imu.misalignment_rad, Rad(0.05), 1e-12);
    EXPECT_NEAR(s.laser.footprint_rad, 2.5e-3, 1e-12);
    EXPECT_NEAR(vehicle->clock_drift, 50e-6, 1e-12);
  }
}

TEST(SensorKeys, MistakesAreNamed) {
  struct Mistake {
    std::string text;
    const char* line;  ///< that is named
    const char* said;
  };
  const Mistake mistakes[] = {
      {InCamera("vignetting = 1.5"), "vignetting = 1.5",
       "camera.vignetting = 1.5 is outside 0 .. 0.95; give the share of light that corners lack"},
      {InCamera("exposure_samples = 2.5"), "exposure_samples = 2.5",
       "camera.exposure_samples = 2.5 "},
      {InCamera("exposure_s = 0.01"), "exposure_s = 0.01",
       "unknown key camera.exposure_s; known here: "},
      {InCamera("line_delay_us = 500"), "line_delay_us = 500",
       "camera.line_delay_us: exposure and readout of 480 rows take 239.5 ms, a pair comes every "
       "100 ms"},
      {InCamera("dropped = 1"), "dropped = 1",
       "camera.dropped = 1 is outside 0 .. 0.95; give a share; what never comes at all is a fault"},
      {InCamera("full_well_electrons = 0"), "full_well_electrons = 0",
       "camera.full_well_electrons = 0 is outside 100 .. 10000000"},
      {With("horizontal_m", "latency_jitter_s = 0.85"), "latency_jitter_s = 0.85",
       "gps.latency_jitter_s = 0.85 and latency_s = 0.1 are more than 0.9 s together"},
      {With("gyro_rad_s_sqrt_hz", "accel_limit_mps2 = 9"), "accel_limit_mps2 = 9",
       "imu.accel_limit_mps2 = 9 is outside 12 .. 1000; give m/s2, more than gravity, or leave it "
       "out"},
      {With("sigma_per_m", "footprint_mrad = -1"), "footprint_mrad = -1",
       "laser.footprint_mrad = -1 is outside 0 .. 100; give milliradians"},
      {R50Text() + "\n[clock]\ndrift_ppm = 5000\n", "drift_ppm = 5000",
       "clock.drift_ppm = 5000 is outside -500 .. 500; give microseconds a second"},
      {R50Text() + "\n[clock]\nstep_s = 1\n", "step_s = 1",
       "unknown key clock.step_s; known here: drift_ppm"},
      {InCamera("left_model_file = \"l.yaml\""), "view_deg",
       "camera.view_deg contradicts left_model_file; give one of them"},
  };
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.said);
    const auto read = ParseVehicle(mistake.text, "mine.toml");
    ASSERT_FALSE(read);
    const std::size_t at = mistake.text.find("\n" + std::string(mistake.line));
    const auto line =
        2 + std::count(mistake.text.begin(), mistake.text.begin() + static_cast<long>(at), '\n');
    const std::string& said = read.error().message;
    EXPECT_TRUE(said.starts_with("mine.toml:" + std::to_string(line) + ": " + mistake.said))
        << line << "\n"
        << said;
  }
}

/// A camera with a radial lens, and one of another family and size.
class SensorKeysOfLenses : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder);
    OpenCvModel left;
    left.pinhole = {640, 480, 560, 565, 318, 243};
    left.coefficients = 4;
    left.k = {-0.28, 0.09, 0.0008, -0.0005};
    OpenCvModel right = left;
    right.pinhole.cx_px = 322;
    Write("left.yaml", {left, 1, false});
    Write("right.yaml", {right, 1, false});
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  void Write(const std::string& name, const CameraModel& model) {
    std::ofstream(folder / name) << CameraToText(model, CameraFormat::kOpenCvYaml).value();
  }
  /// The R-50 with these files, and what else the table then has.
  static std::string Text(const std::string& right, const std::string& more) {
    std::string text =
        InCamera("left_model_file = \"left.yaml\"\nright_model_file = \"" + right + "\"\n" + more);
    for (const char* key : {"width", "height", "view_deg", "baseline_m"}) {
      text = std::regex_replace(text, std::regex("\n" + std::string(key) + " = [^\n]*"),
                                std::string(), std::regex_constants::format_first_only);
    }
    return text;
  }
  Result<VehicleDescription> Load(const std::string& text) const {
    const std::filesystem::path file = folder / "mine.toml";
    std::ofstream(file) << text;
    return LoadVehicle(file.string());
  }

  const std::filesystem::path folder = OwnPath(" with a blank");
};

TEST_F(SensorKeysOfLenses, TheRigGoesOutWithTheirModels) {
  // With a comment as the key is written, so that the pattern of Text() leaves this one alone.
  std::string text = Text("right.yaml", "");
  text.replace(text.find("rate_hz"), 0, "baseline_m = 0.8\n");
  const auto vehicle = Load(text);
  ASSERT_TRUE(vehicle) << vehicle.error().message;
  const StereoRig& rig = vehicle->rig;
  ASSERT_TRUE(rig.left.model && rig.right.model);
  EXPECT_FALSE(rig.rectified);
  EXPECT_NEAR(rig.baseline_m, 0.8, 1e-12);
  EXPECT_EQ(FamilyOf(*rig.left.model), "OpenCV 4");
  const auto rectifier = StereoRectifier::Make(rig);
  ASSERT_TRUE(rectifier) << rectifier.error().message;
  EXPECT_NEAR(rectifier->baseline_m(), 0.8, 1e-12);
}

TEST_F(SensorKeysOfLenses, WhatIsWrongWithThemIsNamed) {
  const auto no_baseline = Load(Text("right.yaml", ""));
  ASSERT_FALSE(no_baseline);
  EXPECT_NE(no_baseline.error().message.find("neither tells a pose"), std::string::npos)
      << no_baseline.error().message;
  const auto missing = Load(Text("none.yaml", ""));
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("none.yaml"), std::string::npos);
  const auto nowhere = ParseVehicle(Text("right.yaml", ""), "text.toml");
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().message.find("this text is no file on disk"), std::string::npos)
      << nowhere.error().message;
}

}  // namespace
}  // namespace palace
