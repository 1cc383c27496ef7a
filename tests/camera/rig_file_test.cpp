#include "engine/camera/files/rig_file.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "engine/camera/files/camera_files.h"
#include "engine/camera/rectification.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "tests/camera/camera_file_texts.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

const std::string kGood = R"([left]
width = 640
height = 480
fx_px = 772.5
fy_px = 772.5
cx_px = 319.5
cy_px = 239.5
[right]
width = 640
height = 480
fx_px = 772.5
fy_px = 772.5
cx_px = 319.5
cy_px = 239.5
[rig]
baseline_m = 1.0
rectified = true
min_disparity_px = 8
num_disparities = 96
[mount]
position_body_m = [1, 0, 0.2]
tilt_deg = -45
[pose]
roll_deg = 2
pitch_deg = -3
heading_deg = 90
height_m = 15.24
[images]
left = "l*.png"
right = "r*.png"
rate_hz = 5
[capture]
left = "/dev/video0"
right = "rtsp://camera/1"
width = 640
height = 480
rate_hz = 25
pair_tolerance_ms = 12
fourcc = "MJPG"
loop = true
)";

class RigFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = OwnPath();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void Write(const char* name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  Result<RigFile> Load(const std::string& text) {
    Write("rig.toml", text);
    return LoadRigFile(folder_ / "rig.toml");
  }
  static std::string Replaced(const std::string& from, const std::string& to) {
    std::string text = kGood;
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
  }

  std::filesystem::path folder_;
};

TEST_F(RigFileTest, ReadsEveryKey) {
  const auto file = Load(kGood);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->rig.left.pinhole, (PinholeCamera{640, 480, 772.5, 772.5, 319.5, 239.5}));
  EXPECT_EQ(file->rig.baseline_m, 1.0);
  EXPECT_TRUE(file->rig.rectified);
  EXPECT_EQ(file->rig.min_disparity_px, 8);
  EXPECT_EQ(file->rig.num_disparities, 96);
  EXPECT_NEAR(file->rig.tilt_rad, Rad(-45), 1e-15);
  EXPECT_EQ(file->rig.position_body_m, Eigen::Vector3d(1, 0, 0.2));
  EXPECT_EQ(file->rig.rate_hz, 5);
  EXPECT_EQ(file->left_pattern, "l*.png");
  ASSERT_TRUE(file->capture.has_value());
  EXPECT_EQ(file->capture->left, "/dev/video0");
  EXPECT_EQ(file->capture->right, "rtsp://camera/1");
  EXPECT_EQ(file->capture->width, 640);
  EXPECT_EQ(file->capture->height, 480);
  EXPECT_EQ(file->capture->rate_hz, 25);
  EXPECT_EQ(file->capture->pair_tolerance_s, 0.012);
  EXPECT_EQ(file->capture->fourcc, "MJPG");
  EXPECT_TRUE(file->capture->loop);
  EXPECT_EQ(file->folder, folder_);
  ASSERT_TRUE(file->pose.has_value());
  EXPECT_EQ(file->pose->X_WB.p, Eigen::Vector3d(0, 0, -15.24));
  const EulerAngles attitude = EulerFromRotation(file->pose->X_WB.R);
  EXPECT_NEAR(Deg(attitude.roll_rad), 2, 1e-12);
  EXPECT_NEAR(Deg(attitude.pitch_rad), -3, 1e-12);
  EXPECT_NEAR(Deg(attitude.yaw_rad), 90, 1e-12);
}

struct WrongRow {
  const char* what;
  const char* from;
  const char* to;
  const char* message;
};

