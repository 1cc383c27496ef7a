// Damaged and hostile camera files: one error that names the place, or a model that can be used.
// Files cut short: camera_files_cut_test.cpp.
#include <string>

#include <gtest/gtest.h>

#include "engine/camera/files/camera_files.h"
#include "engine/core/random.h"
#include "tests/camera/camera_file_texts.h"

namespace palace {
namespace {

struct WrongRow {
  const char* what;
  const std::string& text;
  const char* replace;
  const char* with;
  const char* message;
};

TEST(CameraFiles, ErrorsNameFileLineKeyAndLimit) {
  const WrongRow rows[] = {
      {"missing key", kCahvorText, "C = 0 -0.528 0\n", "", "f.cam: C is missing"},
      {"too few", kCahvorText, "H = 225.6 770 228", "H = 225.6 770",
       "f.cam:6: H = 225.6 770: 2 numbers, it must have 3"},
      {"too many", kCahvorText, "H = 225.6 770 228", "H = 225.6 770 1 2", "more than 3 numbers"},
      {"no number", kCahvorText, "V = -372", "V = x372", "f.cam:7: V = x372 9 718: not a list"},
      {"number with a tail", kCahvorText, "V = -372", "V = -372q", "f.cam:7: V"},
      {"infinite", kCahvorText, "V = -372", "V = inf", "f.cam:7: V"},
      {"not a number", kCahvorText, "V = -372", "V = nan", "not a list of finite numbers"},
      {"overflow", kCahvorText, "V = -372", "V = 1e999", "not a list of finite numbers"},
      {"huge", kCahvorText, "V = -372", "V = 1e30", "within -1e12 .. 1e12"},
      {"no width", kCahvorText, "640 480", "0 480", "f.cam:3: Dimensions = 0 480: sides must be"},
      {"half a pixel", kCahvorText, "640 480", "640.5 480", "whole numbers from 1 to 65536"},
      {"non-unit A", kCahvorText, "A = 0.6 0 0.8", "A = 0.6 0 8",
       "f.cam:5: A = 0.6 0 8: has length"},
      {"non-unit O", kCahvorText, "O = 0.6 0 0.8", "O = 0 0 0", "f.cam:8: O = 0 0 0: has length"},
      {"O backwards", kCahvorText, "O = 0.6 0 0.8", "O = -0.6 0 -0.8", "points away from A"},
      {"zero hs", kCahvorText, "H = 225.6 770 228", "H = 6 0 8", "hs = |A x H| would be 0"},
      {"zero vs", kCahvorText, "V = -372 9 718", "V = 0 0 0", "vs = |A x V| would be 0"},
      {"H along V", kCahvorText, "V = -372 9 718", "V = 225.6 770 228", "runs along H"},
      {"mirrored", kCahvorText, "H = 225.6 770 228", "H = 225.6 -770 228",
       "f.cam:6: H = 225.6 -770 228: gives a mirrored model"},
      {"CAHV with distortion", kCahvorText, "Model = CAHVOR", "Model = CAHV",
       ": a CAHV model has no distortion; name the model CAHVOR if it has it"},
      {"CAHVORE mirrored", kCahvoreText, "V = 44.0102 16.904 683.916",
       "V = -44.0102 -16.904 -683.916", "f.cam:5: H = 353.341 474.873 350.82: gives a mirrored"},
      {"label mirrored", kPdsText, "(353.341,474.873,350.82)", "(-353.341,-474.873,-350.82)",
       "MODEL_COMPONENT_3 = (-353.341,-474.873,-350.82): gives a mirrored model"},
      {"other model", kCahvorText, "= CAHVOR =", "= PSPH =", "f.cam:2: Model = PSPH"},
      {"no type", kCahvoreText, "CAHVORE3,0.37", "CAHVORE", "needs its type"},
      {"type 4", kCahvoreText, "CAHVORE3,0.37", "CAHVORE4", "types 1 perspective"},
      {"no linearity", kCahvoreText, "CAHVORE3,0.37", "CAHVORE3", "linearity of the Model line is"},
      {"linearity", kCahvoreText, "CAHVORE3,0.37", "CAHVORE3,99", "within -10 .. 10"},
      {"no E", kCahvoreText, "E = 0.000942 0.00228 0.001613\n", "", "E is missing"},
      {"label without the group", kPdsText, "GROUP = GEOMETRIC_CAMERA_MODEL\n", "GROUP = X\n",
       "MODEL_TYPE is missing"},
      {"label of no model", kPdsText, "MODEL_TYPE = CAHVORE", "MODEL_TYPE = NONE",
       "f.cam:13: GEOMETRIC_CAMERA_MODEL.MODEL_TYPE = NONE"},
      {"label component", kPdsText, "(353.341,474.873,350.82)", "(353.341,474.873)",
       "MODEL_COMPONENT_3 = (353.341,474.873): 2 numbers"},
      {"label unit", kVicarText, "MODEL_COMPONENT_1=",
       "MODEL_COMPONENT_UNIT=('INCH','N/A','PIXEL','PIXEL') MODEL_COMPONENT_1=",
       "MODEL_COMPONENT_UNIT = ('INCH','N/A','PIXEL','PIXEL'): the unit of "
       "GEOMETRIC_CAMERA_MODEL.MODEL_COMPONENT_1 must be METER, CENTIMETER or MILLIMETER"},
      {"label unit of a number", kPdsText, "(0.606185 <m>", "(0.606185 <mm>",
       "f.cam:16: GEOMETRIC_CAMERA_MODEL.MODEL_COMPONENT_1 = (0.606185 <mm>, -0.043367 <m>"},
      {"Willson too short", kWillsonText, "0.035000288833\n0\n0\n", "",
       "number 17 (Rz) is missing"},
      {"a sign too many", kCahvorText, "V = -372", "V = +-372", "not a list of finite numbers"},
      {"given twice", kCahvorText, "V = -372 9 718\n", "V = -372 9 718\nV = -372 9 719\n",
       "f.cam:7: V = -372 9 718: line 8 gives it again with another value; leave one of them"},
      {"Willson with a line missing", kWillsonText, "69.974574039\n", "",
       "18 numbers, one is missing or one too many"},
      {"Willson focal", kWillsonText, "69.974574039", "0", "f.cam:10: 10 = 0: f must be positive"},
      {"Willson p1", kWillsonText, "\n0\n0\n", "\n0.1\n0\n", "p1 must be 0"},
      {"Willson too long", kWillsonText, "\n0\n0\n", "\n0\n0\n5\n", "ends after 19 numbers"},
      {"XML end tag too many", kOpenCvXmlText, "</M1>", "</data></M1>",
       "the end tag </M1> is missing"},
      {"XML end tag after the root", kOpenCvXmlText, "</opencv_storage>", "</opencv_storage></M2>",
       "the start tag of </M2> is missing"},
      {"XML without a start tag", kOpenCvXmlText, "<M1 type_id=\"opencv-matrix\">", "",
       "the end tag </opencv_storage> is missing"},
      {"YAML focal", kOpenCvYamlText, "[ 5.3591573396163199e+02", "[ 0.",
       "f.cam:10: camera_matrix.data = [ 0."},
      {"YAML skew", kOpenCvYamlText, "e+02, 0., 3.4", "e+02, 1.5, 3.4", "skew of 1.5"},
      {"YAML not a number", kOpenCvYamlText, "-2.6637260909660682e-01", ".Nan",
       "distortion_coefficients.data"},
      {"YAML count", kOpenCvYamlText, "       2.3839153080878486e-01 ]", "0.1, 0.2 ]",
       "holds 6 numbers, rows x cols = 5 x 1"},
      {"YAML size", kOpenCvYamlText, "image_width: 640", "image_width: -4",
       "f.cam:4: image_width = -4: must be a whole number from 1"},
      {"YAML half a size", kOpenCvYamlText, "image_width: 640\n", "", "image_width is missing"},
      {"ROS lens", kRosText, "plumb_bob", "omni", "f.cam:8: distortion_model = omni"},
      {"ROS uncalibrated", kRosText, "[500.0", "[0.0", "is the camera calibrated?"},
      {"ROS rotation", kRosText, "[1, 0, 0, 0, 1", "[1, 0, 0, 0, 2", "is no rotation"},
      {"ROS projection", kRosText, "[480.0, 0.0, 320.0", "[0.0, 0.0, 320.0",
       "projection_matrix.data"},
      {"mrcal splined", kMrcalText, "LENSMODEL_CAHVORE_linearity=0.34",
       "LENSMODEL_SPLINED_STEREOGRAPHIC_order=3_Nx=30_Ny=18_fov_x_deg=150",
       "f.cam:3: lensmodel = \"LENSMODEL_SPLINED_STEREOGRAPHIC"},
      {"mrcal count", kMrcalText, "1e-3, 0, 0 )", "1e-3, 0 )", "11 numbers, it must have 12"},
      {"mrcal size", kMrcalText, "[640, 480]", "[640]", "imagersize = [640]: 1 numbers"},
      {"mrcal pose", kMrcalText, "b'extrinsics': [ 0.1, 1, 0.2, 33, 4.4, -55.3E-3, ],\n", "",
       "extrinsics is missing"},
  };
  for (const WrongRow& row : rows) {
    SCOPED_TRACE(row.what);
    const auto model = ParseCameraText(Replaced(row.text, row.replace, row.with), "f.cam");
    ASSERT_FALSE(model.ok());
    EXPECT_EQ(model.error().code, ErrorCode::kInvalid);
    EXPECT_NE(model.error().message.find("f.cam"), std::string::npos);
    EXPECT_NE(model.error().message.find(row.message), std::string::npos) << model.error().message;
  }
  const auto size = ParseCameraText(kCahvorText, "f.cam", {std::nullopt, {641, 480}});
  ASSERT_FALSE(size.ok());
  EXPECT_NE(size.error().message.find("640 x 480"), std::string::npos);
}

TEST(CameraFiles, InternalsThatNoCameraHasAreRefusedInEveryFormat) {
  const WrongRow rows[] = {
      {"JPL focal", kCahvorText, "H = 225.6 770 228", "H = 225.6 7e8 228",
       "f.cam:6: H = 225.6 7e8 228: gives a focal length of 7e+08 px, it must lie within 1 .. "
       "1000000 px"},
      {"JPL centre", kCahvorText, "V = -372 9 718", "V = -372 9 7180",
       "f.cam:7: V = -372 9 7180: puts the principal point at 5520.8 px, farther than the limit of "
       "4800 px, 10 times the picture's side"},
      {"CAHVORE focal", kCahvoreText, "V = 44.0102 16.904 683.916", "V = -0.5 0 0.5",
       "f.cam:6: V = -0.5 0 0.5: gives a focal length of 0.7"},
      {"label", kPdsText, "(353.341,474.873,350.82)", "(353.341,4.7e9,350.82)",
       "MODEL_COMPONENT_3 = (353.341,4.7e9,350.82): gives a focal length of 4.69673e+09"},
      {"Willson focal", kWillsonText, "69.974574039", "6.9e6", "f.cam:10: 10 = 6.9e6: gives"},
      {"Willson centre", kWillsonText, "212.45332863", "2e9",
       "f.cam:8: 8 = 2e9: puts the principal point at 2e+09 px, farther than the limit of 1000000"},
      {"YAML focal", kOpenCvYamlText, "[ 5.3591573396163199e+02", "[ 1e-3",
       "gives a focal length of 0.001 px"},
      {"YAML centre", kOpenCvYamlText, "2.3557082909788173e+02", "-4801.",
       "puts the principal point at -4801 px, farther than the limit of 4800 px"},
      {"XML", kOpenCvXmlText, "534. 0. 335.", "5e7 0. 335.", "gives a focal length of 5e+07 px"},
      {"ROS", kRosText, "320.5, 0.0, 501.0", "6401, 0.0, 501.0",
       "camera_matrix.data = [500.0, 0.0, 6401, 0.0, 501.0, 240.5, 0.0, 0.0, 1.0]: puts"},
      {"mrcal", kMrcalText, "(700, 710, 320", "(700, 1e7, 320", "gives a focal length of 1e+07"},
      {"EuRoC", kEurocText, "367.215", "-7521", "intrinsics = [458.654, 457.296, -7521, 248.375]"},
      {"Kalibr", kKalibrText, "[461.6, 460.3", "[461.6, 0.5", "cam0.intrinsics = [461.6, 0.5"},
  };
  for (const WrongRow& row : rows) {
    SCOPED_TRACE(row.what);
    const bool pair = &row.text == &kOpenCvXmlText || &row.text == &kKalibrText;
    const auto side = pair ? std::optional(StereoSide::kLeft) : std::nullopt;
    const auto model =
        ParseCameraText(Replaced(row.text, row.replace, row.with), "f.cam", {side, {}});
    ASSERT_FALSE(model.ok());
    EXPECT_EQ(model.error().code, ErrorCode::kInvalid);
    EXPECT_NE(model.error().message.find(row.message), std::string::npos) << model.error().message;
  }
}

TEST(CameraFiles, AnyBytesGiveAUsableModelOrAnError) {
  constexpr std::uint64_t kSeed = 21;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  int refused = 0;
  int used = 0;
  for (const CameraText& row : GoodCameraTexts()) {
    SCOPED_TRACE(row.name);
    for (int i = 0; i < 400; ++i) {
      std::string text = row.text;
      if (i % 4 == 0) {  // cut short
        text.resize(static_cast<std::size_t>(random.Index(static_cast<int>(text.size()))));
      }
      for (int k = random.Index(4); k > 0 && !text.empty(); --k) {
        const auto place = static_cast<std::size_t>(random.Index(static_cast<int>(text.size())));
        switch (random.Index(4)) {
          case 0:
            text[place] = static_cast<char>(random.Index(256));
            break;
          case 1:
            text[place] = "0123456789-.eE,[(<\n"[random.Index(19)];
            break;
          case 2:
            text.erase(place, static_cast<std::size_t>(random.Index(40)));
            break;
          default:
            text.insert(place, text.substr(place, static_cast<std::size_t>(random.Index(60))));
        }
      }
      const auto model = ParseCameraText(text, row.name, {StereoSide::kRight, {}});
      if (!model) {
        EXPECT_NE(model.error().message.find(row.name), std::string::npos) << model.error().message;
        ++refused;
        continue;
      }
      ++used;
      EXPECT_TRUE(CentreOf(*model).allFinite());
      const auto ray = RayFromPixelCamera(*model, {320, 240});
      if (ray) {
        EXPECT_TRUE(ray->direction.allFinite());
        ProjectCamera(*model, ray->origin + ray->direction);
      }
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(used, 500);
}

/// Megabytes that a careless parser would multiply: the test ends, or it does not.
TEST(CameraFiles, SizeAloneCostsNothing) {
  constexpr std::size_t kSize = 4 << 20;
  const auto repeated = [&](const std::string& start, const std::string& part) {
    std::string text = start;
    while (text.size() < kSize) {
      text += part;
    }
    return text;
  };
  std::string distinct;
  for (int i = 0; distinct.size() < kSize; ++i) {
    distinct += "k" + std::to_string(i) + " = 1\n";
  }
  const std::string long_key(kSize, 'k'), long_tag(kSize / 2, 'k');
  const std::string rows[] = {
      distinct,
      repeated("camera_matrix: [", "1,"),
      repeated(long_key + ":\n", " a:\n"),
      repeated("a:\n", "- 1\n"),
      repeated("<?xml?>", "<a>"),
      repeated("<?xml?><" + long_tag + ">", "<a></a>"),
      repeated("{'lensmodel': ", "["),
      repeated("{'lensmodel': 'x', ", "'a': 'b', "),
      repeated("GROUP = GEOMETRIC_CAMERA_MODEL\n", "OBJECT = A\n"),
      repeated("MODEL_COMPONENT_1 = ", "("),
      repeated("", "1\n"),
      repeated("", "1 "),
      repeated("C = ", "1 "),
  };
  for (const std::string& text : rows) {
    SCOPED_TRACE(text.substr(0, 40));
    EXPECT_FALSE(ParseCameraText(text, "large").ok());
  }
}

TEST(CameraFiles, MissingAndHugeFilesAreNamed) {
  const auto missing = ReadCameraFile("/nowhere/left.cahvor");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(missing.error().message.find("/nowhere/left.cahvor"), std::string::npos);
  const auto huge = ParseCameraText(std::string((16 << 20) + 1, ' '), "big.yml");
  ASSERT_FALSE(huge.ok());
  EXPECT_NE(huge.error().message.find("big.yml: larger than 16 MiB"), std::string::npos);
}

}  // namespace
}  // namespace palace
