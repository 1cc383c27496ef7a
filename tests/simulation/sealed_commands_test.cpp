// The simulated vehicle under forged commands and estimates, and under those of a stolen session.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/simulation/simulated_station.h"

namespace palace {
namespace {

TEST(Autopilot, WithAKeyOnlyWhatItsStationSealedIsObeyed) {
  SimulatorOptions options = Options(10);
  Key(options);
  Flight flight(options);
  Approval approval = flight.MakeApproval({15.7, 0, 0});
  flight.simulator.Send(approval);
  flight.Step();
  EXPECT_EQ(flight.acks.back().reason, "Not sealed");
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kHover);
  flight.Send(approval);
  ASSERT_TRUE(flight.StepUntil(VehicleMode::kAlign, 1));
  flight.simulator.Send(HoldRequest{5, "forged", {}});
  flight.Step();
  EXPECT_EQ(flight.acks.back().reason, "Not sealed");
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kAlign);
  flight.Send(HoldRequest{6, "own", {}});
  flight.Step();
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kHold);
  flight.simulator.Send(AbortRequest{7, "anybody"});
  flight.Step();
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kAbort) << "open by design";
}

/// Flies to the descent; 4 s into it `attack` is asked before every step what else to send.
struct Attacked {
  bool held = false;
  double held_after_s = NAN;
  double moved_m = 0;  ///< farthest from where it would have been, by the truth
  std::string reason;
};
Attacked FlyAttacked(std::uint64_t seed,
                     const std::function<void(Flight&, double since_s)>& attack) {
  const auto fly = [&](bool attacked, std::vector<Vector3d>& track) {
    SimulatorOptions options = Options(seed);
    Key(options);
    Flight flight(options);
    flight.Send(flight.MakeApproval({15.7, 0, 0}));
    flight.estimates_on = true;
    Attacked result;
    if (!flight.StepUntil(VehicleMode::kDescend, 60)) {
      return result;
    }
    flight.StepSeconds(4);
    for (int i = 0; i < 60; ++i) {
      if (attacked) {
        attack(flight, 0.1 * i);
      }
      flight.Step();
      if (!result.held && flight.last->status->mode == VehicleMode::kHold) {
        result.held = true;
        result.held_after_s = 0.1 * (i + 1);
        result.reason = flight.acks.back().reason;
      }
      if (!result.held) {
        track.push_back(flight.last->truth.back().X_WB.p);
      }
    }
    return result;
  };
  std::vector<Vector3d> nominal, track;
  (void)fly(false, nominal);
  Attacked result = fly(true, track);
  for (std::size_t i = 0; i < std::min(nominal.size(), track.size()); ++i) {
    result.moved_m = std::max(result.moved_m, (track[i] - nominal[i]).norm());
  }
  return result;
}

// Ten forged estimates a step between the true ones: without a seal not one of them moves anything.
TEST(Autopilot, ForgedEstimatesMoveNothing) {
  const Attacked attacked = FlyAttacked(12, [](Flight& flight, double since_s) {
    PositionEstimate forged;
    forged.time = flight.last->time;
    forged.source = EstimateSource::kVision;
    forged.healthy = true;
    forged.approval_id = flight.approval_id;
    forged.p_WB = flight.last->truth.back().X_WB.p + Vector3d(-0.5 * since_s, 0, 0);
    forged.v_WB = flight.last->truth.back().v_WB;
    for (int i = 0; i < 10; ++i) {
      forged.time.us += 1;
      flight.simulator.Send(forged);
    }
  });
  EXPECT_FALSE(attacked.held);
  EXPECT_EQ(attacked.moved_m, 0) << "to the bit";
}

// A stolen session key: 3 m in 6 s, as velocity or against it. The vehicle's own solution holds it.
TEST(Autopilot, EstimatesThatLeaveTheVehiclesOwnSolutionHoldInTime) {
  for (const std::uint64_t seed : {12, 13, 14, 15, 16}) {
    for (const bool with_velocity : {false, true}) {
      for (const Vector3d& direction :
           {Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(0, 0, -1)}) {
        const Attacked attacked = FlyAttacked(seed, [&](Flight& flight, double since_s) {
          flight.vision_offset_W = 0.5 * since_s * direction;
          flight.vision_offset_v_W = with_velocity ? Vector3d(0.5 * direction) : Vector3d::Zero();
        });
        SCOPED_TRACE(seed);
        EXPECT_TRUE(attacked.held);
        EXPECT_LE(attacked.held_after_s, 2.0);
        EXPECT_LE(attacked.moved_m, 0.5);
        EXPECT_EQ(attacked.reason.find("The position estimate moved"), 0u) << attacked.reason;
      }
    }
  }
}

TEST(Autopilot, CommandHandedOverInTheDescentHolds) {
  SimulatorOptions options = Options(12);
  Key(options);
  Flight flight(options);
  flight.Send(flight.MakeApproval({15.7, 0, 0}));
  flight.estimates_on = true;
  ASSERT_TRUE(flight.StepUntil(VehicleMode::kDescend, 60));
  StationTrust trust;
  trust.station_id = 2;
  trust.station_name = "bravo";
  trust.key = options.keys->front();
  StationSession bravo(trust);
  while (!flight.last->authority) {
    flight.Step();
  }
  bravo.Hear(*flight.last->authority, 0);
  SessionRequest request;
  request.kind = SessionRequest::Kind::kTakeOver;
  VehicleMessage take = request;
  bravo.Seal(take, flight.last->time, 0);
  flight.simulator.Send(take);
  flight.Step();
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kHold);
  EXPECT_EQ(flight.last->status->approval_id, 0u);
  EXPECT_EQ(flight.acks.back().reason, "Command was handed over");
  ASSERT_TRUE(flight.last->authority.has_value());
  EXPECT_EQ(flight.last->authority->station_name, "bravo");
}

}  // namespace
}  // namespace palace
