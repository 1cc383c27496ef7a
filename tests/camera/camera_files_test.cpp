#include "engine/camera/camera_files.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

const char* const kGood =
    "Dimensions = 640 480\n"
    "Model = CAHVOR = perspective, distortion\n"
    "C = 0 -0.528 0\n"
    "A = 0.6 0 0.8\n"
    "H = 225.6 770 228   # pixels\n"
    "V = -372 9 718\n"
    "O = 0.6 0 0.8\n"
    "R = 0.0004 -0.21 0.09\n"
    "Hs = 770\n";

TEST(CameraFiles, ReadsWhatItWrites) {
  const auto model = ParseCahvorText(kGood, "a.cahvor");
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_EQ(model->width, 640);
  EXPECT_EQ(model->height, 480);
  EXPECT_EQ(model->H.x(), 225.6);
  EXPECT_EQ(model->R.y(), -0.21);
  const auto again = ParseCahvorText(CahvorToText(*model), "b.cahvor");
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_LT((again->A - model->A).norm(), 1e-16);
  EXPECT_EQ(again->V, model->V);
  EXPECT_EQ(again->R, model->R);
}

struct WrongRow {
  const char* what;
  const char* replace;
  const char* with;
  const char* message;
};

TEST(CameraFiles, ErrorsNameFileLineAndKey) {
  const WrongRow rows[] = {
      {"missing key", "C = 0 -0.528 0\n", "", "C is missing"},
      {"too few numbers", "H = 225.6 770 228", "H = 225.6 770", "a.cahvor:5: H has 2 numbers"},
      {"not a number", "V = -372", "V = x372", "a.cahvor:6: V"},
      {"infinite", "V = -372", "V = inf", "a.cahvor:6: V"},
      {"no size", "640 480", "0 480", "a.cahvor:1: Dimensions"},
      {"not a direction", "A = 0.6 0 0.8", "A = 0.6 0 8", "a.cahvor:4: A has length"},
      {"other model", "CAHVOR =", "CAHVORE =", "a.cahvor:2: Model"},
      {"no focal length", "H = 225.6 770 228", "H = 6 0 8", "runs along A"},
  };
  for (const WrongRow& row : rows) {
    SCOPED_TRACE(row.what);
    std::string text = kGood;
    const auto place = text.find(row.replace);
    ASSERT_NE(place, std::string::npos);
    text.replace(place, std::string(row.replace).size(), row.with);
    const auto model = ParseCahvorText(text, "a.cahvor");
    ASSERT_FALSE(model.ok());
    EXPECT_NE(model.error().message.find(row.message), std::string::npos) << model.error().message;
  }
}

TEST(CameraFiles, AnyBytesGiveAModelOrAnError) {
  constexpr std::uint64_t kSeed = 21;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  const std::string good = kGood;
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    std::string text =
        good.substr(0, static_cast<std::size_t>(random.Index(static_cast<int>(good.size()))));
    for (int k = 0; k < 3 && !text.empty(); ++k) {
      text[static_cast<std::size_t>(random.Index(static_cast<int>(text.size())))] =
          static_cast<char>(random.Index(256));
    }
    const auto model = ParseCahvorText(text, "fuzz");
    refused += model.ok() ? 0 : 1;
    if (model.ok()) {
      EXPECT_TRUE(model->H.allFinite() && model->width > 0);
    }
  }
  EXPECT_GT(refused, 400);
}

TEST(CameraFiles, ReadsARealFile) {
  const auto path =
      std::filesystem::path(PALACE_SHARED_DATA_DIR) / "mrcal_reference/splined-0.scale0.6.cahvor";
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << "no " << path;
  }
  const auto model = ReadCahvorFile(path);
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_EQ(model->width, 6016);
  EXPECT_NEAR(model->H.x(), 1211.374926, 1e-9);
}

TEST(CameraFiles, MissingFileIsNamed) {
  const auto model = ReadCahvorFile("/nowhere/left.cahvor");
  ASSERT_FALSE(model.ok());
  EXPECT_EQ(model.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(model.error().message.find("/nowhere/left.cahvor"), std::string::npos);
}

}  // namespace
}  // namespace palace
