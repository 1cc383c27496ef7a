// Other people's layout, both ways: a simulated session exported, read back, analysed, shown and
// imported as a log.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/capture/euroc/euroc_folder.h"
#include "engine/capture/euroc/euroc_tables.h"
#include "engine/capture/image_folder_source.h"
#include "engine/world/scene_library.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

class Euroc : public Scenario {
 protected:
  ProcessResult Export(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"simulate",   "--scenario", "cones",    "--seed", "3",
                                          "--wind-mps", "3",          "--export", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProcess(Palacectl(arguments), 300);
  }
};

/// Bundles with pictures of a log, in order.
std::vector<std::shared_ptr<const FrameBundle>> PairsOf(const std::filesystem::path& log) {
  ReplayOptions options;
  options.speed = 0;
  std::vector<std::shared_ptr<const FrameBundle>> pairs;
  auto source = ReplaySource::Open(log, options);
  EXPECT_TRUE(source.ok()) << source.error().message;
  while (source.ok()) {
    const auto bundle = (*source)->Next({});
    if (!bundle) {
      break;
    }
    if ((*bundle)->stereo) {
      pairs.push_back(*bundle);
    }
  }
  return pairs;
}

TEST_F(Euroc, AnExportedSessionReadsBackAsItWas) {
  const ProcessResult exported = Export({"--duration-s", "0.5", "--log", "flight.lcm"});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_NE(exported.out.find("5 pairs exported"), std::string::npos) << exported.out;
  const auto flown = PairsOf(folder_ / "flight.lcm");
  ASSERT_EQ(flown.size(), 5u);
  const auto folder = LoadEurocFolder(folder_ / "out");
  ASSERT_TRUE(folder.ok()) << folder.error().message;
  const StereoRig rig = DefaultRig(), again = folder->rig.rig;
  EXPECT_TRUE(again.rectified);
  EXPECT_EQ(again.left.pinhole, rig.left.pinhole);
  EXPECT_EQ(again.right.pinhole, rig.right.pinhole);
  EXPECT_NEAR(again.baseline_m, rig.baseline_m, 1e-12);
  EXPECT_NEAR(again.tilt_rad, rig.tilt_rad, 1e-12);
  EXPECT_LT((again.position_body_m - rig.position_body_m).norm(), 1e-12);
  auto source = ImageFolderSource::Open(folder_ / "out", false);
  ASSERT_TRUE(source.ok()) << source.error().message;
  (*source)->Control({PlaybackControl::Kind::kSpeed, 0});
  for (const auto& was : flown) {
    const auto is = (*source)->Next({});
    ASSERT_TRUE(is.ok()) << is.error().message;
    EXPECT_EQ((*is)->stereo->left.pixels(), was->stereo->left.pixels());
    EXPECT_EQ((*is)->stereo->right.pixels(), was->stereo->right.pixels());
    ASSERT_FALSE(was->truth.empty());
    EXPECT_EQ(was->truth.back().time, was->stereo->time);
    const RigidTransform& X = (*is)->pose_at_exposure->X_WB;
    EXPECT_LT((X.p - was->truth.back().X_WB.p).norm(), 1e-9);
    EXPECT_LT((X.R - was->truth.back().X_WB.R).norm(), 1e-9);
  }
  const auto imu = LoadEurocImu(*folder);
  ASSERT_TRUE(imu.ok()) << imu.error().message;
  EXPECT_EQ(imu->size(), 50u);
}

