// The experiment on velocities from vision fixes: its filter of fixed gains, its fixes, its loop,
// and what its report calls passed.
#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "engine/experiments/evaluate_velocity_estimate.h"
#include "engine/experiments/velocity_report.h"
#include "tests/support/experiment_run.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// simulation.md 4.2, to its digits.
TEST(FixedGainFilter, SettlesAtTheReferencesGains) {
  const struct {
    double accel_noise, sigma_m, k_p, k_v;
  } table[] = {{0.03, 0.02, 0.27, 0.42}, {0.03, 0.08, 0.15, 0.12}, {0.15, 0.02, 0.50, 1.69},
               {0.15, 0.08, 0.29, 0.50}, {0.5, 0.02, 0.72, 4.2},   {1.5, 0.08, 0.66, 3.4}};
  for (const auto& row : table) {
    const Vector3d gains = SteadyGains({.accel_noise_mps2_rthz = row.accel_noise,
                                        .bias_walk_mps3_rthz = 0.002,
                                        .fix_sigma_m = row.sigma_m});
    EXPECT_NEAR(gains[0], row.k_p, 0.02) << row.accel_noise << ", " << row.sigma_m;
    EXPECT_NEAR(gains[1], row.k_v, 0.05 * row.k_v + 0.01) << row.accel_noise << ", " << row.sigma_m;
  }
}

TEST(FixedGainFilter, ExactInputsStayExactAndABiasIsLearnt) {
  const FixedGainDesign design{
      .accel_noise_mps2_rthz = 0.5, .bias_walk_mps3_rthz = 0.1, .fix_sigma_m = 0.02};
  const Vector3d a(0.3, -0.2, 0.1), v0(1, 2, -1), bias(0.05, 0, -0.05);
  for (const bool biased : {false, true}) {
    FixedGainFilter filter(design, Vector3d::Zero(), v0);
    constexpr double kStep_s = 0.01;
    double t = 0;
    for (int k = 1; k <= 6000; ++k) {
      t = k * kStep_s;
      filter.Propagate(biased ? Vector3d(a + bias) : a, kStep_s);
      if (k % 10 == 0) {
        filter.AddFix(t * v0 + t * t / 2 * a);
      }
    }
    EXPECT_NEAR((filter.v_WB() - v0 - t * a).norm(), 0, biased ? 1e-3 : 1e-9);
  }
}

struct SeenFixes {
  std::vector<double> told_s;
  double most_late_s = 0;
  Vector3d mean = Vector3d::Zero(), sd = Vector3d::Zero();
};

/// From 50 ft over a place 45 degrees below, turning nose up at that rate.
SeenFixes Fixes(FixPace pace, FixAttitude attitude, double pitch_rate_rad_s) {
  const VehicleDescription& vehicle = DefaultVehicle();
  VisionFixes fixes({.rig = vehicle.rig,
                     .laser = vehicle.sensors.laser,
                     .attitude_noise_rad = 0.001,
                     .p_WS = Vector3d(16, -0.5, 0),
                     .pace = pace,
                     .attitude = attitude,
                     .seed = 4});
  SeenFixes seen;
  Vector3d squares = Vector3d::Zero();
  for (int k = 0; k < 12000; ++k) {
    const double t = 0.005 * k;
    // Back and forth, a saw-tooth of 0.2 s: the place stays in the picture.
    const double saw_s = t - 0.2 * std::floor(t / 0.2);
    const Matrix3d R =
        Eigen::AngleAxisd(pitch_rate_rad_s * saw_s, Vector3d::UnitY()).toRotationMatrix();
    const Timestamp now = AddSeconds({1'000'000}, t);
    if (const auto told = fixes.Advance(now, {R, {0, 0, -15.24}}, R)) {
      seen.told_s.push_back(t);
      seen.most_late_s = std::max(seen.most_late_s, SecondsBetween(told->fix.time, now));
      seen.mean += told->error_m;
      squares += told->error_m.cwiseAbs2();
    }
  }
  const double n = static_cast<double>(seen.told_s.size());
  seen.mean /= n;
  seen.sd = (squares / n - seen.mean.cwiseAbs2()).cwiseSqrt();
  return seen;
}

