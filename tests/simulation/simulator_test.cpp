// The simulator as a source: hover, rates, pictures, pause, and one seed that is one flight.
#include "engine/simulation/simulator.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/hash.h"
#include "tests/simulation/simulated_station.h"

namespace palace {
namespace {

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

std::uint64_t HashOfFlight(std::uint64_t seed, int bundles = 300, double speed = 0) {
  SimulatorOptions options = Options(seed);
  options.speed = speed;
  options.wind = {3, 1, 5};
  Flight flight(options);
  flight.simulator.Send(flight.MakeApproval({15, 2, 0}));
  flight.estimates_on = true;
  ContentHash hash;
  for (int i = 0; i < bundles; ++i) {
    AddAll(hash, *flight.Step());
  }
  return hash.value();
}

TEST(Simulator, OneSeedIsOneFlight) {
  EXPECT_EQ(HashOfFlight(21), HashOfFlight(21));
  EXPECT_NE(HashOfFlight(21), HashOfFlight(22));
}

TEST(Simulator, PacingChangesNothing) {
  EXPECT_EQ(HashOfFlight(23, 10, 0), HashOfFlight(23, 10, 100));
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

/// An even grey that tells the left camera from the right one.
class ConstantCamera final : public SceneCamera {
 public:
  Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform& X_WC,
                         double /*time_s*/) override {
    return ImageU8(camera.width, camera.height,
                   X_WC.p.y() < 0 ? std::uint8_t{100} : std::uint8_t{120});
  }
};

TEST(Simulator, PicturesCarryNoiseAndGain) {
  SimulatorOptions options = Options(16);
  options.render = true;
  options.vehicle.sensors.camera.brightness_gain_right = 1.25;
  Simulator simulator(options, [](const World&) -> Result<std::unique_ptr<SceneCamera>> {
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
