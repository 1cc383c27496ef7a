// What is learned of how landmarks lie turned; and approaches on vision with an attitude that is
// off: are positions as good as they are stated to be, and what do gravity and the turned-back
// landmarks gain? Landmarks lie where a tracker would lay them, by the attitude told at the
// beginning; nothing is drawn, so hundreds can be flown. What a picture's pixels err by alike
// (texture, lenses) is not in them.
#include "engine/navigation/landmark_frame.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "engine/core/rotation_vector.h"
#include "engine/navigation/navigator.h"
#include "engine/tracking/view_geometry.h"
#include "tests/navigation/flight.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const PinholeCamera kCamera{640, 480, 772.548, 772.548, 319.5, 239.5};
constexpr double kLock_s = 12, kEnd_s = 28;
Timestamp At(double t) { return AddSeconds({}, t); }

/// An attitude reference: white noise, and a bias that wanders with 300 s.
class Ahrs {
 public:
  Ahrs(double noise_rad, double bias_rad, RandomStream& random)
      : noise_rad_(noise_rad), bias_rad_(bias_rad), random_(random) {
    bias_B_ = NormalVector(random_, bias_rad_);
  }
  Matrix3d Told(const Matrix3d& R_WB, double dt) {
    const double decay = std::exp(-dt / 300);
    bias_B_ = decay * bias_B_ + NormalVector(random_, bias_rad_ * std::sqrt(1 - decay * decay));
    return R_WB * RotationFromVector(bias_B_ + NormalVector(random_, noise_rad_));
  }
  const Vector3d& bias_B() const { return bias_B_; }

 private:
  double noise_rad_, bias_rad_;
  RandomStream& random_;
  Vector3d bias_B_;
};

struct Landmarks {
  std::vector<Vector3d> true_W, placed_W;
  LandingSite site;
};

/// As ranges lay them: the site by many pictures before, by the bias alone; the landmarks by the
/// told pose of one, turned as that is, from the height above the site that ranges measure.
Landmarks Place(const RigidTransform& X_WC, const RigidTransform& X_WC_told,
                const Matrix3d& R_WC_biased, RandomStream& random) {
  constexpr double kOfManyFixes_m = 0.005;
  Landmarks marks;
  const Matrix3d& R_WC_told = X_WC_told.R;
  const Vector3d to_site_C = X_WC.R.transpose() * -X_WC.p;
  const Vector3d p_WS = X_WC.p + R_WC_biased * to_site_C + NormalVector(random, kOfManyFixes_m);
  marks.site.p_WS = p_WS;
  Vector3d from_W = X_WC_told.p;
  from_W.z() = X_WC.p.z() - (X_WC.p + R_WC_told * to_site_C - p_WS).z();
  while (marks.true_W.size() < 40) {
    const Vector3d p_W(random.Uniform(-6, 6), random.Uniform(-6, 6), 0);
    marks.true_W.push_back(p_W);
    marks.placed_W.push_back(from_W + R_WC_told * X_WC.R.transpose() * (p_W - X_WC.p));
  }
  return marks;
}

struct Honesty {
  double raw_nees = 0, filter_nees = 0;  ///< per degree of freedom
  double level_nees = 0;                 ///< of the filter, north and east each by itself
  double worst_m = 0;                    ///< of the filter
  double rms_m = 0;
};