TEST(VisionFixes, ComeAtTheirPaceWithTheirErrors) {
  const SeenFixes free = Fixes(FixPace::kAsFastAsItCan, FixAttitude::kOfExposure, 0);
  const SeenFixes ten = Fixes(FixPace::kTenHz, FixAttitude::kOfExposure, 0);
  EXPECT_NEAR(static_cast<double>(ten.told_s.size()), 600, 2);
  EXPECT_NEAR(static_cast<double>(free.told_s.size()), 60 / 0.069, 40);
  for (const SeenFixes* seen : {&free, &ten}) {
    EXPECT_LE(seen->most_late_s, 0.105);
    EXPECT_GT(seen->most_late_s, 0.09);
    for (const double sd : seen->sd) {
      EXPECT_GT(sd, 0.02);
      EXPECT_LT(sd, 0.08);
    }
    EXPECT_LT(seen->mean.norm(), 0.06);
  }
}

TEST(VisionFixes, AnAttitudeThatIsNotThePicturesMovesThemByTheTurnTimesTheDistance) {
  const SeenFixes still = Fixes(FixPace::kAsFastAsItCan, FixAttitude::kOnArrival, 0);
  const SeenFixes own = Fixes(FixPace::kAsFastAsItCan, FixAttitude::kOfExposure, 0.2);
  const SeenFixes late = Fixes(FixPace::kAsFastAsItCan, FixAttitude::kOnArrival, 0.2);
  EXPECT_NEAR(own.sd.norm(), still.sd.norm(), 0.02);
  // 0.2 rad/s over some 0.07 s at 22 m: 0.3 m, and back where the saw falls.
  EXPECT_GT(late.sd.norm(), 3 * still.sd.norm());
}

const VelocityMethod& MethodNamed(const std::string& name) {
  for (const VelocityMethod& method : VelocityMethods()) {
    if (method.name == name) {
      return method;
    }
  }
  ADD_FAILURE() << name;
  return VelocityMethods().front();
}

VelocityFlight Hover(const std::string& method, double integral, std::uint64_t seed = 1) {
  const Result<VelocityFlight> flight =
      FlyOn(MethodNamed(method), {integral, true}, {.seed = seed, .hover_s = 12});
  EXPECT_TRUE(flight) << flight.error().message;
  return flight ? *flight : VelocityFlight();
}

TEST(VelocityFlight, TheThesissFirstWayCrashesAtOnceAndOursDoesNot) {
  const VelocityFlight first = Hover("high; free; late attitude", 0.25);
  EXPECT_EQ(first.crash, "10 m off");
  EXPECT_LT(first.crash_s, 10);
  const VelocityFlight ours = Hover("ours", 0.25), gps = Hover("GPS", 0.25);
  for (const VelocityFlight* flight : {&ours, &gps}) {
    EXPECT_EQ(flight->crash, "none");
    EXPECT_LT(flight->hover_rms_mps.maxCoeff(), kMostHover_mps);
    EXPECT_LT(flight->approach_rms_mps.maxCoeff(), kMostHover_mps);
    EXPECT_LT(flight->approach_off_m, 1);
  }
  EXPECT_GT(Hover("high; 10 Hz", 0.25).hover_rms_mps.norm(), 5 * ours.hover_rms_mps.norm());
}

TEST(VelocityFlight, RefusesCamerasThatLookTooFlat) {
  VelocityFlightPlan plan{.hover_s = 5};
  plan.vehicle.rig.tilt_rad = 0;
  const Result<VelocityFlight> flight = FlyOn(MethodNamed("ours"), {0.25, true}, plan);
  ASSERT_FALSE(flight);
  EXPECT_THAT(flight.error().message, testing::HasSubstr("below the horizon"));
}

TEST(VelocityFlight, OneSeedIsOneFlight) {
  const VelocityFlight a = Hover("ours", 0.25), b = Hover("ours", 0.25),
                       other = Hover("ours", 0.25, 2);
  ASSERT_EQ(a.track.size(), b.track.size());
  for (std::size_t i = 0; i < a.track.size(); ++i) {
    ASSERT_EQ(a.track[i].estimated_mps, b.track[i].estimated_mps);
  }
  EXPECT_NE(a.hover_rms_mps, other.hover_rms_mps);
}

Experiment WithoutMissions() {
  Experiment experiment = VelocityEstimateExperiment({});
  CLI::App app;
  experiment.add_options(app);
  app.parse("--no-missions --hover 5");
  return experiment;
}

TEST(EvaluateVelocityEstimate, ShardsMergeToTheByte) {
  ExpectShardsMerge(WithoutMissions(), 3, 2, 2);
}

