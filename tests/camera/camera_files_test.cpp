// Camera files of every format: what they hold, exact round trips, real files. Damaged ones:
// camera_files_damage_test.cpp.
#include "engine/camera/files/camera_files.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "engine/camera/cahvor.h"
#include "tests/camera/camera_file_texts.h"
#include "tests/camera/reference_vectors.h"
#include "tests/camera/sample_cameras.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

CameraModel Parsed(const std::string& text, const std::string& name,
                   const CameraFileOptions& options = {}) {
  const auto model = ParseCameraText(text, name, options);
  EXPECT_TRUE(model.ok()) << model.error().message;
  return model.ok() ? *model : CameraModel{};
}

TEST(CameraFiles, ContentTellsTheFormat) {
  const CameraFormat formats[] = {
      CameraFormat::kJplText,     CameraFormat::kJplText,    CameraFormat::kPdsLabel,
      CameraFormat::kPdsLabel,    CameraFormat::kWillson,    CameraFormat::kOpenCvYaml,
      CameraFormat::kOpenCvXml,   CameraFormat::kRosYaml,    CameraFormat::kMrcal,
      CameraFormat::kEurocSensor, CameraFormat::kKalibrChain};
  std::size_t i = 0;
  for (const CameraText& row : GoodCameraTexts()) {
    SCOPED_TRACE(row.name);
    const auto format = CameraFormatOf(row.text, "misnamed.txt");
    ASSERT_TRUE(format.ok()) << format.error().message;
    EXPECT_EQ(*format, formats[i++]);
  }
  const auto unknown = CameraFormatOf("hello\n", "letter.txt");
  ASSERT_FALSE(unknown.ok());
  EXPECT_NE(unknown.error().message.find("letter.txt: no camera model"), std::string::npos);
}

TEST(CameraFiles, JplTextHoldsTheWholeFamily) {
  const auto cahvor = std::get<CahvorModel>(Parsed(kCahvorText, "a.cahvor").lens);
  EXPECT_EQ(cahvor.width, 640);
  EXPECT_EQ(cahvor.height, 480);
  EXPECT_EQ(cahvor.H.x(), 225.6);
  EXPECT_EQ(cahvor.R.y(), -0.21);
  const auto cahvore = std::get<CahvoreModel>(Parsed(kCahvoreText, "a.cahvore").lens);
  EXPECT_EQ(cahvore.linearity, 0.37);
  EXPECT_EQ(cahvore.E.z(), 0.001613);
  const auto linearity = [](const std::string& line) {
    return std::get<CahvoreModel>(
               Parsed(Replaced(kCahvoreText, "CAHVORE3,0.37 = general", line), "a").lens)
        .linearity;
  };
  EXPECT_EQ(linearity("CAHVORE1 = perspective, distortion, pupil"), 1);
  EXPECT_EQ(linearity("CAHVORE2 = fish-eye"), 0);
  EXPECT_EQ(linearity("CAHVORE3, -0.5 = general"), -0.5);
  const CameraModel no_size = Parsed(Replaced(kCahvorText, "Dimensions = 640 480\n", ""), "a");
  EXPECT_FALSE(HasSize(no_size));
  EXPECT_FALSE(ParseCahvorText(Replaced(kCahvorText, "Dimensions = 640 480\n", ""), "a").ok());
  const CameraModel sized =
      Parsed(Replaced(kCahvorText, "Dimensions = 640 480\n", ""), "a", {std::nullopt, {800, 600}});
  EXPECT_EQ(HeightOf(sized), 600);
  const std::string old = Replaced(kCahvorText, "Model = CAHVOR = perspective, distortion\n", "");
  EXPECT_EQ(std::get<CahvorModel>(Parsed(old, "a").lens).R.y(), -0.21);
}

TEST(CameraFiles, LabelsAreReadWhereverTheirGroupStands) {
  const CameraModel label = Parsed(kPdsText, "a.lbl");
  const auto cahvore = std::get<CahvoreModel>(label.lens);
  EXPECT_EQ(cahvore.linearity, 0.37);
  EXPECT_EQ(cahvore.base.C.z(), -0.234891);
  EXPECT_EQ(cahvore.base.H.y(), 474.873);
  EXPECT_NEAR(cahvore.base.A.norm(), 1, 1e-15);
  EXPECT_EQ(WidthOf(label), 1024);
  const CameraModel vicar = Parsed(kVicarText, "a.vic");
  EXPECT_EQ(FamilyOf(vicar), "CAHV");
  EXPECT_EQ(WidthOf(vicar), 640);
  EXPECT_EQ(HeightOf(vicar), 480);
}