void Fly(const AttitudeErrors& errors, std::uint64_t seed, Honesty& sum) {
  const Flight flight{.speed_mps = 0.8, .start_height_m = 25};
  RandomStream random(seed, "approach");
  StereoRig rig;
  rig.position_body_m = {0.6, 0, 0.2};
  rig.tilt_rad = Rad(-45);
  Ahrs ahrs(errors.noise_rad, errors.bias_rad, random);
  const Vector3d accel_bias_B = NormalVector(random, AttitudeErrors{}.accel_bias_mps2);
  Navigator navigator;
  navigator.SetAttitudeErrors(errors);
  navigator.AllowVision(true);
  Landmarks marks;
  double raw = 0, filtered = 0, level = 0, squares = 0;
  int count = 0;
  for (int n = 1; n <= static_cast<int>(10 * kEnd_s); ++n) {
    FrameBundle bundle;
    bundle.time = At(0.1 * n);
    for (int k = 1; k <= 10; ++k) {
      const double t = 0.1 * (n - 1) + 0.01 * k;
      ImuSample sample;
      sample.time = At(t);
      sample.specific_force_B =
          flight.SpecificForce(t) + accel_bias_B + NormalVector(random, 0.012);
      bundle.imu.push_back(sample);
      if (k % 2 == 0) {
        VehiclePose pose = flight.Pose(t);
        pose.X_WB.R = ahrs.Told(pose.X_WB.R, 0.02);
        bundle.poses.push_back(pose);
      }
    }
    if (n % 2 == 0) {
      const double t = 0.1 * n - 0.1;
      bundle.gps.push_back({At(t), flight.Position(t) + NormalVector(random, 0.02),
                            flight.Velocity(t) + NormalVector(random, 0.03), 0.02, 0.02});
    }
    bundle.pose_at_exposure = bundle.poses.back();
    navigator.AddSensors(bundle);
    const double t = 0.1 * n;
    if (t < kLock_s - 1e-6) {
      continue;
    }
    const RigidTransform X_BC = rig.X_BC();
    const RigidTransform X_WC = RigidTransform{flight.Attitude(t), flight.Position(t)} * X_BC;
    const Matrix3d R_WB_told = bundle.poses.back().X_WB.R;
    if (marks.true_W.empty()) {
      const Matrix3d R_WB_biased = flight.Attitude(t) * RotationFromVector(ahrs.bias_B());
      const RigidTransform X_WB_told{R_WB_told, navigator.PredictBodyPose(bundle.time).p};
      marks = Place(X_WC, X_WB_told * X_BC, R_WB_biased * X_BC.R, random);
      navigator.StartVision(marks.site, bundle.time);
    }
    TrackResult track;
    track.time = bundle.time;
    track.status.locked = true;
    track.status.coherence = 1;
    for (std::size_t i = 0; i < marks.true_W.size(); ++i) {
      const auto pixel = PixelFromWorldPoint(kCamera, X_WC, marks.true_W[i]);
      if (pixel && InPicture(kCamera, *pixel, 2)) {
        const Eigen::Vector2d noise(0.08 * random.Normal(), 0.08 * random.Normal());
        track.landmarks.push_back({marks.placed_W[i], *pixel + noise, 0.3, 0.04});
      }
    }
    if (track.landmarks.size() < 8) {
      continue;
    }
    navigator.AddVision(track, kCamera, rig, bundle, {});
    const auto nees = [&](const Vector3d& p_WB, const Matrix3d& covariance_m2) {
      const Vector3d e = p_WB - marks.site.p_WS - flight.Position(t);
      return e.dot(covariance_m2.ldlt().solve(e)) / 3;
    };
    const auto fix = navigator.VisionPosition();
    const auto filter = navigator.VisionFilterAt(bundle.time);
    if (fix && filter) {
      raw += nees(fix->p_WB, fix->p_covariance_m2);
      filtered += nees(filter->p_WB, filter->p_covariance_m2);
      const Vector3d e = filter->p_WB - marks.site.p_WS - flight.Position(t);
      level += e.cwiseAbs2().cwiseQuotient(filter->p_covariance_m2.diagonal()).head<2>().mean();
      const double off_m = e.norm();
      sum.worst_m = std::max(sum.worst_m, off_m);
      squares += off_m * off_m;
      ++count;
    }
  }
  ASSERT_GT(count, 100);
  sum.raw_nees += raw / count;
  sum.filter_nees += filtered / count;
  sum.level_nees += level / count;
  sum.rms_m += squares / count;
}

// One told attitude laid the ground: every position by it is turned about where it was laid from,
// and its ground stands at the site's height all the same. Meanwhile the bias wanders.
TEST(LandmarkFrame, LearnsTheAttitudeThatPlacedTheLandmarksNotTheBiasThatWanders) {
  const Vector3d p_WS(0, 0, 0), n(Rad(0.2), Rad(-0.3), Rad(0.1)), wander(0, Rad(0.15), Rad(-0.2));
  const Matrix3d R_true = RotationFromEuler({0.02, -0.03, 0.4}), wrong = RotationFromVector(n);
  const Vector3d from_W(-15, 1, -15);
  LandmarkFrame frame;
  EXPECT_EQ(frame.Levelled({R_true, from_W}, p_WS).p, from_W);
  RandomStream random(2);
  double error_m = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d p_true = from_W + Vector3d(0.04, 0, 0.04) * i;
    const RigidTransform resected{wrong * R_true, from_W + wrong * (p_true - from_W)};
    const Vector3d bias = std::max(i - 50, 0) / 250.0 * wander;
    const Vector3d told = i == 0 ? n : Vector3d(bias + NormalVector(random, Rad(0.2)));
    frame.Add({At(0.1 * i), resected, RotationFromVector(told) * R_true, R_true, {}},
              {.noise_rad = Rad(0.2), .bias_rad = Rad(0.3)});
    const RigidTransform levelled = frame.Levelled(resected, p_WS);
    // The tracker lays the ground at the site's height: the camera stands that much off.
    const double lift_m = (from_W + wrong.transpose() * (p_WS - from_W)).z();
    error_m = (levelled.p - p_true + Vector3d(0, 0, lift_m)).norm();
  }
  const double left_rad = std::sqrt(frame.left_rad2()(0, 0));
  EXPECT_LT(error_m, 3 * left_rad * 17);
  EXPECT_LT(error_m, 0.035) << "turned after the bias: 0.075 m";
  EXPECT_LT(left_rad, 0.4 * Rad(0.2));
  EXPECT_GT(left_rad, 0.1 * Rad(0.2)) << "it cannot be told from wandering for ever";
}

