// Which fixes of vision the navigator takes, and what it believes of their errors.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/navigation/navigator.h"
#include "tests/navigation/navigator_world.h"

namespace palace {
namespace {

using State = NavigationStatus::Handover;

TEST(Navigator, RejectedFixesAreUnhealthy) {
  NavigatorWorld world(4);
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

// A record may list a place without saying how well its height is known.
TEST(Navigator, ASiteWhoseHeightErrorNobodyTellsIsFlownToWithAStatedError) {
  NavigatorWorld world(4);
  LandingSite site;
  site.height_m.three_sigma = NAN;
  const Navigator navigator = OnVision(world, site);
  const auto estimate = navigator.EstimateInForce(At(6));
  EXPECT_EQ(navigator.status().handover, State::kVision);
  EXPECT_TRUE(estimate.sigma_p_m.allFinite()) << estimate.sigma_p_m.transpose();
  EXPECT_LT((estimate.p_WB - world.flight.Position(6)).norm(), 0.3);
}

// What is refused says nothing of how the ground lies, either.
TEST(Navigator, ARefusedFixLeavesNoTrace) {
  NavigatorWorld with(4), without(4);
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
    NavigatorWorld world(9);
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
  NavigatorWorld world(8);
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
    NavigatorWorld world(13);
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
  NavigatorWorld world(5);
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

}  // namespace
}  // namespace palace