TEST(CameraFiles, LengthsOfLabelsBecomeMetres) {
  const auto label = [](const std::string& unit, const std::string& in_list) {
    const std::string list = "  MODEL_COMPONENT_UNIT = (" + in_list + ")\n  MODEL_COMPONENT_1 =";
    std::string text =
        in_list.empty() ? kPdsText : Replaced(kPdsText, "  MODEL_COMPONENT_1 =", list);
    for (int i = 0; i < 3; ++i) {
      text = Replaced(text, " <m>", unit);
    }
    return std::get<CahvoreModel>(Parsed(text, "a.lbl").lens);
  };
  struct Row {
    const char* unit;  ///< behind the numbers of C
    const char* in_list;
    double C_m;
    double E_m;
  };
  const Row rows[] = {
      {"", "", 1, 1},
      {"", "METER,\"N/A\",PIXEL,PIXEL,\"N/A\",\"N/A\",\"N/A\"", 1, 1},
      {"", "\"N/A\"", 1, 1},
      {"", "MILLIMETER,\n    \"N/A\",PIXEL,PIXEL,\"N/A\",\"N/A\",\"N/A\"", 0.001, 0.001},
      {"", "'millimetres'", 0.001, 0.001},
      {"", "MM,\"N/A\",PIXEL,PIXEL,\"N/A\",\"N/A\",METRE", 0.001, 1},
      {"", "CENTIMETER", 0.01, 0.01},
      {" <mm>", "METER", 0.001, 0.001},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(std::string(row.unit) + row.in_list);
    const CahvoreModel model = label(row.unit, row.in_list);
    EXPECT_DOUBLE_EQ(model.base.C.x(), 0.606185 * row.C_m);
    EXPECT_DOUBLE_EQ(model.E.x(), 0.000942 * row.E_m);
    EXPECT_EQ(model.base.H.x(), 353.341) << "pixels stay";
  }
  const std::string vicar = Replaced(
      kVicarText, "MODEL_COMPONENT_1=", "MODEL_COMPONENT__UNIT=('MILLIMETER') MODEL_COMPONENT_1=");
  EXPECT_DOUBLE_EQ(CentreOf(Parsed(vicar, "a.vic")).y(), -0.528e-3);
}

TEST(CameraFiles, WhatIsWrittenIsNoneOfTheFilesRead) {
  const std::filesystem::path folder = OwnPath();
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a.cahvor") << kCahvorText;
  std::filesystem::create_symlink("a.cahvor", folder / "b.cahvor");
  for (const char* name : {"a.cahvor", "b.cahvor", "./a.cahvor"}) {
    const Status apart = CheckNoInput(folder / name, {folder / "none", folder / "a.cahvor"});
    ASSERT_FALSE(apart.ok()) << name;
    EXPECT_EQ(apart.error().code, ErrorCode::kUsage);
    EXPECT_NE(apart.error().message.find("would overwrite "), std::string::npos);
  }
  EXPECT_TRUE(CheckNoInput(folder / "c.cahvor", {folder / "a.cahvor"}).ok());
  EXPECT_TRUE(CheckNoInput(folder / "c.cahvor", {folder / "c.cahvor"}).ok()) << "not there yet";
  std::filesystem::remove_all(folder);
}

TEST(CameraFiles, WillsonFilesMayLabelTheirNumbersOrShareLines) {
  const TsaiModel plain = std::get<TsaiModel>(Parsed(kWillsonText, "a.cpcc").lens);
  EXPECT_EQ(plain.Rz_rad, 0.035000288833);
  EXPECT_EQ(plain.T.z(), 1999.7624626);
  const std::string labelled = Replaced(
      Replaced(kWillsonText, "576\n576\n0.023\n", "576 [sel] Ncx\n576 0.023\n"), "\n0\n0\n", "\n");
  const TsaiModel model = std::get<TsaiModel>(Parsed(labelled, "b.cpcc").lens);
  EXPECT_EQ(model.frame_columns, 576);
  EXPECT_EQ(model.dx, 0.023);
  EXPECT_EQ(model.Rz_rad, 0.035000288833);
}