/// Where the depth says that a pixel of the left picture lies, the right one shows the same grey.
TEST_F(Euroc, TheDepthFitsThePictures) {
  ASSERT_EQ(Export({"--duration-s", "0.1"}).exit_code, 0);
  const std::string name = "1000000100000000.png", mav0 = (folder_ / "out/mav0").string();
  const cv::Mat left = cv::imread(mav0 + "/cam0/data/" + name, cv::IMREAD_UNCHANGED);
  const cv::Mat right = cv::imread(mav0 + "/cam1/data/" + name, cv::IMREAD_UNCHANGED);
  const cv::Mat depth = cv::imread(mav0 + "/cam0/depth/" + name, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(depth.size(), left.size());
  const StereoRig rig = DefaultRig();
  const auto median_difference = [&](double depth_share) {
    std::vector<double> differences;
    for (int y = 0; y < left.rows; y += 3) {
      for (int x = 100; x < left.cols; x += 3) {
        const double depth_m = depth.at<std::uint16_t>(y, x) * 1e-3 * depth_share;
        const double at = x - rig.left.pinhole.fx_px * rig.baseline_m / depth_m;
        const int column = static_cast<int>(std::floor(at));
        if (depth_m > 0 && column >= 0 && column + 1 < left.cols) {
          const double grey = (column + 1 - at) * right.at<std::uint8_t>(y, column) +
                              (at - column) * right.at<std::uint8_t>(y, column + 1);
          differences.push_back(std::abs(grey - left.at<std::uint8_t>(y, x)));
        }
      }
    }
    EXPECT_GT(differences.size(), 10000u);
    std::nth_element(differences.begin(), differences.begin() + differences.size() / 2,
                     differences.end());
    return differences[differences.size() / 2];
  };
  EXPECT_LT(median_difference(1), 3) << "the noise of two pictures";
  EXPECT_GT(median_difference(0.97), 2 * median_difference(1)) << "1.5 px beside";
}

TEST_F(Euroc, IsAnalysedShownAndImported) {
  ASSERT_EQ(Export({"--duration-s", "0.5"}).exit_code, 0);
  const ProcessResult analysed =
      RunProcess(Palacectl({"analyze", "--euroc", "out", "--out", "maps"}), 120);
  ASSERT_EQ(analysed.exit_code, 0) << analysed.err;
  std::ifstream file(folder_ / "maps/site.json");
  EXPECT_EQ(nlohmann::json::parse(file, nullptr, false)["status"], "found") << analysed.out;

  const ProcessResult imported =
      RunProcess(Palacectl({"log", "import", "out", "--out", "out.lcm"}), 60);
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_NE(imported.out.find("5 pairs, 41 IMU samples"), std::string::npos) << imported.out;
  const auto pairs = PairsOf(folder_ / "out.lcm");
  ASSERT_EQ(pairs.size(), 5u);
  auto source = ImageFolderSource::Open(folder_ / "out", false);
  ASSERT_TRUE(source.ok());
  (*source)->Control({PlaybackControl::Kind::kSpeed, 0});
  for (const auto& pair : pairs) {
    const auto picture = (*source)->Next({});
    ASSERT_TRUE(picture.ok());
    EXPECT_EQ(pair->stereo->left.pixels(), (*picture)->stereo->left.pixels());
    EXPECT_EQ(pair->pose_at_exposure->X_WB.p, (*picture)->pose_at_exposure->X_WB.p);
    EXPECT_EQ(pair->rig->left.pinhole, DefaultRig().left.pinhole);
  }
  EXPECT_EQ(pairs[3]->imu.size(), 10u);
  EXPECT_EQ(RunProcess(Palacectl({"log", "verify", "out.lcm"}), 60).exit_code, 0);
  EXPECT_EQ(RunProcess(Palacectl({"log", "import", "out", "--out", "out.lcm"}), 60).exit_code, 1)
      << "no log is written over";

  WriteFile("look.script", "wait state PROPOSED 20\nexpect text mode IMAGES\nquit\n");
  const ProcessResult shown = RunProcess(
      Palace({"--headless", "--images", "out", "--script", "look.script", "--record", "rec"}), 120);
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
}

TEST_F(Euroc, WhatImportLeavesOutIsSaidAndTold) {
  ASSERT_EQ(Export({"--duration-s", "0.3"}).exit_code, 0);
  std::filesystem::remove(folder_ / "out/mav0/cam1/data/1000000200000000.png");
  const ProcessResult imported =
      RunProcess(Palacectl({"log", "import", "out/mav0", "--out", "out.lcm"}), 60);
  EXPECT_EQ(imported.exit_code, 3) << imported.err;
  EXPECT_NE(imported.out.find("left out: 1 pair is named but not there"), std::string::npos)
      << imported.out;
  WriteFile("out/mav0/cam0/data/1000000300000000.png", "cut");
  const ProcessResult broken =
      RunProcess(Palacectl({"log", "import", "out", "--out", "broken.lcm"}), 60);
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_NE(broken.err.find("1000000300000000.png"), std::string::npos) << broken.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "broken.lcm")) << "no half recording stays";
}

/// That missions end on the ground: mission_test.cpp. Here, that the exported one is flown.
TEST_F(Euroc, AMissionIsExportedAsItDescends) {
  const ProcessResult exported = RunProcess(
      Palacectl({"simulate", "--seed", "1", "--export", "out", "--land", "--duration-s", "16"}),
      600);
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_NE(exported.out.find("160 pairs exported"), std::string::npos) << exported.out;
  const auto states = ReadEurocStates(folder_ / "out/mav0/state_groundtruth_estimate0/data.csv");
  ASSERT_TRUE(states.ok()) << states.error().message;
  EXPECT_NEAR(states->front().X_RI.p.z(), 15.24, 0.2) << "z is up";
  EXPECT_LT(states->back().X_RI.p.z(), states->front().X_RI.p.z() - 0.5);
  EXPECT_LT(states->back().v_RI.z(), -0.1);
}

TEST_F(Euroc, WhatDoesNotGoTogetherIsBadUsage) {
  const std::vector<std::vector<std::string>> rows = {
      {"simulate", "--land"},
      {"simulate", "--export", "out", "--no-pictures"},
      {"simulate", "--export", "out", "--land", "--log", "a.lcm"},
      {"simulate", "--export", "out", "--key", "k"},
      {"analyze", "--euroc", "out", "--points", "a.xyz", "--out", "maps"},
      {"analyze", "--euroc", "out", "--poses", "a.csv", "--out", "maps"}};
  for (const std::vector<std::string>& row : rows) {
    const ProcessResult result = RunProcess(Palacectl(row), 20);
    EXPECT_EQ(result.exit_code, 2) << row.back() << ": " << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  std::filesystem::create_directories(folder_ / "out/mav0");
  const ProcessResult taken = Export({"--duration-s", "0.1"});
  EXPECT_EQ(taken.exit_code, 2) << taken.err;
  EXPECT_NE(taken.err.find("there is one already"), std::string::npos) << taken.err;
}

}  // namespace
}  // namespace palace
