#include "engine/experiments/field_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/camera/pinhole.h"
#include "engine/core/random.h"
#include "engine/stereo/stereo.h"

namespace palace {
namespace {

PinholeCamera CameraOf(const HoverView& view) {
  return PinholeFromFov(view.width_px, view.height_px, view.field_of_view_rad);
}

RigidTransform RightOf(const RigidTransform& X_WC, double baseline_m) {
  return {X_WC.R, X_WC.p + X_WC.R.col(0) * baseline_m};
}

EulerAngles RandomAngles(RandomStream& random, double sigma_rad) {
  EulerAngles angles;
  angles.roll_rad = sigma_rad * random.Normal();
  angles.pitch_rad = sigma_rad * random.Normal();
  angles.yaw_rad = sigma_rad * random.Normal();
  return angles;
}

Eigen::Vector3d RandomShift(RandomStream& random, double sigma_m) {
  const double north = random.Normal(), east = random.Normal(), down = random.Normal();
  return sigma_m * Eigen::Vector3d(north, east, down);
}

/// The pose navigation reports: attitude off in the body's axes, position off in W.
RigidTransform BelievedPose(const RigidTransform& X_WC, const HoverView& view,
                            RandomStream& random) {
  const Eigen::Matrix3d R_BC = CameraRotationFromTilt(view.tilt_rad);
  const Eigen::Matrix3d off = RotationFromEuler(RandomAngles(random, view.attitude_error_rad));
  const Eigen::Matrix3d R_WB = X_WC.R * R_BC.transpose();
  return {R_WB * off * R_BC, X_WC.p + RandomShift(random, view.position_error_m)};
}

}  // namespace

std::vector<RigidTransform> HoverPoses(const HoverView& view, std::uint64_t seed) {
  RandomStream random(seed, "hover");
  std::vector<RigidTransform> poses;
  for (int i = 0; i < view.frames; ++i) {
    EulerAngles attitude = RandomAngles(random, view.attitude_motion_rad);
    attitude.yaw_rad += view.heading_rad;
    Eigen::Vector3d drift = RandomShift(random, view.drift_m);
    drift.z() /= 2;
    poses.push_back({RotationFromEuler(attitude) * CameraRotationFromTilt(view.tilt_rad),
                     Eigen::Vector3d(view.north_m, view.east_m, -view.height_m) + drift});
  }
  return poses;
}

BakedGround BakeForHover(const World& world, const HoverView& view,
                         const std::vector<RigidTransform>& X_WCs) {
  std::vector<RigidTransform> both = X_WCs;
  for (const RigidTransform& X_WC : X_WCs) {
    both.push_back(RightOf(X_WC, view.baseline_m));
  }
  return BakeFor(world, CameraOf(view), both);
}

Result<std::vector<FieldFrame>> LookFromHover(const HoverView& view, const PinholeCamera& camera,
                                              const TakePicture& take,
                                              const StereoSettings& settings, std::uint64_t seed) {
  const std::vector<RigidTransform> poses = HoverPoses(view, seed);
  RandomStream navigation(seed, "pose errors");
  StereoMatcher matcher;
  std::vector<FieldFrame> frames;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    FieldFrame frame;
    frame.X_WC_true = poses[i];
    const double time_s = static_cast<double>(i) * view.frame_interval_s;
    SceneView& seen = frame.input.view;
    for (const bool right : {false, true}) {
      Result<ImageU8> picture =
          take(right ? RightOf(poses[i], view.baseline_m) : poses[i], right, time_s);
      if (!picture) {
        return picture.error();
      }
      (right ? seen.right : seen.left) =
          std::make_shared<const ImageU8>(std::move(picture).value());
    }
    const ViewPose believed{BelievedPose(poses[i], view, navigation)};
    frame.input.p_WB = believed.X_WC.p;
    const DisparityWindow window = PredictWindow(camera, view.baseline_m, believed.X_WC,
                                                 view.ground_height_m, kTallestObject_m, settings);
    Result<StereoResult> stereo = matcher.Match(*seen.left, *seen.right, camera, view.baseline_m,
                                                window, settings, AddSeconds({}, time_s));
    if (!stereo) {
      return stereo.error();
    }
    stereo->range.pose = believed;
    seen.range = std::make_shared<const RangeMap>(std::move(stereo->range));
    frames.push_back(std::move(frame));
  }
  return frames;
}

Result<std::vector<FieldFrame>> LookAtField(const World& world, const HoverView& view,
                                            const StereoSettings& settings, std::uint64_t seed,
                                            const BakedGround* ground) {
  const PinholeCamera camera = CameraOf(view);
  const BakedGround own = ground == nullptr ? BakeForHover(world, view, HoverPoses(view, seed))
                                            : BakedGround({}, 0, {}, 1);
  const BakedGround& baked = ground == nullptr ? own : *ground;
  RandomStream sensor(seed, "sensor seeds");
  World now = world;
  const auto take = [&](const RigidTransform& X_WCamera, bool right, double time_s) {
    if (!right) {
      now = WorldAt(world, time_s);
    }
    return Expose(DrawGrey(now, camera, X_WCamera, baked), Exposure{view.noise_grey},
                  sensor.NextBits());
  };
  return LookFromHover(view, camera, take, settings, seed);
}

Slad MapOfField(const std::vector<FieldFrame>& frames, const SladSettings& settings, int count) {
  Slad slad;
  const std::size_t used =
      count > 0 ? std::min(frames.size(), static_cast<std::size_t>(count)) : frames.size();
  PALACE_CHECK(used > 0);
  for (std::size_t i = 0; i < used; ++i) {
    slad.Add(frames[i].input, settings);
  }
  return slad;
}

std::shared_ptr<const TerrainDecision> DecideOnField(const std::vector<FieldFrame>& frames,
                                                     const Settings& settings, int count) {
  return MapOfField(frames, settings.slad, count).Decide(settings, Letters::kOfRecord);
}

}  // namespace palace
