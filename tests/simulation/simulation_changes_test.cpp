// Time and changes of a simulation that runs: run to, step, wind, cameras; and one seed with one
// sequence of changes is one flight.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/hash.h"
#include "engine/model/mission/mission_status.h"
#include "tests/simulation/simulated_station.h"

namespace palace {
namespace {

using Kind = PlaybackControl::Kind;

double Seconds(const Bundle& bundle) { return SecondsBetween(Simulator::kEpoch, bundle->time); }

SimulationStatus StatusOf(const Simulator& simulator) { return *simulator.Status().simulation; }

/// Plays until it is paused; the last bundle.
Bundle RunOut(Simulator& simulator) {
  Bundle last;
  while (!simulator.Status().paused) {
    last = simulator.Next({}).value();
  }
  return last;
}

TEST(SimulationTime, ARunStopsAtTheFirstBundleAtOrAfterItsMoment) {
  for (const auto& [to_s, stops_s] : {std::pair{1.25, 1.3}, std::pair{1.3, 1.3}}) {
    Simulator simulator(Options(1), nullptr);
    simulator.Control({Kind::kPause, 0});
    simulator.Control({Kind::kRunTo, to_s});
    EXPECT_FALSE(simulator.Status().paused);
    EXPECT_EQ(StatusOf(simulator).run_to_s, to_s);
    EXPECT_NEAR(Seconds(RunOut(simulator)), stops_s, 1e-9);
    EXPECT_FALSE(StatusOf(simulator).run_to_s.has_value());
    simulator.Control({Kind::kRunTo, to_s});  // that is past now
    EXPECT_TRUE(simulator.Status().paused);
  }
}

TEST(SimulationTime, PlayPauseAndStepEndARun) {
  for (const Kind kind : {Kind::kPlay, Kind::kPause, Kind::kStepForward}) {
    Simulator simulator(Options(1), nullptr);
    simulator.Control({Kind::kRunTo, 1});
    simulator.Control({kind, 0});
    EXPECT_FALSE(StatusOf(simulator).run_to_s.has_value());
  }
}

TEST(SimulationTime, AStepIsOnePeriodOfTheRateInForceAndDoesNotDrift) {
  Simulator simulator(Options(1), nullptr);
  simulator.Control({Kind::kPause, 0});
  double before_s = 0;
  for (int i = 0; i < 5; ++i) {
    simulator.Control({Kind::kStepForward, 0});
    const double now_s = Seconds(simulator.Next({}).value());
    EXPECT_NEAR(now_s - before_s, 0.1, 1e-9);
    EXPECT_TRUE(simulator.Status().paused);
    before_s = now_s;
  }
  ASSERT_TRUE(simulator.Change({"simulation.rate_hz", 7}));
  for (int i = 1; i <= 70; ++i) {
    simulator.Control({Kind::kStepForward, 0});
    const double now_s = Seconds(simulator.Next({}).value());
    EXPECT_GE(now_s, before_s + i / 7.0 - 1e-9);
    EXPECT_LE(now_s, before_s + i / 7.0 + 0.005) << "the grid of physics";
  }
}

/// Remembers what it was asked to draw.
struct Asked {
  std::vector<PinholeCamera> cameras;
  std::vector<RigidTransform> poses;
};
class AskedCamera final : public SceneCamera {
 public:
  explicit AskedCamera(Asked& asked) : asked_(asked) {}
  Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform& X_WC,
                         double /*time_s*/) override {
    asked_.cameras.push_back(camera);
    asked_.poses.push_back(X_WC);
    return ImageU8(camera.width, camera.height, std::uint8_t{100});
  }