TEST_F(RigFileTest, ErrorsNameFileLineKeyAndLimit) {
  const WrongRow rows[] = {
      {"size", "width = 640", "width = 0", "rig.toml:2: left.width = 0 is outside 32 .. 8192"},
      {"fraction", "width = 640", "width = 640.5", "must be a whole number"},
      {"missing", "cy_px = 239.5\n[right]", "[right]", "left.cy_px is missing"},
      {"unknown key", "fx_px = 772.5", "fx_px = 772.5\nfz_px = 1",
       "rig.toml:5: unknown key left.fz_px"},
      {"unknown table", "[mount]", "[extra]\na = 1\n[mount]", "unknown key extra"},
      {"baseline", "baseline_m = 1.0", "baseline_m = -1", "rig.toml:16: rig.baseline_m = -1"},
      {"not a number", "baseline_m = 1.0", "baseline_m = nan", "rig.baseline_m = nan is outside"},
      {"not 16", "num_disparities = 96", "num_disparities = 90", "multiple of 16"},
      {"beyond picture", "min_disparity_px = 8", "min_disparity_px = 700",
       "less than the picture's"},
      {"tilt up", "tilt_deg = -45", "tilt_deg = 45",
       "rig.toml:22: mount.tilt_deg = 45 is outside -90 .. 0"},
      {"two numbers", "[1, 0, 0.2]", "[1, 0]", "list of 3 numbers"},
      {"no tilt", "tilt_deg = -45", "", "mount.tilt_deg is missing"},
      {"height", "height_m = 15.24", "height_m = 0", "pose.height_m = 0"},
      {"half a pose", "roll_deg = 2\n", "", "pose.roll_deg is missing"},
      {"no text", "left = \"l*.png\"", "left = 3", "images.left must be a text"},
      {"rate", "rate_hz = 5", "rate_hz = 0", "images.rate_hz = 0"},
      {"bool", "rectified = true", "rectified = 1", "must be true or false"},
      {"contradiction", "cy_px = 239.5\n[right]",
       "cy_px = 239.5\ndistortion = [0.1,0,0,0]\n[right]", "contradicts"},
      {"differing", "fx_px = 772.5", "fx_px = 700", "[left] and [right] differ"},
      {"capture size", "camera/1\"\nwidth = 640", "camera/1\"\nwidth = 320",
       "capture.width = 320 px, left.width is 640 px; calibrate for"},
      {"capture rate", "rate_hz = 25", "rate_hz = 2500", "capture.rate_hz = 2500 is outside"},
      {"tolerance", "pair_tolerance_ms = 12", "pair_tolerance_ms = 0",
       "capture.pair_tolerance_ms = 0 is outside 0.01"},
      {"fourcc", "\"MJPG\"", "\"MJPEG\"", "capture.fourcc = MJPEG must have four letters"},
      {"one camera twice", "\"rtsp://camera/1\"", "\"/dev/video0\"", "is the left camera too"},
      {"no device", "\"/dev/video0\"", "-1", "capture.left = -1 is outside 0 .. 255"},
      {"both halves and right", "[capture]", "[capture]\nside_by_side = true",
       "capture.right contradicts side_by_side"},
      {"one camera only", "right = \"rtsp://camera/1\"\n", "", "capture.right is missing"},
      {"unknown in capture", "loop = true", "speed = 1", "unknown key capture.speed"},
      {"syntax", "[rig]", "[rig", "rig.toml:15"},
  };
  for (const WrongRow& row : rows) {
    SCOPED_TRACE(row.what);
    const auto file = Load(Replaced(row.from, row.to));
    ASSERT_FALSE(file.ok());
    EXPECT_EQ(file.error().code, ErrorCode::kInvalid);
    EXPECT_NE(file.error().message.find("rig.toml"), std::string::npos);
    EXPECT_NE(file.error().message.find(row.message), std::string::npos) << file.error().message;
  }
}

TEST_F(RigFileTest, OptionalTablesMayBeLeftOut) {
  const auto file = Load(kGood.substr(0, kGood.find("[pose]")));
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_FALSE(file->pose.has_value());
  EXPECT_TRUE(file->left_pattern.empty());
  EXPECT_FALSE(file->capture.has_value());
}

TEST_F(RigFileTest, ADeviceMayBeANumberAndMayGiveBothHalves) {
  const std::string rig = kGood.substr(0, kGood.find("[capture]"));
  const auto two = Load(rig + "[capture]\nleft = 0\nright = \"2\"\n");
  ASSERT_TRUE(two.ok()) << two.error().message;
  EXPECT_EQ(two->capture->left, "0");
  EXPECT_EQ(two->capture->right, "2");
  EXPECT_FALSE(two->capture->rate_hz.has_value());
  const auto one = Load(rig + "[capture]\nleft = 0\nside_by_side = true\nwidth = 1280\n");
  ASSERT_TRUE(one.ok()) << one.error().message;
  EXPECT_TRUE(one->capture->side_by_side);
  EXPECT_TRUE(one->capture->right.empty());
  EXPECT_EQ(one->capture->width, 1280);
}

TEST_F(RigFileTest, DistortionMakesARigUnrectified) {
  std::string text = Replaced("rectified = true\n", "");
  text.replace(text.find("[right]"), 7, "distortion = [-0.2, 0.1, 0, 0, 0.01]\n[right]");
  const auto file = Load(text);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_FALSE(file->rig.rectified);
  EXPECT_EQ(file->rig.left.distortion[4], 0.01);
}

TEST_F(RigFileTest, ModelFilesDecide) {
  CahvorModel model;
  model.width = 640;
  model.height = 480;
  model.H = {770, 0, 320};
  model.V = {0, 770, 240};
  Write("left.cahvor", CahvorToText(model));
  model.C = {1.5, 0, 0};
  Write("right.cahvor", CahvorToText(model));
  const std::string cameras =
      "[left]\nmodel_file = \"left.cahvor\"\n[right]\nmodel_file = \"right.cahvor\"\n";
  const std::string mount = "[mount]\ntilt_deg = -45\n";
  const auto file = Load(cameras + "[rig]\n" + mount);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->rig.baseline_m, 1.5);
  EXPECT_FALSE(file->rig.rectified);
  EXPECT_NEAR(file->rig.left.pinhole.fx_px, 770, 1e-9);
  ASSERT_TRUE(file->rig.right.model.has_value());
  EXPECT_TRUE(std::holds_alternative<CahvorModel>(file->rig.right.model->lens));
  const auto wrong = Load(cameras + "[rig]\nbaseline_m = 1.0\n" + mount);
  ASSERT_FALSE(wrong.ok());
  EXPECT_NE(wrong.error().message.find("1.5 m apart"), std::string::npos) << wrong.error().message;
  const auto missing = Load("[left]\nmodel_file = \"no.cahvor\"\n" + mount);
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().message.find("no.cahvor"), std::string::npos);
}

