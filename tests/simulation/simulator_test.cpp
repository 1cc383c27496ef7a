// Whole flights without pictures: hover, a landing on vision, refusals, outages, determinism.
#include "engine/simulation/simulator.h"

#include <cmath>
#include <deque>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/hash.h"
#include "engine/core/units.h"

namespace palace {
namespace {

using Eigen::Vector3d;
using Bundle = std::shared_ptr<const FrameBundle>;

SimulatorOptions Options(std::uint64_t seed) {
  SimulatorOptions options;
  options.scene = MakeScene("empty", seed).value();
  options.seed = seed;
  options.render = false;
  return options;
}

/// Plays the station: estimates are truth plus noise, one bundle (0.1 s) late.
class Flight {
 public:
  explicit Flight(const SimulatorOptions& options)
      : simulator(options, nullptr), random_(options.seed, "station") {
    Step();
  }

  Bundle Step() {
    if (delayed_) {
      simulator.Send(*delayed_);
      delayed_.reset();
    }
    last = simulator.Next({}).value();
    modes.insert(last->status->mode);
    for (const CommandAck& ack : last->acks) {
      acks.push_back(ack);
    }
    if (estimates_on) {
      const Truth& truth = last->truth.back();
      PositionEstimate estimate;
      estimate.time = truth.time;
      estimate.source = EstimateSource::kVision;
      estimate.healthy = true;
      estimate.approval_id = approval_id;
      estimate.p_WB = truth.X_WB.p + vision_offset_W + 0.02 * Noise();
      estimate.v_WB = truth.v_WB + 0.03 * Noise();
      delayed_ = pending_;
      pending_ = estimate;
    }
    return last;
  }
  Bundle StepSeconds(double seconds) {
    for (int i = 0; i < std::lround(10 * seconds); ++i) {
      Step();
    }
    return last;
  }
  /// Steps until the vehicle is in `mode`; false after the time limit.
  bool StepUntil(VehicleMode mode, double limit_s) {
    for (int i = 0; i < 10 * limit_s; ++i) {
      if (Step()->status->mode == mode) {
        return true;
      }
    }
    return false;
  }

  Approval MakeApproval(const Vector3d& p_WS, double heading_rad = 0) {
    Approval approval;
    approval.id = approval_id = 70 + ++counter_;
    approval.session_id = 5;
    approval.counter = counter_;
    approval.vehicle_boot_id = last->status->boot_id;
    approval.approved_at = last->time;
    approval.expires_at = AddSeconds(last->time, 30);
    approval.p_WS = p_WS;
    approval.approach_heading_rad = heading_rad;
    approval.glide_slope_rad = Rad(45);
    approval.clear_radius_m = 2.3;
    return approval;
  }

  Simulator simulator;
  Bundle last;
  std::set<VehicleMode> modes;
  std::vector<CommandAck> acks;
  bool estimates_on = false;
  std::uint64_t approval_id = 0;
  Vector3d vision_offset_W = Vector3d::Zero();