TEST(CameraFiles, OpenCvPairsNeedAChoiceAndTellThePose) {
  const auto none = ParseCameraText(kOpenCvXmlText, "pair.xml");
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().message.find("--camera left or right"), std::string::npos);
  const CameraModel left = Parsed(kOpenCvXmlText, "pair.xml", {StereoSide::kLeft, {}});
  const CameraModel right = Parsed(kOpenCvXmlText, "pair.xml", {StereoSide::kRight, {}});
  EXPECT_EQ(std::get<OpenCvModel>(left.lens).pinhole.fx_px, 534);
  EXPECT_EQ(std::get<OpenCvModel>(right.lens).pinhole.fx_px, 536);
  EXPECT_EQ(std::get<OpenCvModel>(right.lens).k[0], -0.28);
  EXPECT_TRUE(left.pose_is_known && right.pose_is_known);
  EXPECT_EQ(CentreOf(left), Eigen::Vector3d::Zero());
  EXPECT_LT((CentreOf(right) - Eigen::Vector3d(3.3, -0.04, -0.001)).norm(), 1e-15);
  EXPECT_EQ(WidthOf(left), 640);
  EXPECT_FALSE(Parsed(kOpenCvYamlText, "a.yml").pose_is_known);
}

TEST(CameraFiles, YamlOfOtherWritersIsRead) {
  const std::string nested =
      "camera_matrix:\n- - 532.5\n  - 0.0\n  - 342.25\n- - 0.0\n  - 533.0\n  - 235.5\n- - 0.0\n"
      "  - 0.0\n  - 1.0\ndist_coeff:\n- - -0.28\n  - 0.05\n  - 0.001\n  - -0.0003\n  - 0.12\n";
  for (const std::string& text : {nested, "\xEF\xBB\xBF" + nested,
                                  Replaced(nested, "camera_matrix:\n", "camera_matrix:\r\n")}) {
    const auto model = std::get<OpenCvModel>(Parsed(text, "calibration.yaml").lens);
    EXPECT_EQ(model.pinhole.fx_px, 532.5);
    EXPECT_EQ(model.pinhole.cy_px, 235.5);
    EXPECT_EQ(model.k[0], -0.28);
    EXPECT_EQ(model.k[4], 0.12);
  }
  const std::string echoed =
      "header: \n  seq: 1\nheight: 480\nwidth: 640\ndistortion_model: \"plumb_bob\"\n"
      "D: [-0.2, 0.05, 0.0, 0.0, 0.0]\nK: [500.0, 0.0, 320.0, 0.0, 500.0, 240.0, 0.0, 0.0, 1.0]\n"
      "R: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]\n"
      "P: [500.0, 0.0, 320.0, -50.0, 0.0, 500.0, 240.0, 0.0, 0.0, 0.0, 1.0, 0.0]\nroi: \n  height: "
      "0\n";
  const CameraModel ros = Parsed(echoed, "info.txt");
  EXPECT_EQ(HeightOf(ros), 480);
  EXPECT_LT((CentreOf(ros) - Eigen::Vector3d(0.1, 0, 0)).norm(), 1e-15);
}

TEST(CameraFiles, RosProjectionTellsTheBaseline) {
  const CameraModel right = Parsed(kRosText, "right.yaml");
  EXPECT_LT((CentreOf(right) - Eigen::Vector3d(0.12, 0, 0)).norm(), 1e-15);
  EXPECT_TRUE(right.pose_is_known);
  const CameraModel left = Parsed(Replaced(kRosText, "-57.6", "0.0"), "left.yaml");
  EXPECT_FALSE(left.pose_is_known);
  const std::string fisheye =
      Replaced(Replaced(Replaced(kRosText, "plumb_bob", "equidistant"), "cols: 5", "cols: 4"),
               "[-0.2, 0.05, 0.001, -0.001, 0]", "\n  - 0.01\n  - 0.02\n  - 0\n  - -0.001");
  EXPECT_EQ(std::get<OpenCvModel>(Parsed(fisheye, "f.yaml").lens).lens, OpenCvLens::kFisheye);
  EXPECT_EQ(std::get<OpenCvModel>(Parsed(fisheye, "f.yaml").lens).k[3], -0.001);
}

