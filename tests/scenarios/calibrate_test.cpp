// palacectl calibrate as a person runs it: pictures on disk in, a rig that analyze takes out, and
// one message with exit 1 or 2 where that cannot be.
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/camera/files/rig_file.h"
#include "engine/simulation/calibration_session.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr double kLimit_s = 120;
constexpr std::uint64_t kSeed = 5;

class Calibrate : public Scenario {
 protected:
  void WriteTargetFile(int columns, int rows) {
    std::ostringstream text;
    text.precision(12);
    text << "[target]\nkind = \"dots\"\ncolumns = " << columns << "\nrows = " << rows
         << "\npitch_m = " << session_.target.pitch_m
         << "\ndot_diameter_m = " << session_.target.dot_diameter_m << "\n";
    WriteFile("TARGET.toml", text.str());
  }
  void WriteViews(int views) {
    session_ = MakeCalibrationSession(kSeed, views);
    WriteTargetFile(session_.target.columns, session_.target.rows);
    for (int v = 0; v < views; ++v) {
      for (const int side : {0, 1}) {
        ImageU8 picture = RenderSessionView(session_, kSeed, v, side);
        const std::string name = std::string(side == 0 ? "l" : "r") + std::to_string(v) + ".png";
        cv::imwrite((folder_ / name).string(),
                    cv::Mat(picture.height(), picture.width(), CV_8U, picture.pixels().data()));
      }
    }
  }
  ProcessResult Run(const std::string& left = "l*.png", const std::string& right = "r*.png") {
    return RunProcess(Palacectl({"calibrate", "--target", "TARGET.toml", "--left", left, "--right",
                                 right, "--out", "out"}),
                      kLimit_s);
  }
  void ExpectRefused(const ProcessResult& result, const std::vector<std::string>& said) {
    EXPECT_EQ(result.exit_code, 1) << result.out;
    for (const std::string& part : said) {
      EXPECT_NE(result.err.find(part), std::string::npos) << part << " is not in " << result.err;
    }
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }

  CalibrationSession session_;
};

TEST_F(Calibrate, WritesARigThatAnalyzeLoads) {
  WriteViews(9);
  const ProcessResult result = Run();
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  for (const char* name :
       {"left.cahvor", "right.cahvor", "RIG.toml", "calibration.json", "report.html"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / name)) << name;
  }
  const auto rig = LoadRigFile(folder_ / "out" / "RIG.toml");
  ASSERT_TRUE(rig.ok()) << rig.error().message;
  const double baseline_m = (session_.right.C - session_.left.C).norm();
  EXPECT_NEAR(rig->rig.baseline_m, baseline_m, 0.001 * baseline_m);
  EXPECT_NEAR(rig->rig.left.pinhole.fx_px, session_.left.A.cross(session_.left.H).norm(), 0.5);
  std::ifstream file(folder_ / "out" / "calibration.json");
  const nlohmann::json json = nlohmann::json::parse(file);
  EXPECT_EQ(json["parameters"].size(), 22u);
  EXPECT_EQ(json["views"].size(), 9u);
  EXPECT_LT(json["epipolar_row_rms_px"].get<double>(), 0.05);
  EXPECT_EQ(json["outliers"].get<int>(), 0);
  const ProcessResult analyzed =
      RunProcess(Palacectl({"analyze", "--left", "l0.png", "--right", "r0.png", "--rig",
                            "out/RIG.toml", "--out", "maps"}),
                 kLimit_s);
  EXPECT_EQ(analyzed.signal, 0);
  EXPECT_EQ(analyzed.exit_code, 0) << analyzed.err;
}