 private:
  Vector3d Noise() {
    const double x = random_.Normal(), y = random_.Normal(), z = random_.Normal();
    return {x, y, z};
  }
  RandomStream random_;
  std::uint64_t counter_ = 0;
  std::optional<PositionEstimate> pending_;
  std::optional<PositionEstimate> delayed_;
};

TEST(Simulator, CalmHoverHoldsWithinTenCentimetres) {
  for (const std::uint64_t seed : {3, 7, 12}) {
    Flight flight(Options(seed));
    double worst_m = 0;
    for (int i = 0; i < 600; ++i) {
      for (const Truth& truth : flight.Step()->truth) {
        worst_m = std::max(worst_m, (truth.X_WB.p - Vector3d(0, 0, -15.24)).norm());
      }
    }
    EXPECT_LT(worst_m, 0.1) << "seed " << seed;
    EXPECT_EQ(flight.modes, std::set<VehicleMode>{VehicleMode::kHover});
  }
}

TEST(Simulator, WindyHoverStaysWithinTheMeasuredAnchor) {
  SimulatorOptions options = Options(3);
  options.wind = {5, 0.7, 7.7};
  Flight flight(options);
  double squares = 0;
  int count = 0;
  for (int i = 0; i < 900; ++i) {
    for (const Truth& truth : flight.Step()->truth) {
      squares += truth.X_WB.p.head<2>().squaredNorm();
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.35);
}

struct LandingCase {
  std::uint64_t seed;
  double north_m;
  double east_m;
  double heading_rad;
  WindOptions wind;
  double max_miss_m;
};

class Landing : public testing::TestWithParam<LandingCase> {};

TEST_P(Landing, TouchesDownOnTheSite) {
  const LandingCase& c = GetParam();
  SimulatorOptions options = Options(c.seed);
  options.wind = c.wind;
  Flight flight(options);
  const Vector3d p_WS(c.north_m, c.east_m, 0);
  flight.simulator.Send(flight.MakeApproval(p_WS, c.heading_rad));
  flight.estimates_on = true;
  const bool landed = flight.StepUntil(VehicleMode::kLanded, 120);
  ASSERT_TRUE(landed) << "seed " << c.seed << " mode "
                      << static_cast<int>(flight.last->status->mode);
  for (const VehicleMode mode :
       {VehicleMode::kAlign, VehicleMode::kDescend, VehicleMode::kSettle, VehicleMode::kSink}) {
    EXPECT_TRUE(flight.modes.count(mode)) << static_cast<int>(mode);
  }
  const Touchdown* touchdown = flight.simulator.touchdown();
  ASSERT_NE(touchdown, nullptr);
  const double miss_m = (touchdown->p_W_skid - p_WS).head<2>().norm();
  EXPECT_LT(miss_m, c.max_miss_m) << "seed " << c.seed;
  EXPECT_LT(touchdown->vertical_speed_mps, 0.7);
  EXPECT_LT(touchdown->horizontal_speed_mps, 0.6);
  EXPECT_LT(touchdown->tilt_rad, Rad(8));
  EXPECT_FALSE(touchdown->on_object);
  // It stays down, at rest, and refuses to fly again.
  flight.simulator.Send(AbortRequest{9, "test"});
  flight.StepSeconds(2);
  EXPECT_TRUE(flight.last->status->on_ground);
  EXPECT_EQ(flight.last->truth.back().v_WB.norm(), 0);
  EXPECT_EQ(flight.acks.back().result, AckResult::kRefused);
  std::printf("  seed %d: %.1f s, miss %.3f m, vz %.2f, vh %.2f m/s, tilt %.1f deg\n",
              static_cast<int>(c.seed), SecondsBetween(Simulator::kEpoch, touchdown->time), miss_m,
              touchdown->vertical_speed_mps, touchdown->horizontal_speed_mps,
              Deg(touchdown->tilt_rad));
}

INSTANTIATE_TEST_SUITE_P(Calm, Landing,
                         testing::Values(LandingCase{1, 15.7, 0, 0, {}, 0.3},
                                         LandingCase{2, 12, 5, 0, {}, 0.3},
                                         LandingCase{3, 20, -6, 0.3, {}, 0.3},
                                         LandingCase{4, 14, 2, -1.2, {}, 0.3},
                                         LandingCase{5, 10, -4, 2.5, {}, 0.3}));
INSTANTIATE_TEST_SUITE_P(LightWind, Landing,
                         testing::Values(LandingCase{6, 16, 1, 0, {4, 0.2, 5}, 0.8},
                                         LandingCase{7, 16, 1, 0, {4, 1.5, 5}, 0.8},
                                         LandingCase{8, 14, -3, 0.5, {4, 3.0, 5}, 0.8}));

TEST(Simulator, HandOverShiftsTheReferenceInsteadOfTheVehicle) {
  Flight flight(Options(8));
  flight.vision_offset_W = {0.4, -0.3, 0.2};
  flight.simulator.Send(flight.MakeApproval({15.7, 0, 0}));
  flight.estimates_on = true;
  ASSERT_TRUE(flight.StepUntil(VehicleMode::kDescend, 60));
  double worst_tilt = 0;
  for (int i = 0; i < 20; ++i) {
    for (const Truth& truth : flight.Step()->truth) {
      worst_tilt = std::max(worst_tilt, std::acos(std::min(1.0, truth.X_WB.R(2, 2))));
    }
  }
  // A 0.5 m step would ask for 0.35 * 0.9 * 0.5 / g = 0.9 degrees at once, on top of the 2 degrees
  // that starting down the slope takes.
  EXPECT_LT(worst_tilt, Rad(3));
  ASSERT_TRUE(flight.StepUntil(VehicleMode::kLanded, 90));
  // It lands where vision said, not where GPS said.
  EXPECT_NEAR(flight.simulator.touchdown()->p_W_skid.x(), 15.7 - 0.4, 0.3);
  EXPECT_NEAR(flight.simulator.touchdown()->p_W_skid.y(), 0 + 0.3, 0.3);
}

TEST(Simulator, SiteStaysInTheLeftPictureDownTheSlope) {
  Flight flight(Options(18));
  const Vector3d p_WS(17, 3, 0);
  flight.simulator.Send(flight.MakeApproval(p_WS, 0.2));
  flight.estimates_on = true;
  ASSERT_TRUE(flight.StepUntil(VehicleMode::kDescend, 60));
  double worst_rad = 0;
  while (flight.last->status->mode == VehicleMode::kDescend) {
    const Bundle b = flight.Step();
    const Vector3d p_CS = (b->truth.back().X_WB * b->rig->X_BC()).Inverse() * p_WS;
    worst_rad = std::max(worst_rad, std::atan2(p_CS.head<2>().norm(), p_CS.z()));
  }
  // The picture reaches 17.3 degrees from its centre in the shorter direction.
  EXPECT_LT(worst_rad, Rad(10));
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kSettle);
}

TEST(Simulator, NoDescentWithoutVisionAndTheApprovalExpires) {
  Flight flight(Options(9));
  flight.simulator.Send(flight.MakeApproval({15.7, 0, 0}));
  EXPECT_TRUE(flight.StepUntil(VehicleMode::kAlign, 1));
  flight.StepSeconds(29);
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kAlign);
  EXPECT_TRUE(flight.StepUntil(VehicleMode::kHold, 3));
  EXPECT_EQ(flight.last->status->approval_id, 0u);
  EXPECT_NEAR(flight.last->truth.back().X_WB.p.z(), -15.24, 0.5);
}

struct RefusalCase {
  const char* name;
  void (*spoil)(Approval&, const FrameBundle&);
  const char* reason;
};

TEST(Simulator, RefusesApprovalsThatAreNotForThisMoment) {
  const RefusalCase cases[] = {
      {"expired",
       [](Approval& a, const FrameBundle& b) { a.expires_at = AddSeconds(b.time, -0.01); },
       "expired"},
      {"wrong boot", [](Approval& a, const FrameBundle&) { a.vehicle_boot_id += 2; },
       "another start"},
      {"not finite", [](Approval& a, const FrameBundle&) { a.p_WS.y() = NAN; }, "finite"},
      {"glide slope", [](Approval& a, const FrameBundle&) { a.glide_slope_rad = 0.05; },
       "glide slope"},
      {"far away", [](Approval& a, const FrameBundle&) { a.p_WS.x() = 500; }, "100 m"},
      {"signature", [](Approval& a, const FrameBundle&) { a.signature = {1}; }, "forged"},
  };
  for (const RefusalCase& c : cases) {
    SimulatorOptions options = Options(10);
    options.verify = [](const Approval& a, Timestamp, std::uint64_t) {
      return a.signature.empty() ? std::string() : std::string("forged");
    };
    Flight flight(options);
    Approval approval = flight.MakeApproval({15.7, 0, 0});
    c.spoil(approval, *flight.last);
    flight.simulator.Send(approval);
    flight.Step();
    ASSERT_EQ(flight.acks.size(), 1u) << c.name;
    EXPECT_EQ(flight.acks[0].result, AckResult::kRefused) << c.name;
    EXPECT_EQ(flight.acks[0].command_id, approval.id) << c.name;
    EXPECT_NE(flight.acks[0].reason.find(c.reason), std::string::npos) << flight.acks[0].reason;
    EXPECT_EQ(flight.last->status->mode, VehicleMode::kHover) << c.name;
  }
}

TEST(Simulator, AnApprovalWorksOnce) {
  Flight flight(Options(11));
  const Approval approval = flight.MakeApproval({15.7, 0, 0});
  flight.simulator.Send(approval);
  flight.StepSeconds(1);
  flight.simulator.Send(HoldRequest{500, "operator"});
  flight.Step();
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kHold);
  flight.simulator.Send(approval);
  flight.Step();
  ASSERT_EQ(flight.acks.size(), 3u);
  EXPECT_EQ(flight.acks[0].result, AckResult::kAccepted);
  EXPECT_EQ(flight.acks[1].command_id, 500u);
  EXPECT_EQ(flight.acks[2].result, AckResult::kRefused);
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kHold);
}

