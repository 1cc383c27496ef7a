// A session written in EuRoC's layout reads back as it was. The whole way, from the simulator on:
// tests/scenarios/euroc_test.cpp.
#include "engine/capture/euroc/euroc_writer.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/capture/euroc/euroc_folder.h"
#include "engine/capture/image_folder_source.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr int kSide_px = 48;
constexpr int kPairs = 4;

StereoRig SampleRig(bool with_lens) {
  StereoRig rig;
  rig.left.pinhole = rig.right.pinhole = {kSide_px, kSide_px, 57.9411254969543, 57.9, 23.5, 23.5};
  rig.baseline_m = 0.75;
  rig.tilt_rad = -Rad(45);
  rig.position_body_m = {0.8, -0.5, 0.3};
  rig.rate_hz = 10;
  if (with_lens) {
    rig.rectified = false;
    rig.left.distortion = {-0.1, 0.02, 0.001, -0.002, 0};
    rig.right.distortion = {-0.11, 0.02, 0.001, -0.002, 0};
    rig.right.pinhole.cx_px = 22;
  }
  return rig;
}

FrameBundle SampleBundle(RandomStream& random, int index) {
  FrameBundle bundle;
  bundle.time = AddSeconds({1'000'000'000'000}, 0.1 * (index + 1));
  auto frame = std::make_shared<StereoFrame>();
  frame->time = bundle.time;
  for (ImageU8* image : {&frame->left, &frame->right}) {
    *image = ImageU8(kSide_px, kSide_px);
    for (std::uint8_t& pixel : image->pixels()) {
      pixel = static_cast<std::uint8_t>(random.Index(256));
    }
  }
  bundle.stereo = frame;
  for (int k = 4; k >= 0; --k) {
    const Timestamp time = AddSeconds(bundle.time, -0.02 * k);
    Truth truth;
    truth.time = time;
    const double roll = random.Uniform(-3, 3), pitch = random.Uniform(-1, 1),
                 yaw = random.Uniform(-3, 3);
    truth.X_WB.R = RotationFromEuler({roll, pitch, yaw});
    truth.X_WB.p = {random.Uniform(-500, 500), 3.25, -15.24};
    truth.v_WB = {1, 2, random.Normal()};
    bundle.truth.push_back(truth);
    ImuSample sample;
    sample.time = time;
    sample.specific_force_B = {0.1, random.Normal(), -9.8};
    sample.angular_rate_B = {random.Normal(), 0, 0.01};
    bundle.imu.push_back(sample);
    VehiclePose pose;
    pose.time = time;
    pose.X_WB = truth.X_WB;
    bundle.poses.push_back(pose);
  }
  return bundle;
}