TEST_F(Calibrate, RefusesWithOneMessage) {
  WriteViews(4);
  ExpectRefused(Run("q*.png"), {"--left", "q*.png"});
  ExpectRefused(Run("l*.png", "r0.png"), {"4 left and 1 right"});
  ExpectRefused(Run("r*.png", "l*.png"), {"swapped"});
  ExpectRefused(Run("l*.png", "l*.png"), {"same picture", "l0.png"});
  WriteTargetFile(14, 11);
  ExpectRefused(Run(), {"8 of 8 pictures", "found 13 x 10 dots, the target has 14 x 11", "l0.png"});
  WriteTargetFile(13, 10);
  cv::imwrite((folder_ / "r2.png").string(), cv::Mat(96, 64, CV_8UC1, cv::Scalar(90)));
  ExpectRefused(Run(), {"r2.png has 64 x 96 px", "640 x 480"});
  WriteFile("r2.png", "this is no picture");
  ExpectRefused(Run(), {"r2.png"});
  WriteFile("TARGET.toml", "[target]\nkind = \"dots\"\ncolumns = -1\n");
  ExpectRefused(Run(), {"TARGET.toml:3", "-1"});
}

/// Exchanged pictures are outliers to the fit, whose figures then look good: exit 1 all the same.
TEST_F(Calibrate, ExchangedPicturesDoNotPass) {
  WriteViews(9);
  std::filesystem::rename(folder_ / "r3.png", folder_ / "r.png");
  std::filesystem::rename(folder_ / "r4.png", folder_ / "r3.png");
  std::filesystem::rename(folder_ / "r.png", folder_ / "r4.png");
  const ProcessResult result = Run();
  EXPECT_EQ(result.exit_code, 1) << result.out;
  for (const char* pair : {"FAILED: l3.png and r3.png", "FAILED: l4.png and r4.png"}) {
    EXPECT_NE(result.out.find(pair), std::string::npos) << result.out;
  }
  std::ifstream file(folder_ / "out" / "RIG.toml");
  std::string first_line;
  std::getline(file, first_line);
  EXPECT_EQ(first_line.rfind("# NOT PASSED", 0), 0u) << first_line;
  EXPECT_TRUE(LoadRigFile(folder_ / "out" / "RIG.toml").ok());
}

TEST_F(Calibrate, KeepsWhatIsThere) {
  WriteFile("out", "a file");
  const ProcessResult no_folder = Run();
  EXPECT_EQ(no_folder.exit_code, 1);
  EXPECT_NE(no_folder.err.find("is no folder"), std::string::npos) << no_folder.err;
  std::filesystem::remove(folder_ / "out");
  std::filesystem::create_directory(folder_ / "out");
  WriteFile("out/RIG.toml", "precious");
  const ProcessResult taken = Run();
  EXPECT_EQ(taken.exit_code, 2);
  EXPECT_NE(taken.err.find("out holds RIG.toml already"), std::string::npos) << taken.err;
}

TEST_F(Calibrate, BadUsageIsExitTwo) {
  EXPECT_EQ(RunProcess(Palacectl({"calibrate", "--out", "out"}), kLimit_s).exit_code, 2);
  EXPECT_EQ(RunProcess(Palacectl({"calibrate", "--target", "t", "--left", "l", "--right", "r",
                                  "--out", "out", "--hold-out-every", "1"}),
                       kLimit_s)
                .exit_code,
            2);
  EXPECT_EQ(RunProcess(Palacectl({"calibrate", "--wings", "2"}), kLimit_s).exit_code, 2);
  EXPECT_EQ(RunProcess(Palacectl({"calibrate", "--help"}), kLimit_s).exit_code, 0);
}

TEST_F(Calibrate, WritesTheSheetToPrint) {
  const ProcessResult result =
      RunProcess(Palacectl({"calibrate", "--write-target", "--out", "sheet"}), kLimit_s);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "sheet" / "target.svg"));
  const ProcessResult again = RunProcess(
      Palacectl({"calibrate", "--write-target", "--target", "sheet/TARGET.toml", "--out", "again"}),
      kLimit_s);
  EXPECT_EQ(again.exit_code, 0) << again.err;
}

}  // namespace
}  // namespace palace