TEST(CameraFiles, MrcalPosesTakeTheReferenceToTheCamera) {
  const CameraModel model = Parsed(kMrcalText, "a.cameramodel");
  const auto& cahvore = std::get<CahvoreModel>(model.lens);
  EXPECT_EQ(cahvore.linearity, 0.34);
  EXPECT_EQ(cahvore.E.x(), 1e-3);
  const Eigen::Vector3d turn(0.1, 1, 0.2);
  const Eigen::Matrix3d R_CF = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  EXPECT_LT((R_CF * CentreOf(model) + Eigen::Vector3d(33, 4.4, -55.3e-3)).norm(), 1e-12);
  EXPECT_LT((RotationOf(model) - R_CF).norm(), 1e-14);
  EXPECT_NEAR((R_CF * cahvore.base.O).y(), std::sin(0.02), 1e-15);
}

CameraFormat FormatFor(const CameraModel& model, int choice) {
  if (std::holds_alternative<TsaiModel>(model.lens)) {
    return CameraFormat::kWillson;
  }
  if (std::holds_alternative<OpenCvModel>(model.lens)) {
    return choice == 0 ? CameraFormat::kOpenCvYaml : CameraFormat::kOpenCvXml;
  }
  return CameraFormat::kJplText;
}

TEST(CameraFiles, WrittenCamerasReadBackToTheBit) {
  constexpr std::uint64_t kSeed = 51;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (int family = 0; family < kFamilies; ++family) {
    for (int i = 0; i < 40; ++i) {
      const CameraModel model = RandomCamera(random, family);
      SCOPED_TRACE(FamilyOf(model));
      const auto text = CameraToText(model, FormatFor(model, i % 2));
      ASSERT_TRUE(text.ok()) << text.error().message;
      const CameraModel again = Parsed(*text, "b");
      EXPECT_EQ(WidthOf(again), 640);
      EXPECT_EQ(HeightOf(again), 480);
      EXPECT_EQ(FamilyOf(again), FamilyOf(model));
      EXPECT_EQ(CameraToText(again, FormatFor(model, i % 2)).value(), *text) << "second writing";
      const auto ray = RayFromPixelCamera(model, {100, 400});
      const auto ray_again = RayFromPixelCamera(again, {100, 400});
      ASSERT_EQ(ray.has_value(), ray_again.has_value());
      if (ray) {
        EXPECT_LT((ray->direction - ray_again->direction).norm(), 1e-14);
        EXPECT_LT((ray->origin - ray_again->origin).norm(), 1e-13 / model.unit_m);
      }
    }
  }
}

TEST(CameraFiles, RosFilesKeepThePoseWithinRounding) {
  constexpr std::uint64_t kSeed = 52;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (const int coefficients : {0, 5, 8, -4}) {
    const CameraModel model{RandomOpenCv(random, coefficients)};
    const auto text = CameraToText(model, CameraFormat::kRosYaml);
    ASSERT_TRUE(text.ok());
    const CameraModel again = Parsed(*text, "b.yaml");
    const Eigen::Vector3d p =
        RayFromPixelCamera(model, {333, 222})->direction * 9 + CentreOf(model);
    EXPECT_LT((ProjectCamera(again, p).value() - Eigen::Vector2d(333, 222)).norm(), 1e-9);
  }
}

TEST(CameraFiles, OpenCvReadsWhatWeWrite) {
  constexpr std::uint64_t kSeed = 53;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  const OpenCvModel model = RandomOpenCv(random, 8);
  for (const CameraFormat format : {CameraFormat::kOpenCvYaml, CameraFormat::kOpenCvXml}) {
    const cv::FileStorage storage(CameraToText({model}, format).value(),
                                  cv::FileStorage::READ | cv::FileStorage::MEMORY);
    cv::Mat K, k, R;
    int width = 0;
    storage["camera_matrix"] >> K;
    storage["distortion_coefficients"] >> k;
    storage["R"] >> R;
    storage["image_width"] >> width;
    EXPECT_EQ(width, 640);
    ASSERT_EQ(k.total(), 8U);
    EXPECT_EQ(K.at<double>(0, 2), model.pinhole.cx_px);
    EXPECT_EQ(k.at<double>(7), model.k[7]);
    EXPECT_EQ(R.at<double>(2, 1), model.R_CF(2, 1));
  }
}