/// A station's messages, ten a second: 1 s on GPS, then on vision.
class Messages {
 public:
  explicit Messages(HandoverOnlooker& onlooker) : onlooker_(onlooker) {}
  /// The next one, whose velocity is off by that much.
  void Send(EstimateSource source, const Vector3d& error_mps) {
    VelocitySeen seen;
    seen.sent.time = AddSeconds({1'000'000}, 0.1 * count_++);
    seen.sent.source = source;
    seen.true_v_WB = {0.3 * count_, -0.1, 1};  // the vehicle's own motion does not count
    seen.sent.v_WB = seen.true_v_WB + error_mps;
    seen.gps_v_WB = seen.true_v_WB + Vector3d(0.1, 0, 0);
    seen.vision_v_WB = seen.true_v_WB - Vector3d(0.02, 0, 0);
    onlooker_.Look(seen);
  }

 private:
  HandoverOnlooker& onlooker_;
  int count_ = 0;
};

TEST(HandoverOnlooker, SeesTheLargestChangeFromGpsToTheEndOfTheFade) {
  for (const int stepped : {0, 1, 10}) {
    HandoverOnlooker onlooker;
    Messages messages(onlooker);
    for (int i = 0; i < 10; ++i) {
      messages.Send(EstimateSource::kGps, {i % 2 == 0 ? 0.1 : 0.07, 0, 0});
    }
    for (int i = 0; i < 20; ++i) {
      messages.Send(EstimateSource::kVision, {0.07, i < stepped ? 0 : 0.06, 0});
    }
    const HandoverFlight seen = onlooker.Seen();
    EXPECT_NEAR(seen.step_mps, 0.06, 1e-9) << stepped;
    EXPECT_NEAR(seen.first_step_mps, stepped == 0 ? 0.06 : 0, 1e-9);
    EXPECT_NEAR(seen.usual_mps, 0.03, 1e-9);
    EXPECT_NEAR(seen.gap_mps, 0.12, 1e-9);
    EXPECT_NEAR(seen.hover_rms_mps.x(), 0.02, 1e-9);
  }
}

TEST(HandoverOnlooker, AHandOverThatIsNotSeenToItsEndIsUnknown) {
  HandoverOnlooker onlooker;
  Messages messages(onlooker);
  for (int i = 0; i < 10; ++i) {
    messages.Send(EstimateSource::kGps, Vector3d::Zero());
  }
  EXPECT_TRUE(std::isnan(onlooker.Seen().step_mps));
  for (int i = 0; i < 8; ++i) {
    messages.Send(EstimateSource::kVision, Vector3d::Zero());
  }
  EXPECT_TRUE(std::isnan(onlooker.Seen().step_mps));
}

TEST(EvaluateVelocityEstimate, TheReportFailsForWhatIsBeyondItsLimits) {
  const VelocityMethod ours = MethodNamed("ours");
  VelocityFlight hover;
  hover.hover_rms_mps = Vector3d::Constant(0.02);
  HandoverFlight mission;
  mission.hover_rms_mps = mission.descent_rms_mps = Vector3d::Constant(0.02);
  mission.step_mps = mission.first_step_mps = 0.01;
  mission.gap_mps = 0.2;
  // A good flight and a good mission first: each one counts.
  const auto report = [&](const VelocityFlight& flight, const HandoverFlight& flown) {
    TrialTable table;
    table.columns = {"trial", "seed"};
    const std::vector<std::string> columns = VelocityColumns();
    table.columns.insert(table.columns.end(), columns.begin(), columns.end());
    const LoopIntegral& integral = LoopIntegrals().front();
    for (TrialRow row : {RowOf(ours, integral, hover), RowOf(mission),
                         RowOf(ours, integral, flight), RowOf(flown)}) {
      row.insert(row.begin(), {"0", "1"});
      table.rows.push_back(row);
    }
    return VelocityReport(table);
  };
  EXPECT_TRUE(report(hover, mission).passed);
  VelocityFlight noisy = hover, crashed = hover, unknown = hover;
  noisy.hover_rms_mps.y() = 0.041;
  crashed.crash = "tilt";
  unknown.hover_rms_mps.z() = NAN;
  for (const VelocityFlight& flight : {noisy, crashed, unknown}) {
    EXPECT_FALSE(report(flight, mission).passed);
  }
  HandoverFlight stepped = mission, never = mission, beside = mission, unseen = mission;
  stepped.step_mps = 0.051;
  never.step_mps = NAN;
  beside.hover_rms_mps.z() = 0.041;
  unseen.hover_rms_mps.y() = NAN;
  for (const HandoverFlight& flown : {stepped, never, beside, unseen}) {
    EXPECT_FALSE(report(hover, flown).passed);
  }
  EXPECT_THAT(report(hover, never).lines,
              testing::Contains(testing::AllOf(testing::StartsWith("FAILED: Change of the error"),
                                               testing::HasSubstr("1 of 2 missions"))));
}

}  // namespace
}  // namespace palace
