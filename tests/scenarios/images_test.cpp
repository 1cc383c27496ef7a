// Photographs of a beach park: analysed by palacectl, and shown by palace.
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "gui/app/layout.h"
#include "tests/scenarios/scenario.h"
#include "tests/support/reference_data.h"

namespace palace {
namespace {

const std::filesystem::path kRig =
    std::filesystem::path(PALACE_SOURCE_DIR) / "tests/support/brighton/pair_25_26.toml";

class Photographs : public Scenario {
 protected:
  void SetUp() override {
    pictures_ = ReferenceData("brighton_beach_rect");
    if (!std::filesystem::exists(pictures_ / "pair_25_26_left.png")) {
      GTEST_SKIP() << NoReferenceData("brighton_beach_rect");
    }
  }
  std::filesystem::path pictures_;
};

TEST_F(Photographs, AnalyzeFindsASiteAndWritesEveryFile) {
  const ProcessResult result =
      RunProcess(Palacectl({"analyze", "--left", pictures_ / "pair_25_26_left.png", "--right",
                            pictures_ / "pair_25_26_right.png", "--rig", kRig, "--out", "out"}),
                 120);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* map : {"elevation", "slope", "roughness", "cost", "safe_distance", "hazard"}) {
    for (const char* kind : {".tif", ".png"}) {
      EXPECT_TRUE(std::filesystem::file_size(folder_ / "out" / (std::string(map) + kind)) > 100);
    }
  }
  for (const char* name : {"safe_landing.png", "overlay.png", "site.json"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / name)) << name;
  }
  std::ifstream file(folder_ / "out" / "site.json");
  const auto json = nlohmann::json::parse(file, nullptr, false);
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["status"], "found");
  for (const char* key : {"candidates", "grid", "rejected", "settings", "timing_ms", "warnings"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  const auto& site = json["site"];
  EXPECT_GE(site["clearance_m"].get<double>(), 0);
  EXPECT_LE(site["slope_deg"].get<double>(), 10);
  EXPECT_GE(site["row"].get<int>(), 0);
  EXPECT_LT(site["row"].get<int>(), json["grid"]["rows"].get<int>());
  // Both pictures look straight down from 39.5 m: the site lies in the left one.
  EXPECT_GE(site["pixel_x"].get<double>(), 0);
  EXPECT_LT(site["pixel_x"].get<double>(), 1400);
}

TEST_F(Photographs, ExchangedPicturesAreNoticedAndGiveNoSite) {
  const ProcessResult result =
      RunProcess(Palacectl({"analyze", "--left", pictures_ / "pair_25_26_right.png", "--right",
                            pictures_ / "pair_25_26_left.png", "--rig", kRig, "--out", "out"}),
                 120);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("left and right look exchanged"), std::string::npos) << result.err;
  std::ifstream file(folder_ / "out" / "site.json");
  EXPECT_EQ(nlohmann::json::parse(file, nullptr, false)["status"], "none");
}

TEST_F(Photographs, PalaceShowsThemAndTheirSites) {
  WriteFile("look.script",
            "wait state PROPOSED 20\n"
            "expect text mode IMAGES\n"
            "screenshot fly.png\n"
            "click tab/Tune\n"
            "screenshot tune.png\n"
            "click tab/Fly\n"
            "wait item view/Above 5\n"
            "click view/Above\n"
            "screenshot above.png\n"
            "wait seconds 1\n"
            "screenshot later.png\n"
            "quit\n");
  const ProcessResult result = RunProcess(
      Palace({"--headless", "--images", kRig, "--script", "look.script", "--record", "rec"}), 120);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto flights = FlightsIn(folder_ / "rec");
  ASSERT_EQ(flights.size(), 1u) << result.out;
  for (const char* name : {"fly.png", "tune.png"}) {
    EXPECT_TRUE(std::filesystem::exists(flights[0] / name)) << name;
  }
  // The view stands where it was sent, in the first picture already.
  const Rect view = ComputeFlyLayout(1920, 1080, 1, false).view_3d;
  const cv::Rect scene(static_cast<int>(view.x) + 4, static_cast<int>(view.y) + 70,
                       static_cast<int>(view.w) - 8, static_cast<int>(view.h) - 80);
  const cv::Mat before = cv::imread((flights[0] / "fly.png").string());
  const cv::Mat above = cv::imread((flights[0] / "above.png").string());
  const cv::Mat later = cv::imread((flights[0] / "later.png").string());
  ASSERT_FALSE(before.empty() || above.empty() || later.empty());
  EXPECT_GT(cv::norm(before(scene), above(scene), cv::NORM_INF), 40);
  EXPECT_EQ(cv::norm(above(scene), later(scene), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace palace
