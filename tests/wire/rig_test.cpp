// CAMERA_RIG: what no rig can be, and whose it is.
#include <gtest/gtest.h>

#include "engine/wire/bundle_assembler.h"
#include "engine/wire/sensor_messages.h"
#include "tests/wire/wire_samples.h"

namespace palace {
namespace {

WireMessage RigMessageOf(const StereoRig& rig, const std::string& sender, Timestamp time) {
  FrameBundle bundle;
  bundle.time = time;
  bundle.rig = std::make_shared<const StereoRig>(rig);
  WireMessage message = EncodeBundle(bundle, {}).back();
  EXPECT_EQ(message.channel, ChannelNames{}.camera_rig);
  message.sender = sender;
  return message;
}

// Rectification and stereo take memory and divide by what a rig tells.
TEST(CameraRig, RigsThatCannotBeAreRefused) {
  RandomStream random(40);
  const StereoRig good = RandomRig(random);
  struct Row {
    const char* why;
    void (*change)(StereoRig&);
  };
  const Row rows[] = {
      {"pictures of 30000 x 30000 px",
       [](StereoRig& r) { r.left.pinhole.width = r.left.pinhole.height = 30000; }},
      {"pictures of 64 x 1 px",
       [](StereoRig& r) { r.right.pinhole.width = 64, r.right.pinhole.height = 1; }},
      {"pictures of 8192 x 8192 px",
       [](StereoRig& r) { r.left.pinhole.width = r.left.pinhole.height = 8192; }},
      {"pictures of -32 x 36 px", [](StereoRig& r) { r.left.pinhole.width = -32; }},
      {"pictures of 60000 x 36 px",
       [](StereoRig& r) { std::get<OpenCvModel>(r.left.model->lens).pinhole.width = 60000; }},
      {"pictures of 32 x 60000 px",
       [](StereoRig& r) { std::get<CahvorModel>(r.right.model->lens).height = 60000; }},
      {"a mirrored camera model",
       [](StereoRig& r) {
         auto& model = std::get<CahvorModel>(r.right.model->lens);
         model.V = -model.V;
       }},
      {"a focal length of 1e-200 px", [](StereoRig& r) { r.left.pinhole.fx_px = 1e-200; }},
      {"a focal length of -500 px", [](StereoRig& r) { r.right.pinhole.fy_px = -500; }},
      {"a principal point at 1e+09 px", [](StereoRig& r) { r.left.pinhole.cx_px = 1e9; }},
      {"a distortion coefficient of 1e+30", [](StereoRig& r) { r.left.distortion[4] = 1e30; }},
      {"a baseline of 1e-200 m", [](StereoRig& r) { r.baseline_m = 1e-200; }},
      {"a baseline of -1 m", [](StereoRig& r) { r.baseline_m = -1; }},
      {"a tilt of 57.3 deg", [](StereoRig& r) { r.tilt_rad = 1; }},
      {"a camera more than 100 m", [](StereoRig& r) { r.position_body_m.y() = 1e12; }},
      {"a rate of 0 Hz", [](StereoRig& r) { r.rate_hz = 0; }},
      {"disparities from 4000 px", [](StereoRig& r) { r.min_disparity_px = 4000; }},
      {"1000000 disparities", [](StereoRig& r) { r.num_disparities = 1000000; }},
      {"17 disparities", [](StereoRig& r) { r.num_disparities = 17; }}};
  EXPECT_TRUE(RigFromWire(RigMessageOf(good, "", {1})).ok());
  for (const Row& row : rows) {
    StereoRig rig = good;
    row.change(rig);
    const auto read = RigFromWire(RigMessageOf(rig, "", {1}));
    ASSERT_FALSE(read.ok()) << row.why;
    EXPECT_NE(read.error().message.find(row.why), std::string::npos) << read.error().message;
  }
}

// A rig decides where a picture's ground is: in flight nobody else gives another.
TEST(BundleAssembler, ARigBelongsToItsSenderForTheFlight) {
  RandomStream random(41);
  const StereoRig first = RandomRig(random), second = RandomRig(random);
  BundleAssembler assembler;
  assembler.Push(RigMessageOf(first, "10.0.0.2:7001", {1'000'000}));
  assembler.Push(RigMessageOf(second, "10.0.0.9:6666", {2'000'000}));
  EXPECT_NE(assembler.problem().find("of another sender"), std::string::npos);
  EXPECT_TRUE(SameRig(*assembler.rig(), first));
  // A vehicle's program that was started anew speaks from another port, of the same rig.
  assembler.Push(RigMessageOf(first, "10.0.0.2:7002", {3'000'000}));
  EXPECT_EQ(assembler.problem(), "");
  assembler.Push(RigMessageOf(second, "10.0.0.2:7001", {4'000'000}));
  EXPECT_TRUE(SameRig(*assembler.rig(), second));
}

}  // namespace
}  // namespace palace
