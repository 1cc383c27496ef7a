// The thesis's failure: a focal length computed with the arctangent, as equation 3.1 prints it
// (E1). The cameras are the thesis's (640 px, 45 degrees, 1 m), the ground is 50 ft below.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/navigation/monocular_position.h"
#include "engine/runtime/pipeline.h"
#include "tests/support/synthetic_stereo.h"

namespace palace {
namespace {

constexpr double kHeight_m = 15.24;
constexpr double kFov_rad = 0.785398163397448;
constexpr double kNadir_rad = -1.5707963267948966;

/// What the thesis prints: (W/2) / arctan(FoV/2), in radians.
double FocalAsPrinted(double width_px) { return width_px / 2 / std::atan(kFov_rad / 2); }

/// A camera never sees the same picture twice: equal ones would be a frozen camera.
ImageU8 WithNoise(ImageU8 image, RandomStream& random) {
  for (std::uint8_t& pixel : image.pixels()) {
    pixel = static_cast<std::uint8_t>(std::clamp(pixel + random.Normal(), 0.0, 255.0));
  }
  return image;
}

/// Hovers over level ground, seen by true cameras, with a rig file that claims `focal_px`.
std::shared_ptr<const EngineSnapshot> HoverWith(double focal_px, int frames) {
  const synthetic::Pair pair = synthetic::MakePair(synthetic::World{}, kHeight_m, kNadir_rad);
  auto rig = std::make_shared<StereoRig>();
  rig->left.pinhole = rig->right.pinhole = pair.camera;
  for (RigCamera* camera : {&rig->left, &rig->right}) {
    camera->pinhole.fx_px = camera->pinhole.fy_px = focal_px;
  }
  rig->baseline_m = pair.baseline_m;
  rig->tilt_rad = kNadir_rad;
  Pipeline pipeline(Settings{}, MissionOptions{});
  SessionStatus session;
  session.source.kind = SourceKind::kLive;
  std::shared_ptr<const EngineSnapshot> last;
  RandomStream random(3, "laser"), noise(3, "noise");
  for (int i = 0; i < frames; ++i) {
    auto bundle = std::make_shared<FrameBundle>();
    bundle->sequence = static_cast<std::uint64_t>(i) + 1;
    bundle->time = AddSeconds(Timestamp{1'000'000}, 0.1 * i);
    bundle->rig = rig;
    bundle->stereo = std::make_shared<StereoFrame>(
        StereoFrame{bundle->time, WithNoise(pair.left, noise), WithNoise(pair.right, noise)});
    VehiclePose pose;
    pose.time = bundle->time;
    pose.X_WB.p = {0, 0, -kHeight_m};
    bundle->pose_at_exposure = pose;
    bundle->poses = {pose};
    bundle->laser = {{bundle->time, kHeight_m + 0.03 * random.Normal()}};
    last = pipeline.Process(bundle, {}, session).snapshot;
  }
  return last;
}

const Alarm* FindAlarm(const EngineSnapshot& snapshot, AlarmId id) {
  for (const Alarm& alarm : snapshot.flight->mission.alarms) {
    if (alarm.kind == id && alarm.active) {
      return &alarm;
    }
  }
  return nullptr;
}

TEST(FocalLengthAsPrinted, IsTenPercentTooLong) {
  EXPECT_NEAR(FocalFromFieldOfView(640, kFov_rad), 772.548, 1e-3);
  EXPECT_NEAR(FocalAsPrinted(640), 855.165, 0.5);
  EXPECT_NEAR(FocalAsPrinted(640) / FocalFromFieldOfView(640, kFov_rad), 1.107, 0.001);
}

// Reference figures for 50 ft and 45 degrees: no error for a centred feature, 0.86 m at the side
// edge, 1.85 m at the top edge.
TEST(FocalLengthAsPrinted, MovesTheMonocularPositionAsTheErrataSay) {
  MonocularInput input;
  input.tilt_rad = -kFov_rad;
  input.laser_m = kHeight_m * std::sqrt(2.0);
  const auto error = [&](const Eigen::Vector2d& pixel) {
    input.pixel = pixel;
    input.focal_x_px = input.focal_y_px = FocalFromFieldOfView(640, kFov_rad);
    const Eigen::Vector3d right = PositionFromPixel(input).value().p_WC;
    input.focal_x_px = input.focal_y_px = FocalAsPrinted(640);
    return (PositionFromPixel(input).value().p_WC - right).norm();
  };
  EXPECT_NEAR(error({0, 0}), 0, 1e-9);
  EXPECT_NEAR(error({320, 0}), 0.86, 0.01);
  EXPECT_NEAR(error({0, -240}), 1.85, 0.01);
}

TEST(FocalLengthAsPrinted, StereoReadsTenPercentFarAndTheSelfCheckSaysSo) {
  const auto snapshot = HoverWith(FocalAsPrinted(640), 16);
  EXPECT_NEAR(snapshot->terrain->range_agreement.ratio, 1.107, 0.005);
  EXPECT_NEAR(snapshot->terrain->stereo_quality.median_depth_m, 1.107 * kHeight_m, 0.1);
  const Alarm* alarm = FindAlarm(*snapshot, AlarmId::kRangeScale);
  ASSERT_NE(alarm, nullptr);
  EXPECT_EQ(alarm->level, AlarmLevel::kCaution);
  EXPECT_NE(alarm->text.find("far against the laser"), std::string::npos) << alarm->text;
}

TEST(FocalLengthAsPrinted, TheRightFocalLengthRaisesNothing) {
  const auto snapshot = HoverWith(FocalFromFieldOfView(640, kFov_rad), 16);
  EXPECT_NEAR(snapshot->terrain->range_agreement.ratio, 1, 0.004);
  EXPECT_EQ(FindAlarm(*snapshot, AlarmId::kRangeScale), nullptr);
}

// What the check can see: 3 % is found, 1 % is left to calibration.
TEST(FocalLengthAsPrinted, ThreePercentIsFoundOnePercentIsTolerated) {
  const double right = FocalFromFieldOfView(640, kFov_rad);
  EXPECT_NE(FindAlarm(*HoverWith(1.03 * right, 16), AlarmId::kRangeScale), nullptr);
  EXPECT_NE(FindAlarm(*HoverWith(0.97 * right, 16), AlarmId::kRangeScale), nullptr);
  EXPECT_EQ(FindAlarm(*HoverWith(1.01 * right, 16), AlarmId::kRangeScale), nullptr);
}

}  // namespace
}  // namespace palace