TEST(Simulator, SilentVisionHoldsThenClimbs) {
  Flight flight(Options(12));
  flight.simulator.Send(flight.MakeApproval({15.7, 0, 0}));
  flight.estimates_on = true;
  ASSERT_TRUE(flight.StepUntil(VehicleMode::kDescend, 60));
  flight.StepSeconds(6);
  flight.estimates_on = false;
  flight.StepSeconds(1.4);
  // Held: still its own descent and still on vision, but stopping (the slope is flown at 1.4 m/s).
  EXPECT_TRUE(flight.last->status->flies_on_vision);
  flight.StepSeconds(0.4);
  EXPECT_LT(flight.last->truth.back().v_WB.norm(), 0.7);
  const double low_m = -flight.last->truth.back().X_WB.p.z();
  EXPECT_TRUE(flight.StepUntil(VehicleMode::kAbort, 1));
  EXPECT_FALSE(flight.last->status->flies_on_vision);
  EXPECT_EQ(flight.last->status->approval_id, 0u);
  EXPECT_TRUE(flight.StepUntil(VehicleMode::kHover, 30));
  const double high_m = -flight.last->truth.back().X_WB.p.z();
  EXPECT_GT(high_m, low_m + 3);
  EXPECT_LT(high_m, 15.24 + 0.7);
}