TEST(CameraFiles, FormatsRefuseFamiliesTheyCannotHold) {
  RandomStream random(54);
  const CameraModel cahvor{RandomCahvor(random)};
  for (const CameraFormat format : {CameraFormat::kWillson, CameraFormat::kRosYaml}) {
    const auto text = CameraToText(cahvor, format);
    ASSERT_FALSE(text.ok());
    EXPECT_NE(text.error().message.find("cannot hold a CAHVOR camera"), std::string::npos);
  }
  EXPECT_FALSE(CameraToText({RandomTsai(random)}, CameraFormat::kJplText).ok());
  EXPECT_FALSE(CameraToText(cahvor, CameraFormat::kMrcal).ok());
}

TEST(CameraFiles, RealFilesParse) {
  for (const char* set : {"mrcal_reference", "msl_navcam_label", "opencv_stereo_calib"}) {
    if (!HasReferenceData(set)) {
      GTEST_SKIP() << NoReferenceData(set);
    }
  }
  for (const char* name :
       {"mrcal_reference/splined-0.scale0.6.cahvor", "mrcal_reference/splined-1.scale0.6.cahvor",
        "mrcal_reference/cam0.opencv8.cameramodel", "mrcal_reference/cam1.opencv8.cameramodel",
        "mrcal_reference/pinhole-narrow-yawed-left.cameramodel",
        "mrcal_reference/pinhole-narrow-yawed-right.cameramodel",
        "msl_navcam_label/geometric_camera_model_group.txt",
        "opencv_stereo_calib/left_intrinsics.yml", "opencv_stereo_calib/intrinsics.yml"}) {
    SCOPED_TRACE(name);
    const auto model = ReadCameraFile(ReferenceData(name), {StereoSide::kRight, {}});
    ASSERT_TRUE(model.ok()) << model.error().message;
    const auto text = CameraToText(*model, FormatFor(*model, 0));
    ASSERT_TRUE(text.ok());
    const CameraModel again = Parsed(*text, name);
    EXPECT_EQ(CameraToText(again, FormatFor(*model, 0)).value(), *text);
    const auto ray = RayFromPixelCamera(*model, {300, 200});
    ASSERT_TRUE(ray);
    EXPECT_EQ(RayFromPixelCamera(again, {300, 200})->direction, ray->direction);
  }
  const auto list = ReadCameraFile(ReferenceData("opencv_stereo_calib/stereo_calib.xml"));
  ASSERT_FALSE(list.ok()) << "a list of pictures";
  EXPECT_NE(list.error().message.find("camera_matrix is missing"), std::string::npos);
}

TEST(CameraFiles, TheMslNavcamLabelProjectsAsPublished) {
  if (!HasReferenceData("msl_navcam_label")) {
    GTEST_SKIP() << NoReferenceData("msl_navcam_label");
  }
  const auto model =
      ReadCameraFile(ReferenceData("msl_navcam_label/geometric_camera_model_group.txt"));
  ASSERT_TRUE(model.ok()) << model.error().message;
  const auto pixel = ProjectCamera(*model, {19.494, -4.013, 21.262});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 509.344151470, 1e-9);
  EXPECT_NEAR(pixel->y(), 517.327407788, 1e-9);
  const auto ray = RayFromPixelCamera(*model, {0, 0});
  ASSERT_TRUE(ray);
  EXPECT_LT(
      (ray->direction - Eigen::Vector3d(0.712194955479, -0.554584377521, 0.430365558102)).norm(),
      1e-12);
  EXPECT_NEAR(InternalsOf(std::get<CahvorModel>(model->lens)).hs_px, 1220.324915, 1e-6);
}

}  // namespace
}  // namespace palace
