#include "engine/navigation/navigator.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "engine/tracking/view_geometry.h"
#include "tests/navigation/flight.h"

namespace palace {
namespace {

using State = NavigationStatus::Handover;
const PinholeCamera kCamera{640, 480, 772.548, 772.548, 319.5, 239.5};
Timestamp At(double t) { return AddSeconds({}, t); }

/// A vehicle that flies Flight and sends what a real one would, ten bundles a second.
class World {
 public:
  explicit World(std::uint64_t seed) : random_(seed) {
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

TEST(Navigator, HandsOverWithoutAVelocityJumpAndHoldsThePosition) {
  World world(1);
  Navigator navigator;
  Eigen::Vector3d last_v = Eigen::Vector3d::Zero();
  double last_t = 0, velocity2 = 0, position2 = 0, worst_jump = 0;
  int count = 0, switched = 0;
  for (int n = 1; n <= 200; ++n) {
    const FrameBundle bundle = world.Bundle(n);
    navigator.AddSensors(bundle);
    if (n == 40) {
      navigator.StartVision({}, bundle.time);
      EXPECT_EQ(navigator.status().handover, State::kSettling);
      EXPECT_FALSE(navigator.status().handover_reason.empty());
    }
    if (n >= 40) {
      navigator.AddVision(world.Track(n), kCamera, world.rig(), bundle, {});
      EXPECT_TRUE(navigator.status().vision_measured) << n;
    }
    if (n == 80) {
      EXPECT_EQ(navigator.status().handover, State::kReady) << navigator.status().handover_reason;
      EXPECT_EQ(navigator.EstimateInForce(bundle.time).source, EstimateSource::kGps);
      navigator.AllowVision(true);
    }
    if (switched == 0 && navigator.status().handover == State::kVision) {
      switched = n;
      EXPECT_NEAR(navigator.status().offset_m, world.gps_bias.norm(), 1.0);
    }
    const double t = 0.1 * n;
    const PositionEstimate now = navigator.EstimateInForce(bundle.time);
    if (n > 80) {
      const Eigen::Vector3d step =
          (now.v_WB - last_v) - (world.flight.Velocity(t) - world.flight.Velocity(last_t));
      worst_jump = std::max(worst_jump, step.norm());
    }
    if (n > 110) {
      EXPECT_TRUE(now.healthy);
      EXPECT_EQ(now.source, EstimateSource::kVision);
      velocity2 += (now.v_WB - world.flight.Velocity(t)).squaredNorm() / 3;
      position2 += (now.p_WB - world.flight.Position(t)).squaredNorm() / 3;
      ++count;
    }
    last_v = now.v_WB;
    last_t = t;
  }
  std::printf(
      "[ measured ] vision: velocity %.3f m/s rms, position %.3f m rms, worst step of the "
      "velocity error %.3f m/s\n",
      std::sqrt(velocity2 / count), std::sqrt(position2 / count), worst_jump);
  EXPECT_EQ(switched, 81);
  EXPECT_LT(std::sqrt(velocity2 / count), 0.05);
  EXPECT_LT(std::sqrt(position2 / count), 0.06);
  EXPECT_LT(worst_jump, 0.06);
}

// The fix that comes with the hand-over is as far off as GPS velocities are now and then.
TEST(Navigator, HandsOverWithoutTheStepOfAGpsFixThatComesWithIt) {
  World world(3);
  Navigator navigator;
  constexpr int kSwitch = 82;  // even: with a fix
  Eigen::Vector3d before_v_WB = Eigen::Vector3d::Zero();
  for (int n = 1; n <= kSwitch; ++n) {
    FrameBundle bundle = world.Bundle(n);
    if (n == kSwitch) {
      before_v_WB = navigator.EstimateInForce(At(0.1 * (n - 1))).v_WB;
      ASSERT_EQ(bundle.gps.size(), 1);
      bundle.gps.front().v_WB += Eigen::Vector3d(0.3, -0.2, 0);
      navigator.AllowVision(true);
    }
    navigator.AddSensors(bundle);
    if (n == 40) {
      navigator.StartVision({}, bundle.time);
    }
    if (n >= 40) {
      navigator.AddVision(world.Track(n), kCamera, world.rig(), bundle, {});
    }
  }
  ASSERT_EQ(navigator.status().handover, State::kVision) << navigator.status().handover_reason;
  const double t = 0.1 * kSwitch;
  const Eigen::Vector3d moved_mps = world.flight.Velocity(t) - world.flight.Velocity(t - 0.1);
  const auto step_mps = [&](const Eigen::Vector3d& v_WB) {
    return (v_WB - before_v_WB - moved_mps).norm();
  };
  EXPECT_GT(step_mps(navigator.status().gps.estimate.v_WB), 0.05) << "the fix moves GPS";
  EXPECT_LT(step_mps(navigator.EstimateInForce(At(t)).v_WB), 0.02);
}

TEST(Navigator, GpsFilterNeverSeesVision) {
  World with(2), without(2);
  Navigator a, b;
  for (int n = 1; n <= 60; ++n) {
    const FrameBundle bundle = with.Bundle(n);
    a.AddSensors(bundle);
    b.AddSensors(bundle);
    if (n == 10) {
      a.StartVision({}, bundle.time);
    }
    if (n >= 10) {
      World picture(static_cast<std::uint64_t>(n));
      a.AddVision(picture.Track(n), kCamera, with.rig(), bundle, {});
    }
    EXPECT_EQ(a.status().gps.estimate.p_WB, b.status().gps.estimate.p_WB);
    EXPECT_EQ(a.status().gps.estimate.v_WB, b.status().gps.estimate.v_WB);
  }
}

/// Flies on vision from the start; returns the navigator after bundle 60.
Navigator OnVision(World& world) {
  Navigator navigator;
  navigator.AllowVision(true);
  for (int n = 1; n <= 60; ++n) {
    const FrameBundle bundle = world.Bundle(n);
    navigator.AddSensors(bundle);
    if (n == 10) {
      navigator.StartVision({}, bundle.time);
    }
    if (n >= 10) {
      navigator.AddVision(world.Track(n), kCamera, world.rig(), bundle, {});
    }
  }
  return navigator;
}

TEST(Navigator, LostVisionIsUnhealthyAndGoesOnInertially) {
  World world(3);
  Navigator navigator = OnVision(world);
  ASSERT_EQ(navigator.status().handover, State::kVision);
  for (int n = 61; n <= 80; ++n) {
    const FrameBundle bundle = world.Bundle(n);
    navigator.AddSensors(bundle);
    TrackResult lost;
    lost.time = At(world.Exposure(n));
    navigator.AddVision(lost, kCamera, world.rig(), bundle, {});
    const PositionEstimate now = navigator.EstimateInForce(bundle.time);
    EXPECT_EQ(now.source, EstimateSource::kVision);
    if (n <= 64) {
      EXPECT_TRUE(now.healthy) << n;
    }
    if (n >= 66) {
      EXPECT_FALSE(now.healthy) << n;
      EXPECT_NE(navigator.status().handover_reason, "");
    }
    EXPECT_LT((now.p_WB - world.flight.Position(0.1 * n)).norm(), 0.5) << n;
  }
}

// Without attitude a pixel is no direction: however good the tracking, there is no fix.
TEST(Navigator, VisionIsLostWithTheAttitude) {
  World world(3);
  Navigator navigator = OnVision(world);
  ASSERT_EQ(navigator.status().handover, State::kVision);
  for (int n = 61; n <= 75; ++n) {
    FrameBundle bundle = world.Bundle(n);
    bundle.poses.clear();
    bundle.pose_at_exposure.reset();
    navigator.AddSensors(bundle);
    navigator.AddVision(world.Track(n), kCamera, world.rig(), bundle, {});
    EXPECT_EQ(navigator.status().vision_measured, n <= 62) << n;
    EXPECT_TRUE(n < 69 || !navigator.EstimateInForce(bundle.time).healthy) << n;
  }
}

// Nothing is measured any more: the estimate says for how long, its sigma grows without end, and
// after 5 s it counts as unknown.
TEST(Navigator, UncertaintyGrowsWhileItCoasts) {
  World world(5);
  Navigator navigator;
  double sigma_m = 0;
  for (int n = 1; n <= 250; ++n) {
    FrameBundle bundle = world.Bundle(n);
    if (n > 50) {
      bundle.gps.clear();
    }
    if (n > 60) {
      bundle.imu.clear();
    }
    navigator.AddSensors(bundle);
    const FilterStatus& gps = navigator.status().gps;
    if (n > 62) {
      EXPECT_GT(gps.estimate.sigma_p_m.z(), sigma_m) << n;
      EXPECT_NEAR(gps.coasting_s, 0.1 * (n - 50), 0.35) << n;
      EXPECT_EQ(gps.IsUnknown(), gps.coasting_s > 5) << n;
    }
    sigma_m = gps.estimate.sigma_p_m.z();
  }
  EXPECT_GT(sigma_m, 10);
}

TEST(Navigator, RejectedFixesAreUnhealthy) {
  World world(4);
  Navigator navigator = OnVision(world);
  for (int n = 61; n <= 65; ++n) {
    const FrameBundle bundle = world.Bundle(n);
    navigator.AddSensors(bundle);
    TrackResult wrong = world.Track(n);
    for (GroundLandmark& landmark : wrong.landmarks) {
      landmark.p_WF.x() += 3;  // the whole track slid off
    }
    navigator.AddVision(wrong, kCamera, world.rig(), bundle, {});
  }
  EXPECT_EQ(navigator.status().vision.rejected_in_row, 5);
  EXPECT_FALSE(navigator.EstimateInForce(At(6.5)).healthy);
  EXPECT_LT((navigator.EstimateInForce(At(6.5)).p_WB - world.flight.Position(6.5)).norm(), 0.3);
}

// What is refused says nothing of how the ground lies, either.
TEST(Navigator, ARefusedFixLeavesNoTrace) {
  World with(4), without(4);
  Navigator refused = OnVision(with), blind = OnVision(without);
  const FrameBundle bundle = with.Bundle(61);
  FrameBundle leaning = bundle;
  const Eigen::Matrix3d lean = RotationFromEuler({Rad(4), Rad(-3), 0});
  leaning.pose_at_exposure->X_WB.R = lean * bundle.pose_at_exposure->X_WB.R;
  refused.AddSensors(bundle);
  blind.AddSensors(bundle);
  TrackResult wrong = with.Track(61);
  for (GroundLandmark& landmark : wrong.landmarks) {
    landmark.p_WF.x() += 3;
  }
  refused.AddVision(wrong, kCamera, with.rig(), leaning, {});
  ASSERT_EQ(refused.status().vision.rejected_in_row, 1);
  EXPECT_GT((refused.status().vision_p_WB - with.flight.Position(6.05)).norm(), 2);
  TrackResult nothing;
  nothing.time = wrong.time;
  blind.AddVision(nothing, kCamera, with.rig(), leaning, {});
  EXPECT_EQ(refused.PredictBodyPose(At(6.1)).R, blind.PredictBodyPose(At(6.1)).R);
  EXPECT_EQ(refused.EstimateInForce(At(6.1)).p_WB, blind.EstimateInForce(At(6.1)).p_WB);
  EXPECT_EQ(refused.VisionFilterAt(At(6.1))->p_covariance_m2,
            blind.VisionFilterAt(At(6.1))->p_covariance_m2);
  // Nor of how it lies in the pictures after it.
  const FrameBundle next = with.Bundle(62);
  const TrackResult track = with.Track(62);
  for (Navigator* navigator : {&refused, &blind}) {
    navigator->AddSensors(next);
    navigator->AddVision(track, kCamera, with.rig(), next, {});
  }
  EXPECT_EQ(refused.status().vision_p_WB, blind.status().vision_p_WB);
}

// An attitude that is told to be poor makes poor positions, and one told to be good, good ones.
TEST(Navigator, WhatPosesTellOfTheirNoiseIsBelieved) {
  const auto sigma_m = [](double told_rad, std::optional<AttitudeErrors> known) {
    World world(9);
    Navigator navigator;
    if (known) {
      navigator.SetAttitudeErrors(*known);
    }
    for (int n = 1; n <= 10; ++n) {
      FrameBundle bundle = world.Bundle(n);
      bundle.pose_at_exposure.reset();  // attitudes between two poses
      for (VehiclePose& pose : bundle.poses) {
        pose.sigmas.attitude_rad = told_rad;
      }
      navigator.AddSensors(bundle);
      if (n == 8) {
        navigator.StartVision({}, bundle.time);
      }
      if (n >= 8) {
        navigator.AddVision(world.TrackSiteOnly(n), kCamera, world.rig(), bundle, {});
      }
    }
    return std::sqrt(navigator.VisionPosition()->p_covariance_m2.trace());
  };
  const AttitudeErrors good{.noise_rad = Rad(0.1)};
  EXPECT_GT(sigma_m(Rad(1), {}), 3 * sigma_m(Rad(0.1), {}));
  EXPECT_EQ(sigma_m(Rad(1), good), sigma_m(Rad(0.1), good)) << "set from outside";
  EXPECT_EQ(sigma_m(PoseSigmas{}.attitude_rad, {}), sigma_m(Rad(1), AttitudeErrors{}));
}

// Where a template lies beside its site no picture tells; the pose that laid it erred.
TEST(Navigator, ATemplateSharesWhatItsPlaceErrs) {
  World world(8);
  const FrameBundle bundle = world.Bundle(1);
  TrackResult track = world.TrackSiteOnly(1);
  const auto shared = [&](double sigma_w_m, double noise_rad) {
    track.landmarks.front().sigma_w_m = sigma_w_m;
    const Result<VisionFix> fix =
        FixFromSitePixel(track, kCamera, world.rig(), bundle.pose_at_exposure->X_WB.R,
                         bundle.laser.front().range_m, {}, {.noise_rad = noise_rad, .bias_rad = 0});
    return fix->shared;
  };
  EXPECT_EQ(shared(0, Rad(0.1)).place_m.norm(), 0);
  EXPECT_NEAR(shared(0.05, Rad(0.1)).place_m.x(), 0.05, 1e-12);
  EXPECT_NEAR(shared(0.05, Rad(0.3)).place_m.y(), 0.05 * Rad(0.3) / 0.002, 1e-12);
}

// The filter widens what it is told, and none of its residuals is too large then.
TEST(Navigator, VisionFarRougherThanItStatesIsNotHandedOverTo) {
  for (const double rough_m : {0.0, 0.06}) {
    World world(13);
    RandomStream random(14);
    Navigator navigator;
    navigator.AllowVision(true);
    int refused = 0;
    for (int n = 1; n <= 100; ++n) {
      const FrameBundle bundle = world.Bundle(n);
      navigator.AddSensors(bundle);
      if (n == 10) {
        navigator.StartVision({}, bundle.time);
      }
      if (n < 10) {
        continue;
      }
      TrackResult track = world.Track(n);
      const Eigen::Vector3d off_W = NormalVector(random, rough_m);
      for (GroundLandmark& landmark : track.landmarks) {
        landmark.p_WF += off_W;
      }
      navigator.AddVision(track, kCamera, world.rig(), bundle, {});
      refused += navigator.status().vision.rejected_in_row > 0 ? 1 : 0;
    }
    EXPECT_LT(refused, 30) << rough_m;
    if (rough_m > 0) {
      EXPECT_NE(navigator.status().handover, State::kVision);
    } else {
      EXPECT_EQ(navigator.status().handover, State::kVision);
    }
  }
}

TEST(Navigator, LowCoherenceIsNotMeasured) {
  World world(5);
  Navigator navigator = OnVision(world);
  const FrameBundle bundle = world.Bundle(61);
  navigator.AddSensors(bundle);
  TrackResult track = world.Track(61);
  track.status.coherence = 0.2;
  track.status.features.resize(3 * track.landmarks.size());
  navigator.AddVision(track, kCamera, world.rig(), bundle, {});
  EXPECT_FALSE(navigator.status().vision_measured);
  // Only the site's patch is hidden: the ground around it still speaks.
  track.status.features.resize(track.landmarks.size());
  navigator.AddVision(track, kCamera, world.rig(), bundle, {});
  EXPECT_TRUE(navigator.status().vision_measured);
}

TEST(Navigator, PredictsTheBodyAtTheExposure) {
  World world(6);
  Navigator navigator = OnVision(world);
  for (const double t : {5.8, 5.95, 6.0, 6.03}) {
    const RigidTransform X_WB = navigator.PredictBodyPose(At(t));
    EXPECT_LT((X_WB.p - world.flight.Position(t)).norm(), 0.1) << t;
    EXPECT_LT((X_WB.R - world.flight.Attitude(t)).norm(), Rad(0.4)) << t;
  }
}

TEST(Navigator, GoesBackToGpsWithoutAVelocityJump) {
  World world(7);
  Navigator navigator = OnVision(world);
  const Eigen::Vector3d before = navigator.EstimateInForce(At(6.0)).v_WB;
  navigator.StopVision();
  const PositionEstimate after = navigator.EstimateInForce(At(6.0));
  EXPECT_EQ(after.source, EstimateSource::kGps);
  EXPECT_LT((after.v_WB - before).norm(), 1e-9);
  EXPECT_FALSE(navigator.status().vision.running);
}

TEST(Navigator, ThesisModeUsesTheLaser) {
  World world(8);
  Navigator navigator;
  navigator.AllowVision(true);
  for (int n = 1; n <= 80; ++n) {
    const FrameBundle bundle = world.Bundle(n);
    navigator.AddSensors(bundle);
    if (n == 10) {
      navigator.StartVision({}, bundle.time);
    }
    if (n >= 10) {
      navigator.AddVision(world.TrackSiteOnly(n), kCamera, world.rig(), bundle, {});
      const double t = world.Exposure(n);
      ASSERT_TRUE(navigator.status().vision_measured) << n;
      EXPECT_LT((navigator.status().vision_p_WB - world.flight.Position(t)).norm(),
                0.008 * 28 + 0.05)
          << n;
    }
  }
  EXPECT_EQ(navigator.status().handover, State::kVision) << navigator.status().handover_reason;
}

TEST(Navigator, WithoutGpsThePoseIsInForce) {
  World world(9);
  world.with_gps = false;
  Navigator navigator;
  for (int n = 1; n <= 5; ++n) {
    navigator.AddSensors(world.Bundle(n));
  }
  const PositionEstimate now = navigator.EstimateInForce(At(0.5));
  EXPECT_EQ(now.source, EstimateSource::kGps);
  EXPECT_TRUE(now.healthy);
  EXPECT_LT((now.p_WB - world.flight.Position(0.5) - world.gps_bias).norm(), 1e-6);
  EXPECT_FALSE(navigator.EstimateInForce(At(2.0)).healthy);
}

TEST(Navigator, AFolderOfPicturesHasAPoseButNoEstimate) {
  World world(10);
  world.with_gps = world.with_imu = world.with_pose_stream = false;
  Navigator navigator;
  EXPECT_EQ(navigator.EstimateInForce({}).source, EstimateSource::kNone);
  const FrameBundle bundle = world.Bundle(1);
  navigator.AddSensors(bundle);
  const RigidTransform X_WB = navigator.PredictBodyPose(At(world.Exposure(1)));
  EXPECT_EQ(X_WB.p, bundle.pose_at_exposure->X_WB.p);
  EXPECT_EQ(navigator.EstimateInForce(bundle.time).source, EstimateSource::kNone);
  EXPECT_FALSE(navigator.EstimateInForce(bundle.time).healthy);
}

TEST(Navigator, WorksWithoutAnImu) {
  World world(11);
  world.with_imu = false;
  Navigator navigator = OnVision(world);
  EXPECT_EQ(navigator.status().handover, State::kVision) << navigator.status().handover_reason;
  EXPECT_LT((navigator.EstimateInForce(At(6.0)).p_WB - world.flight.Position(6.0)).norm(), 0.15);
}

TEST(Navigator, SameInputSameBits) {
  World one(12), two(12);
  const Navigator a = OnVision(one);
  const Navigator b = OnVision(two);
  EXPECT_EQ(a.EstimateInForce(At(6.02)).p_WB, b.EstimateInForce(At(6.02)).p_WB);
  EXPECT_EQ(a.EstimateInForce(At(6.02)).v_WB, b.EstimateInForce(At(6.02)).v_WB);
}

}  // namespace
}  // namespace palace