TEST(Simulator, AFrozenSenderIsStaleToo) {
  Flight flight(Options(13));
  flight.simulator.Send(flight.MakeApproval({15.7, 0, 0}));
  flight.estimates_on = true;
  ASSERT_TRUE(flight.StepUntil(VehicleMode::kDescend, 60));
  flight.estimates_on = false;
  PositionEstimate same;
  same.time = flight.last->time;
  same.source = EstimateSource::kVision;
  same.healthy = true;
  same.approval_id = flight.approval_id;
  same.p_WB = flight.last->truth.back().X_WB.p;
  bool aborted = false;
  for (int i = 0; i < 30 && !aborted; ++i) {
    flight.simulator.Send(same);
    aborted = flight.Step()->status->mode == VehicleMode::kAbort;
  }
  EXPECT_TRUE(aborted);
}

TEST(Simulator, AbortClimbsBackFromTheDescent) {
  Flight flight(Options(14));
  flight.simulator.Send(flight.MakeApproval({15.7, 0, 0}));
  flight.estimates_on = true;
  ASSERT_TRUE(flight.StepUntil(VehicleMode::kSink, 90));
  flight.simulator.Send(AbortRequest{77, "wave-off"});
  double lowest_m = 1e9, fastest_mps = 0;
  ASSERT_EQ(flight.Step()->status->mode, VehicleMode::kAbort);
  for (int i = 0; i < 200 && flight.last->status->mode == VehicleMode::kAbort; ++i) {
    for (const Truth& truth : flight.Step()->truth) {
      lowest_m = std::min(lowest_m, -(truth.X_WB * SkidCentreBody()).z());
      fastest_mps = std::max(fastest_mps, -truth.v_WB.z());
    }
  }
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kHover);
  EXPECT_GT(lowest_m, 1.0);
  EXPECT_NEAR(fastest_mps, 1.5, 0.4);
  EXPECT_NEAR(flight.last->truth.back().X_WB.p.z(), -15.24, 0.7);
  EXPECT_EQ(flight.acks.back().command_id, 77u);
}

void AddAll(ContentHash& hash, const FrameBundle& b) {
  const auto add = [&](Timestamp t, const auto& m) {
    hash.Add(t.us);
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      hash.Add(m.data()[i]);
    }
  };
  for (const VehiclePose& pose : b.poses) {
    add(pose.time, pose.X_WB.R);
    add(pose.time, pose.X_WB.p);
  }
  for (const ImuSample& imu : b.imu) {
    add(imu.time, imu.specific_force_B);
    add(imu.time, imu.angular_rate_B);
  }
  for (const GpsFix& fix : b.gps) {
    add(fix.time, fix.p_WB);
  }
  for (const LaserRange& laser : b.laser) {
    hash.Add(laser.range_m);
  }
  for (const Truth& truth : b.truth) {
    add(truth.time, truth.X_WB.p);
  }
}

