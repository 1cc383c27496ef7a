// A few bundles with one of everything, for tests of faults.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "engine/core/random.h"
#include "engine/model/frame_bundle.h"
#include "engine/runtime/source.h"
#include "engine/world/scene_library.h"

namespace palace {

inline constexpr Timestamp kFlightStart{1'000'000'000};

inline ImageU8 NoisePicture(RandomStream& random) {
  ImageU8 picture(32, 24);
  for (std::uint8_t& grey : picture.pixels()) {
    grey = static_cast<std::uint8_t>(20 + random.Index(40));
  }
  return picture;
}

/// Bundle `i` of a flight at 10 Hz: five poses that turn, two ranges, a fix, a status, a pair.
inline FrameBundle BundleOfEverything(int i) {
  RandomStream random(static_cast<std::uint64_t>(i) + 1, "pictures");
  FrameBundle bundle;
  bundle.sequence = static_cast<std::uint64_t>(i) + 1;
  bundle.time = AddSeconds(kFlightStart, 0.1 * i);
  bundle.rig = std::make_shared<const StereoRig>(DefaultRig());
  bundle.stereo = std::make_shared<const StereoFrame>(
      StereoFrame{bundle.time, NoisePicture(random), NoisePicture(random)});
  for (int k = 4; k >= 0; --k) {
    VehiclePose pose;
    pose.time = AddSeconds(bundle.time, -0.02 * k);
    const double angle = 0.5 * SecondsBetween(kFlightStart, pose.time);
    pose.X_WB.R = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.X_WB.p = Eigen::Vector3d(0.1 * i, 0, -15);
    pose.angular_rate_B = {0, 0, 0.5};
    bundle.poses.push_back(pose);
    ImuSample imu;
    imu.time = pose.time;
    imu.angular_rate_B = pose.angular_rate_B;
    bundle.imu.push_back(imu);
    Truth truth;
    truth.time = pose.time;
    truth.X_WB = pose.X_WB;
    bundle.truth.push_back(truth);
  }
  bundle.pose_at_exposure = bundle.poses.back();
  bundle.laser.push_back({AddSeconds(bundle.time, -0.05), 15 + 0.01 * i});
  bundle.laser.push_back({bundle.time, 15.005 + 0.01 * i});
  GpsFix fix;
  fix.time = AddSeconds(bundle.time, -0.05);
  fix.p_WB = bundle.poses.back().X_WB.p;
  fix.sigma_horizontal_m = fix.sigma_vertical_m = 0.02;
  bundle.gps.push_back(fix);
  VehicleStatus status;
  status.time = bundle.time;
  status.boot_id = 77;
  status.mode = VehicleMode::kDescend;
  status.approval_id = 5;
  bundle.status = status;
  return bundle;
}

/// `count` of them, then the end.
class BundlesOfEverything final : public Source {
 public:
  explicit BundlesOfEverything(int count) : count_(count) {}
  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token) override {
    if (next_ >= count_) {
      return Error{ErrorCode::kEnd, "over"};
    }
    return std::shared_ptr<const FrameBundle>(
        std::make_shared<const FrameBundle>(BundleOfEverything(next_++)));
  }
  bool IsLockstep() const override { return true; }
  SourceStatus Status() const override { return {}; }
  void Control(const PlaybackControl&) override {}

 private:
  int count_;
  int next_ = 0;
};

}  // namespace palace
