// Camera files that end too early: refused, or the same camera; never another one.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "engine/camera/files/camera_files.h"
#include "engine/core/random.h"
#include "tests/camera/camera_file_texts.h"
#include "tests/camera/sample_cameras.h"

namespace palace {
namespace {

/// All that a file told: family, numbers, pose, and the size unless `without_size`.
std::string Told(const CameraModel& model, bool without_size) {
  CameraModel camera = model;
  if (without_size) {
    SetSize(camera, 0, 0);
  }
  const CameraFormat format =
      std::holds_alternative<TsaiModel>(camera.lens)     ? CameraFormat::kWillson
      : std::holds_alternative<OpenCvModel>(camera.lens) ? CameraFormat::kOpenCvXml
                                                         : CameraFormat::kJplText;
  return FamilyOf(camera) + (camera.pose_is_known ? " placed\n" : "\n") +
         CameraToText(camera, format).value();
}

/// One value a line and nothing that closes: JPL's and Willson's files.
bool IsOfLines(const std::string& text) {
  return text.find_first_of("{<[:") == std::string::npos && text.find("GROUP") == std::string::npos;
}

/// Whether a cut before `bytes` leaves the front of a number.
bool CutsANumber(const std::string& text, std::size_t bytes) {
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() &&
           std::string_view("0123456789.eE+-").find(text[at]) != std::string::npos;
  };
  return bytes > 0 && is_digit(bytes - 1) && is_digit(bytes);
}

struct CutFile {
  std::string name;
  std::string text;
  bool may_lose_size = false;  ///< tells its size in an optional last line
};

/// Files of other writers, and one of ours of each family and format.
std::vector<CutFile> FilesToCut(RandomStream& random) {
  std::vector<CutFile> files;
  for (const CameraText& row : GoodCameraTexts()) {
    files.push_back({row.name, row.text});
  }
  for (int family = 0; family < kFamilies; ++family) {
    CameraModel model = RandomCamera(random, family);
    for (const CameraFormat format :
         {CameraFormat::kJplText, CameraFormat::kWillson, CameraFormat::kOpenCvYaml,
          CameraFormat::kOpenCvXml, CameraFormat::kRosYaml}) {
      for (const bool placed : {true, false}) {
        model.pose_is_known = placed;
        if (const auto text = CameraToText(model, format); text.ok()) {
          files.push_back({FamilyOf(model) + " as " + CameraFormatName(format), *text,
                           format == CameraFormat::kWillson});
        }
      }
    }
  }
  return files;
}

TEST(CameraFiles, CutAtAnyByteAFileIsTheSameCameraOrRefused) {
  constexpr std::uint64_t kSeed = 22;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (const CutFile& file : FilesToCut(random)) {
    SCOPED_TRACE(file.name);
    const CameraFileOptions options = {StereoSide::kRight, {}};
    const auto whole = ParseCameraText(file.text, file.name, options);
    ASSERT_TRUE(whole.ok()) << whole.error().message;
    int refused = 0;
    for (std::size_t bytes = 0; bytes < file.text.size(); ++bytes) {
      if (IsOfLines(file.text) && CutsANumber(file.text, bytes)) {
        continue;  // cannot be told from a shorter number
      }
      const auto cut = ParseCameraText(file.text.substr(0, bytes), file.name, options);
      if (!cut) {
        ++refused;
        continue;
      }
      const bool without_size = file.may_lose_size && !HasSize(*cut);
      ASSERT_EQ(Told(*cut, without_size), Told(*whole, without_size))
          << "cut after byte " << bytes << ", the end is '"
          << file.text.substr(bytes < 40 ? 0 : bytes - 40, std::min<std::size_t>(bytes, 40)) << "'";
    }
    EXPECT_GT(refused, 30);
  }
}

TEST(CameraFiles, MatricesThatDoNotHoldWhatTheyPromiseAreRefused) {
  const std::string opencv8 =
      Replaced(Replaced(kOpenCvYamlText, "rows: 5", "rows: 8"), "e-01 ]", "e-01,");
  const std::string xml = kOpenCvXmlText.substr(0, kOpenCvXmlText.find("<M2"));
  const struct {
    const char* what;
    std::string text;
    const char* message;
  } rows[] = {
      {"ends at [", kOpenCvYamlText.substr(0, kOpenCvYamlText.rfind('[') + 1),
       "ends in this value"},
      {"4 of 5, no ]", kOpenCvYamlText.substr(0, kOpenCvYamlText.rfind(",")), "ends in this value"},
      {"5 of 8, no ]", opencv8, "ends in this value"},
      {"5 of 8", Replaced(kOpenCvYamlText, "rows: 5", "rows: 8"),
       "holds 5 numbers, rows x cols = 8 x 1"},
      {"no cols", Replaced(kOpenCvYamlText, "   rows: 5\n   cols: 1\n", "   rows: 5\n"),
       "cols is missing"},
      {"empty", Replaced(kRosText, "data: [-0.2, 0.05, 0.001, -0.001, 0]", "data: []"),
       "data = []: holds 0 numbers"},
      {"nothing", Replaced(kRosText, "  data: [-0.2, 0.05, 0.001, -0.001, 0]\n", ""),
       "f.cam:9: distortion_coefficients = : holds 0"},
      {"an empty matrix",
       Replaced(Replaced(kRosText, "cols: 5", "cols: 0"), "[-0.2, 0.05, 0.001, -0.001, 0]", "[]"),
       "has 0 coefficients, it must have 4, 5"},
      {"no distortion", kOpenCvYamlText.substr(0, kOpenCvYamlText.find("distortion")),
       "distortion_coefficients is missing"},
      {"no end tag", Replaced(kOpenCvXmlText, "</opencv_storage>", ""), "end tag of the root"},
      {"an empty element", Replaced(kOpenCvXmlText, "-0.28 0.1 0. 0. 0.", ""),
       "D2.data = : holds 0 numbers"},
      {"one of a pair", xml + "</opencv_storage>", "M2 is missing"},
      {"no T", Replaced(Replaced(kOpenCvXmlText, "<T type", "<U type"), "</T>", "</U>"),
       "T is missing"},
      {"no end of the group", Replaced(kPdsText, "END_GROUP = GEOMETRIC_CAMERA_MODEL\nEND\n", ""),
       "the end of the group GEOMETRIC_CAMERA_MODEL is missing"},
      {"no brace", kMrcalText.substr(0, kMrcalText.rfind('}')), "closing }"},
      {"O without R",
       Replaced(Replaced(kCahvorText, "Model = CAHVOR = perspective, distortion\n", ""),
                "R = 0.0004 -0.21 0.09\n", ""),
       "R is missing"},
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(row.what);
    const auto model = ParseCameraText(row.text, "f.cam", {StereoSide::kRight, {}});
    ASSERT_FALSE(model.ok());
    EXPECT_NE(model.error().message.find(row.message), std::string::npos) << model.error().message;
  }
}

}  // namespace
}  // namespace palace