std::uint64_t HashOfFlight(std::uint64_t seed) {
  SimulatorOptions options = Options(seed);
  options.wind = {3, 1, 5};
  Flight flight(options);
  flight.simulator.Send(flight.MakeApproval({15, 2, 0}));
  flight.estimates_on = true;
  ContentHash hash;
  for (int i = 0; i < 300; ++i) {
    AddAll(hash, *flight.Step());
  }
  return hash.value();
}

TEST(Simulator, OneSeedIsOneFlight) {
  EXPECT_EQ(HashOfFlight(21), HashOfFlight(21));
  EXPECT_NE(HashOfFlight(21), HashOfFlight(22));
}

TEST(Simulator, BundlesCarryEverySensorAtItsRate) {
  Flight flight(Options(15));
  std::size_t gps = 0;
  for (int i = 0; i < 20; ++i) {
    const Bundle b = flight.Step();
    EXPECT_EQ(b->sequence, static_cast<std::uint64_t>(i + 2));
    EXPECT_EQ(b->time.us, Simulator::kEpoch.us + 100'000 * (i + 2));
    EXPECT_EQ(b->imu.size(), 10u);
    EXPECT_EQ(b->poses.size(), 5u);
    EXPECT_EQ(b->truth.size(), 5u);
    EXPECT_EQ(b->laser.size(), 2u);
    EXPECT_EQ(b->pose_at_exposure->time, b->time);
    EXPECT_EQ(b->stereo, nullptr);
    EXPECT_TRUE(b->status->simulated);
    gps += b->gps.size();
    for (const GpsFix& fix : b->gps) {
      EXPECT_NEAR(SecondsBetween(fix.time, b->time), 0.1, 1e-9);
    }
  }
  EXPECT_EQ(gps, 10u);
}

/// Draws the position of the camera into the first pixels.
class ConstantCamera final : public SceneCamera {
 public:
  Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform& X_WC) override {
    return ImageU8(camera.width, camera.height,
                   X_WC.p.y() < 0 ? std::uint8_t{100} : std::uint8_t{120});
  }
};

TEST(Simulator, PicturesCarryNoiseAndGain) {
  SimulatorOptions options = Options(16);
  options.render = true;
  options.brightness_gain_right = 1.25;
  Simulator simulator(options, [](const Scene&) -> Result<std::unique_ptr<SceneCamera>> {
    return std::unique_ptr<SceneCamera>(std::make_unique<ConstantCamera>());
  });
  const Bundle bundle = simulator.Next({}).value();
  ASSERT_NE(bundle->stereo, nullptr);
  EXPECT_EQ(bundle->stereo->time, bundle->time);
  const auto moments = [](const ImageU8& image) {
    double sum = 0, squares = 0;
    for (const std::uint8_t pixel : image.pixels()) {
      sum += pixel;
      squares += static_cast<double>(pixel) * pixel;
    }
    const double n = static_cast<double>(image.pixels().size());
    return Eigen::Vector2d(sum / n, std::sqrt(squares / n - sum / n * (sum / n)));
  };
  const Eigen::Vector2d left = moments(bundle->stereo->left),
                        right = moments(bundle->stereo->right);
  EXPECT_NEAR(left[0], 100, 0.05);
  EXPECT_NEAR(right[0], 150, 0.05);
  EXPECT_NEAR(left[1], 2, 0.06);
  EXPECT_NEAR(right[1], 2, 0.06);
}

TEST(Simulator, PauseStepAndTheEnd) {
  SimulatorOptions options = Options(17);
  options.duration_limit_s = 0.3;
  Simulator simulator(options, nullptr);
  std::stop_source stopped;
  stopped.request_stop();
  simulator.Control({PlaybackControl::Kind::kPause, 0});
  EXPECT_TRUE(simulator.Status().paused);
  EXPECT_EQ(simulator.Next(stopped.get_token()).error().code, ErrorCode::kEnd);
  simulator.Control({PlaybackControl::Kind::kStepForward, 0});
  EXPECT_EQ(simulator.Next({}).value()->sequence, 1u);
  EXPECT_TRUE(simulator.Status().paused);
  simulator.Control({PlaybackControl::Kind::kPlay, 0});
  EXPECT_TRUE(simulator.Next({}).ok());
  EXPECT_TRUE(simulator.Next({}).ok());
  EXPECT_EQ(simulator.Next({}).error().code, ErrorCode::kEnd);
  EXPECT_TRUE(simulator.Status().ended);
  EXPECT_EQ(simulator.Status().kind, SourceKind::kSimulation);
}

}  // namespace
}  // namespace palace