 private:
  Asked& asked_;
};

TEST(SimulationChanges, OtherCamerasReachRigPicturesAndLaser) {
  Asked asked;
  SimulatorOptions options = Options(2);
  options.render = true;
  Simulator simulator(options, [&](const World&) -> Result<std::unique_ptr<SceneCamera>> {
    return std::unique_ptr<SceneCamera>(std::make_unique<AskedCamera>(asked));
  });
  const Bundle before = simulator.Next({}).value();
  EXPECT_NEAR(StatusOf(simulator).in_force.field_of_view_deg, 45, 1e-6);
  ASSERT_TRUE(simulator.Change({"simulation.field_of_view_deg", 60}));
  ASSERT_TRUE(simulator.Change({"simulation.baseline_m", 0.5}));
  ASSERT_TRUE(simulator.Change({"simulation.tilt_deg", -90}));
  EXPECT_NEAR(StatusOf(simulator).in_force.field_of_view_deg, 45, 1e-6) << "only asked for";
  EXPECT_EQ(StatusOf(simulator).asked.field_of_view_deg, 60);
  const Bundle after = simulator.Next({}).value();
  EXPECT_EQ(StatusOf(simulator).in_force.field_of_view_deg, 60);

  SimulationSetup told;
  ReadRig(*after->rig, told);
  EXPECT_NEAR(told.field_of_view_deg, 60, 1e-9);
  EXPECT_EQ(told.baseline_m, 0.5);
  EXPECT_NEAR(told.tilt_deg, -90, 1e-9);
  EXPECT_EQ(before->rig->baseline_m, 1.0) << "a bundle that is out stays as it was";

  ASSERT_EQ(asked.cameras.size(), 4U);
  for (const std::size_t picture : {2U, 3U}) {
    EXPECT_NEAR(asked.cameras[picture].fx_px, 320 / std::tan(Rad(30)), 1e-9);
    EXPECT_NEAR(asked.poses[picture].R(2, 2), 1, 0.01) << "straight down";
  }
  EXPECT_NEAR((asked.poses[2].p - asked.poses[3].p).norm(), 0.5, 1e-9);
  EXPECT_GT(before->laser.back().range_m, 20) << "45 degrees at 15 m";
  EXPECT_LT(after->laser.back().range_m, 15.5);
}

TEST(SimulationChanges, WindBlowsFromTheNextBundleOn) {
  Flight flight(Options(3));
  EXPECT_EQ(flight.Step()->status->wind_speed_mps, 0);
  ASSERT_TRUE(flight.simulator.Change({"simulation.wind_mps", 6}));
  ASSERT_TRUE(flight.simulator.Change({"simulation.wind_from_deg", 90}));
  const Bundle bundle = flight.Step();
  EXPECT_GT(bundle->status->wind_speed_mps, 6) << "at 50 ft more than at 20 ft";
  EXPECT_NEAR(bundle->status->wind_from_rad, Rad(90), 1e-9);
  EXPECT_EQ(StatusOf(flight.simulator).in_force.wind_mps, 6);
}

std::uint64_t HashWith(const std::vector<std::pair<int, SimulationChange>>& changes) {
  Flight flight(Options(5));
  ContentHash hash;
  for (int i = 0; i < 100; ++i) {
    for (const auto& [at, change] : changes) {
      if (at == i) {
        EXPECT_TRUE(flight.simulator.Change(change));
      }
    }
    for (const Truth& truth : flight.Step()->truth) {
      hash.Add(truth.time.us);
      hash.Add(truth.X_WB.p.x());
      hash.Add(truth.X_WB.p.y());
    }
  }
  return hash.value();
}

TEST(SimulationChanges, OneSequenceOfThemIsOneFlight) {
  const std::vector<std::pair<int, SimulationChange>> changes = {
      {10, {"simulation.wind_mps", 8}},
      {40, {"simulation.rate_hz", 15}},
      {60, {"simulation.wind_from_deg", 200}},
      {80, {"simulation.wind_mps", 0}}};
  EXPECT_EQ(HashWith(changes), HashWith(changes));
  EXPECT_NE(HashWith(changes), HashWith({}));
}

TEST(SimulationChanges, AreCheckedAgainstLimitsThatAreNamed) {
  EXPECT_TRUE(CheckChange({"simulation.wind_mps", 20}));
  const auto why = [](const SimulationChange& change) {
    return CheckChange(change).error().message;
  };
  EXPECT_EQ(why({"simulation.wind_mps", 20.5}),
            "simulation.wind_mps = 20.5 must lie between 0 and 20 m/s");
  EXPECT_EQ(why({"simulation.tilt_deg", 10}),
            "simulation.tilt_deg = 10 must lie between -90 and 0 deg");
  EXPECT_NE(why({"simulation.baseline_m", NAN}).find("0.1 and 3 m"), std::string::npos);
  EXPECT_NE(why({"simulation.gravity", 9}).find("simulation.rate_hz"), std::string::npos);
}

TEST(SimulationChanges, LeaveTheRigAloneWhileASiteIsArmedOrFlownTo) {
  using S = MissionState;
  for (const S free : {S::kNoLive, S::kSearch, S::kProposed, S::kLanded}) {
    EXPECT_EQ(WhyRigStays(free), "");
  }
  for (const S bound : {S::kArmed, S::kApproved, S::kDescending, S::kHold, S::kAborting}) {
    EXPECT_NE(WhyRigStays(bound), "") << MissionStateName(bound);
  }
  for (const SimulationRow& row : SimulationTable()) {
    const bool calibrates = row.info.name == "simulation.field_of_view_deg" ||
                            row.info.name == "simulation.baseline_m" ||
                            row.info.name == "simulation.tilt_deg";
    EXPECT_EQ(row.of_rig, calibrates) << row.info.name;
  }
}

}  // namespace
}  // namespace palace