// Gravity tells roll and pitch of the bias, as far as the accelerometer can be believed.
TEST(LandmarkFrame, GravityTurnsTheBiasBackAboutTheSite) {
  const Vector3d p_WS(4, -3, 1), from_W(-11, -2, -14), bias(Rad(0.3), Rad(-0.2), Rad(0.25));
  const Matrix3d wrong = RotationFromVector(bias);
  const Vector3d gravity_W(0, 0, kStandardGravity_mps2);
  const FeltBias felt{-bias.cross(gravity_W), 0.002};
  const AttitudeErrors errors{.noise_rad = 1e-4, .bias_rad = Rad(0.3), .accel_bias_mps2 = 0.002};
  const RigidTransform X_W{wrong, p_WS + wrong * (from_W - p_WS)};
  LandmarkFrame with, without;
  const auto told = [&](const std::optional<FeltBias>& bias_felt) {
    return ToldAttitude{At(0), X_W, wrong, Matrix3d::Identity(), bias_felt};
  };
  with.Add(told(felt), errors);
  without.Add(told({}), errors);
  const Vector3d yaw_only = p_WS + RotationFromVector({0, 0, bias.z()}) * (from_W - p_WS);
  EXPECT_LT((with.Levelled(X_W, p_WS).p - yaw_only).norm(), 0.005);
  EXPECT_LT((without.Levelled(X_W, p_WS).p - X_W.p).norm(), 1e-9);
  const auto left_rad = [](const LandmarkFrame& frame, int axis) {
    return std::sqrt(frame.left_rad2()(3 + axis, 3 + axis));
  };
  EXPECT_LT(left_rad(with, 0), Rad(0.03));
  EXPECT_NEAR(left_rad(with, 2), Rad(0.3), 1e-9) << "gravity tells no heading";
  EXPECT_NEAR(left_rad(without, 0), Rad(0.3), 1e-9);
  // What no such reference leans by is the accelerometer's.
  LandmarkFrame broken;
  broken.Add(told(FeltBias{{5, 0, 0}, 0.002}), errors);
  EXPECT_LT((broken.Levelled(X_W, p_WS).p - X_W.p).norm(), 4.5 * Rad(0.3) * 22);
}

class Approach : public testing::TestWithParam<AttitudeErrors> {};

TEST_P(Approach, ErrsAsStated) {
  constexpr int kFlights = 60;
  AttitudeErrors deaf = GetParam();
  deaf.accel_bias_mps2 = 10;  // gravity is not believed
  Honesty sum, without;
  for (int i = 0; i < kFlights; ++i) {
    Fly(GetParam(), 5001 + static_cast<std::uint64_t>(i), sum);
    Fly(deaf, 5001 + static_cast<std::uint64_t>(i), without);
  }
  without.rms_m = std::sqrt(without.rms_m / kFlights);
  sum.raw_nees /= kFlights;
  sum.filter_nees /= kFlights;
  sum.level_nees /= kFlights;
  sum.rms_m = std::sqrt(sum.rms_m / kFlights);
  std::printf(
      "[ measured ] noise %.2f deg, bias %.2f deg: NEES/dof raw %.2f, filtered %.2f (level %.2f); "
      "filtered %.3f "
      "m rms, at most %.3f m; without gravity %.3f m, %.3f m\n",
      Deg(GetParam().noise_rad), Deg(GetParam().bias_rad), sum.raw_nees, sum.filter_nees,
      sum.level_nees, sum.rms_m, sum.worst_m, without.rms_m, without.worst_m);
  // With a perfect attitude what remains is the one position by GPS that placed the ground.
  EXPECT_GT(sum.level_nees, 0.5);
  EXPECT_LT(sum.level_nees, 1.5);
  EXPECT_GT(sum.raw_nees, 0.5);
  EXPECT_LT(sum.raw_nees, 1.4);
  EXPECT_GT(sum.filter_nees, 0.5);
  EXPECT_LT(sum.filter_nees, 1.4);
  if (GetParam().bias_rad > 0) {
    EXPECT_LT(sum.rms_m, 0.9 * without.rms_m);
  }
}
INSTANTIATE_TEST_SUITE_P(
    Attitudes, Approach,
    testing::Values(AttitudeErrors{.noise_rad = 0, .bias_rad = 0}, AttitudeErrors{},
                    AttitudeErrors{.noise_rad = Rad(0.3), .bias_rad = 0},
                    AttitudeErrors{.noise_rad = 0.001, .bias_rad = Rad(0.3)},
                    AttitudeErrors{.noise_rad = Rad(0.3), .bias_rad = Rad(0.3)}));

}  // namespace
}  // namespace palace
