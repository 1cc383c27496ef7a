// What a vehicle sends to the navigator while it flies Flight: poses, IMU, GPS, laser, tracks.
#pragma once

#include <gtest/gtest.h>

#include "engine/navigation/navigator.h"
#include "engine/tracking/view_geometry.h"
#include "tests/navigation/flight.h"

namespace palace {

inline const PinholeCamera kCamera{640, 480, 772.548, 772.548, 319.5, 239.5};
inline Timestamp At(double t) { return AddSeconds({}, t); }

/// A vehicle that flies Flight and sends what a real one would, ten bundles a second.
class NavigatorWorld {
 public:
  explicit NavigatorWorld(std::uint64_t seed) : random_(seed) {
    rig_.position_body_m = {0.6, -0.5, 0.2};
    for (int i = 0; i < 3000; ++i) {
      ground_.push_back({random_.Uniform(-30, 30), random_.Uniform(-30, 30), 0});
    }
  }

  Flight flight;
  bool with_gps = true;
  bool with_imu = true;
  bool with_pose_stream = true;
  double picture_delay_s = 0.05;  ///< exposure before the end of the bundle
  Eigen::Vector3d gps_bias{1.5, -1.0, 0.8};

  /// Bundle number n covers (0.1 (n-1), 0.1 n].
  FrameBundle Bundle(int n) {
    FrameBundle bundle;
    bundle.sequence = static_cast<std::uint64_t>(n);
    bundle.time = At(0.1 * n);
    for (int k = 1; k <= 10; ++k) {
      const double t = 0.1 * (n - 1) + 0.01 * k;
      if (with_imu) {
        const Eigen::Vector3d force = flight.SpecificForce(t) + Eigen::Vector3d(0.04, -0.03, 0.05);
        ImuSample sample;
        sample.time = At(t);
        sample.specific_force_B = force + NormalVector(random_, 0.05);
        bundle.imu.push_back(sample);
      }
      if (with_pose_stream) {
        bundle.poses.push_back(AutopilotPose(t));
      }
    }
    if (with_gps && n % 2 == 0) {
      const double t = 0.1 * n - 0.08;  // GPS is late
      GpsFix fix;
      fix.time = At(t);
      fix.p_WB = flight.Position(t) + gps_bias + NormalVector(random_, 0.2);
      fix.v_WB = flight.Velocity(t) + NormalVector(random_, 0.05);
      fix.sigma_horizontal_m = 1.5;
      fix.sigma_vertical_m = 2.5;
      bundle.gps.push_back(fix);
    }
    const double exposure = Exposure(n);
    bundle.pose_at_exposure = AutopilotPose(exposure);
    const RigidTransform X_WC = Camera(exposure);
    bundle.laser.push_back({At(exposure), -X_WC.p.z() / X_WC.R(2, 2)});
    return bundle;
  }

  double Exposure(int n) const { return 0.1 * n - picture_delay_s; }

  TrackResult Track(int n) {
    TrackResult track;
    track.time = At(Exposure(n));
    track.status.locked = true;
    track.status.coherence = 0.95;
    const RigidTransform X_WC = Camera(Exposure(n));
    for (const Eigen::Vector3d& p_WF : ground_) {
      AddLandmark(X_WC, p_WF, 0.004 * (p_WF - X_WC.p).norm(), track);
    }
    return track;
  }

  TrackResult TrackSiteOnly(int n) {
    TrackResult track;
    track.time = At(Exposure(n));
    track.status.locked = true;
    track.status.coherence = 0.95;
    AddLandmark(Camera(Exposure(n)), Eigen::Vector3d::Zero(), 0, track);
    return track;
  }

  const StereoRig& rig() const { return rig_; }
  RigidTransform Camera(double t) const {
    return RigidTransform{flight.Attitude(t), flight.Position(t)} * rig_.X_BC();
  }

 private:
  VehiclePose AutopilotPose(double t) const {
    VehiclePose pose = flight.Pose(t);
    pose.X_WB.p += gps_bias;
    // The AHRS is a little wrong, slowly.
    pose.X_WB.R =
        RotationFromEuler({Rad(0.15), Rad(-0.1 + 0.05 * std::sin(0.2 * t)), 0}) * pose.X_WB.R;
    return pose;
  }
  void AddLandmark(const RigidTransform& X_WC, const Eigen::Vector3d& p_WF, double sigma_w,
                   TrackResult& track) {
    const auto pixel = PixelFromWorldPoint(kCamera, X_WC, p_WF);
    if (pixel && InPicture(kCamera, *pixel, 2) && track.landmarks.size() < 100) {
      const Eigen::Vector2d noise(0.3 * random_.Normal(), 0.3 * random_.Normal());
      track.landmarks.push_back({p_WF, *pixel + noise, 0.3, 0.2 * sigma_w});
      track.status.features.push_back({*pixel + noise, true});
    }
  }

  RandomStream random_;
  StereoRig rig_;
  std::vector<Eigen::Vector3d> ground_;
};
/// Flies on vision from the start; returns the navigator after bundle 60.
inline Navigator OnVision(NavigatorWorld& world, const LandingSite& site = {}) {
  Navigator navigator;
  navigator.AllowVision(true);
  for (int n = 1; n <= 60; ++n) {
    const FrameBundle bundle = world.Bundle(n);
    navigator.AddSensors(bundle);
    if (n == 10) {
      navigator.StartVision(site, bundle.time);
    }
    if (n >= 10) {
      navigator.AddVision(world.Track(n), kCamera, world.rig(), bundle, {});
    }
  }
  return navigator;
}

}  // namespace palace