class EurocWriterTest : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override { std::filesystem::remove_all(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::vector<FrameBundle> WriteSample(const StereoRig& rig) {
    RandomStream random(1602);
    std::vector<FrameBundle> bundles;
    auto writer = EurocWriter::Create(folder_, rig, {}, "a sample");
    EXPECT_TRUE(writer.ok()) << writer.error().message;
    ImageF depth_m(kSide_px, kSide_px, 12.3456F);
    depth_m.at(0, 0) = NAN;
    depth_m.at(1, 0) = 65.6F;
    depth_m.at(2, 0) = 65.535F;
    for (int k = 0; k < kPairs; ++k) {
      bundles.push_back(SampleBundle(random, k));
      const Status added = (*writer)->Add(bundles.back(), &depth_m);
      EXPECT_TRUE(added.ok()) << added.error().message;
    }
    EXPECT_TRUE((*writer)->Close().ok());
    EXPECT_EQ((*writer)->pairs(), std::uint64_t{kPairs});
    return bundles;
  }
  const std::filesystem::path folder_ = OwnPath();
};

TEST_P(EurocWriterTest, WhatWasWrittenReadsBack) {
  const StereoRig rig = SampleRig(GetParam());
  const std::vector<FrameBundle> bundles = WriteSample(rig);
  const auto folder = LoadEurocFolder(folder_);
  ASSERT_TRUE(folder.ok()) << folder.error().message;
  EXPECT_EQ(folder->left_out, "");
  const StereoRig& again = folder->rig.rig;
  EXPECT_EQ(again.rectified, rig.rectified);
  EXPECT_EQ(again.left.pinhole.width, kSide_px);
  for (const auto& [is, was] : {std::pair(&again.left, &rig.left), {&again.right, &rig.right}}) {
    if (!GetParam()) {
      EXPECT_EQ(is->pinhole, was->pinhole);
      continue;
    }
    ASSERT_TRUE(is->model.has_value());
    const auto& model = std::get<OpenCvModel>(is->model->lens);
    EXPECT_EQ(model.pinhole, was->pinhole);
    EXPECT_TRUE(std::equal(was->distortion.begin(), was->distortion.end(), model.k.begin()));
  }
  EXPECT_NEAR(again.baseline_m, rig.baseline_m, 1e-12);
  EXPECT_NEAR(again.tilt_rad, rig.tilt_rad, 1e-12);
  EXPECT_LT((again.position_body_m - rig.position_body_m).norm(), 1e-12);
  EXPECT_NEAR(again.rate_hz, rig.rate_hz, 1e-9);

  auto source = ImageFolderSource::Open(folder_, false);
  ASSERT_TRUE(source.ok()) << source.error().message;
  (*source)->Control({PlaybackControl::Kind::kSpeed, 0});
  for (int k = 0; k < kPairs; ++k) {
    const FrameBundle& was = bundles[static_cast<std::size_t>(k)];
    const auto is = (*source)->Next({});
    ASSERT_TRUE(is.ok()) << is.error().message;
    EXPECT_EQ((*is)->stereo->left.pixels(), was.stereo->left.pixels());
    EXPECT_EQ((*is)->stereo->right.pixels(), was.stereo->right.pixels());
    const RigidTransform& X = (*is)->pose_at_exposure->X_WB;
    EXPECT_LT((X.p - was.truth.back().X_WB.p).norm(), 1e-9);
    EXPECT_LT((X.R - was.truth.back().X_WB.R).norm(), 1e-9);
    EXPECT_LT(((*is)->pose_at_exposure->v_WB - was.truth.back().v_WB).norm(), 1e-12);
  }
  const auto imu = LoadEurocImu(*folder);
  ASSERT_TRUE(imu.ok());
  ASSERT_EQ(imu->size(), std::size_t{5 * kPairs});
  EXPECT_LT(((*imu)[7].specific_force_B - bundles[1].imu[2].specific_force_B).norm(), 1e-12);
  EXPECT_LT(((*imu)[7].angular_rate_B - bundles[1].imu[2].angular_rate_B).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Lenses, EurocWriterTest, testing::Bool(), [](const auto& with_lens) {
  return std::string(with_lens.param ? "Distorted" : "Ideal");
});

using EurocWriterFiles = EurocWriterTest;

TEST_F(EurocWriterFiles, DepthIsInMillimetresAndZeroWhereUnknown) {
  WriteSample(SampleRig(false));
  const cv::Mat depth =
      cv::imread((folder_ / "mav0/cam0/depth/1000000100000000.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(depth.type(), CV_16UC1);
  EXPECT_EQ(depth.at<std::uint16_t>(5, 5), 12346);
  EXPECT_EQ(depth.at<std::uint16_t>(0, 0), 0) << "nothing";
  EXPECT_EQ(depth.at<std::uint16_t>(0, 1), 0) << "beyond 65.535 m";
  EXPECT_EQ(depth.at<std::uint16_t>(0, 2), 65535);
}

TEST_F(EurocWriterFiles, NothingIsWrittenOver) {
  WriteSample(SampleRig(false));
  const auto again = EurocWriter::Create(folder_, SampleRig(false), {}, "");
  ASSERT_FALSE(again.ok());
  EXPECT_EQ(again.error().code, ErrorCode::kUsage);
  EXPECT_NE(again.error().message.find("there is one already"), std::string::npos);
}

TEST_F(EurocWriterFiles, ALensThatTheFormatCannotHoldIsRefusedBeforeAnythingIsWritten) {
  StereoRig rig = SampleRig(true);
  rig.left.distortion[4] = 0.1;
  const auto writer = EurocWriter::Create(folder_, rig, {}, "");
  ASSERT_FALSE(writer.ok());
  EXPECT_NE(writer.error().message.find("OpenCV 5 camera: its lenses have 4 terms"),
            std::string::npos)
      << writer.error().message;
  EXPECT_FALSE(std::filesystem::exists(folder_));
}

}  // namespace
}  // namespace palace