TEST_F(RigFileTest, ModelFilesOfEveryFormatMakeARig) {
  struct Row {
    const char* left;
    const char* right;
    const char* more;  ///< keys beside model_file
    const char* rig;   ///< keys of [rig]
    double baseline_m;
    const char* error;  ///< empty: loads
  };
  for (const CameraText& file : GoodCameraTexts()) {
    Write(file.name, file.text);
  }
  std::string left_ros = kRosText;
  left_ros.replace(left_ros.find("-57.6"), 5, "0.000");
  Write("left.yaml", left_ros);
  std::string right_cpcc = kWillsonText;
  right_cpcc.replace(right_cpcc.find("-100.26886446"), 13, "-600.26886446");
  Write("right.cpcc", right_cpcc);
  std::string right_cahvore = kCahvoreText;
  right_cahvore.replace(right_cahvore.find("-0.043367"), 9, "0.456633");
  Write("right.cahvore", right_cahvore);
  std::string no_size = kCahvoreText;
  no_size.replace(no_size.find("Dimensions = 1024 1024\n"), 23, "");
  Write("no_size.cahvore", no_size);
  const Row rows[] = {
      {"a.cahvore", "right.cahvore", "", "", 0.5, ""},
      {"left.yaml", "a.yaml", "", "", 0.12, ""},
      {"a.xml", "a.xml", "", "", 3.300242, ""},
      {"a.yml", "a.yml", "", "baseline_m = 0.25\n", 0.25, ""},
      {"a.cpcc", "right.cpcc", "width = 576\nheight = 384\n", "", 0.5, ""},
      {"no_size.cahvore", "right.cahvore", "width = 1024\nheight = 1024\n", "", 0.5, ""},
      {"a.yml", "a.yml", "", "", 0, "give the baseline in metres (baseline_m in [rig]"},
      {"a.cpcc", "right.cpcc", "", "", 0, "add width and height here"},
      {"no_size.cahvore", "right.cahvore", "", "", 0, "rig.toml:2: left.model_file"},
      {"a.cahvor", "a.yml", "", "baseline_m = 1\n", 0, "a.yml: tells no pose"},
      {"a.cahvore", "right.cahvore", "width = 640\nheight = 480\n", "", 0, "1024 x 1024"},
      {"a.xml", "a.xml", "", "baseline_m = 4\n", 0, "3.30024"},
      {"a.cahvore", "right.cahvore", "fx_px = 3\n", "", 0, "left.fx_px contradicts model_file"},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(std::string(row.left) + " " + row.more + row.rig);
    const auto camera = [&](const char* side, const char* model) {
      return "[" + std::string(side) + "]\nmodel_file = \"" + model + "\"\n" + row.more;
    };
    const auto file = Load(camera("left", row.left) + camera("right", row.right) + "[rig]\n" +
                           row.rig + "[mount]\ntilt_deg = -45\n");
    if (*row.error != '\0') {
      ASSERT_FALSE(file.ok());
      EXPECT_NE(file.error().message.find(row.error), std::string::npos) << file.error().message;
      continue;
    }
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_NEAR(file->rig.baseline_m, row.baseline_m, 1e-6);
    EXPECT_FALSE(file->rig.rectified);
    ASSERT_TRUE(file->rig.left.model && file->rig.right.model);
    EXPECT_EQ(file->rig.left.model->unit_m, 1) << "metres";
    EXPECT_GT(file->rig.left.pinhole.fx_px, 0);
    const auto rectifier = StereoRectifier::Make(file->rig);
    EXPECT_TRUE(rectifier.ok()) << rectifier.error().message;
  }
}

TEST_F(RigFileTest, AnyBytesGiveARigOrAnError) {
  constexpr std::uint64_t kSeed = 5;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string text = kGood;
    for (int k = 0; k < 4; ++k) {
      text[static_cast<std::size_t>(random.Index(static_cast<int>(text.size())))] =
          static_cast<char>(random.Index(256));
    }
    refused += Load(text).ok() ? 0 : 1;
  }
  EXPECT_GT(refused, 200);
}

TEST(RigFileFixture, BrightonPairsLoad) {
  for (const char* name : {"pair_25_26.toml", "pair_33_34.toml"}) {
    const auto file =
        LoadRigFile(std::filesystem::path(PALACE_SOURCE_DIR) / "tests/support/brighton" / name);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ(file->rig.num_disparities, 96);
    EXPECT_TRUE(file->pose.has_value());
  }
}

}  // namespace
}  // namespace palace
