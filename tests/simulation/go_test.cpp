// The simulated vehicle sent to another hover: there and no farther, and stopped like all else.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/simulation/simulated_station.h"

namespace palace {
namespace {

GoRequest To(const Flight& flight, const Vector3d& way, double heading_rad, std::uint64_t id = 90) {
  return {id,
          flight.last->status->boot_id,
          AddSeconds(flight.last->time, 5),
          flight.last->truth.back().X_WB.p + way,
          heading_rad,
          {}};
}

double Yaw(const Flight& flight) {
  return EulerFromRotation(flight.last->truth.back().X_WB.R).yaw_rad;
}

TEST(Go, FliesUpAndRoundThenLevelAndHoversThere) {
  Flight flight(Options(31));
  const Vector3d from = flight.last->truth.back().X_WB.p;
  const GoRequest go = To(flight, {9, 12, -4}, Rad(60));
  flight.simulator.Send(go);
  flight.Step();
  ASSERT_EQ(flight.acks.back().reason, "");
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kGo);
  double lowest_on_the_way_m = 1e9;
  for (int i = 0; i < 600 && flight.last->status->mode == VehicleMode::kGo; ++i) {
    flight.Step();
    const Vector3d now = flight.last->truth.back().X_WB.p;
    if ((now - from).head<2>().norm() > 1.5) {
      lowest_on_the_way_m = std::min(lowest_on_the_way_m, -now.z());
      EXPECT_LT(std::abs(WrapAngle(Yaw(flight) - Rad(60))), Rad(12)) << "it looks where it flies";
    }
  }
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kHover);
  EXPECT_GT(lowest_on_the_way_m, -go.p_WB.z() - 1) << "climbed first";
  flight.StepSeconds(5);
  EXPECT_LT((flight.last->truth.back().X_WB.p - go.p_WB).norm(), 3) << "GPS errs by metres";
  EXPECT_LT(std::abs(WrapAngle(Yaw(flight) - Rad(60))), Rad(4));
}

TEST(Go, ATurnOnTheSpotIsAWayToo) {
  Flight flight(Options(32));
  flight.simulator.Send(To(flight, {0, 0, 0}, Rad(-120)));
  ASSERT_TRUE(flight.StepUntil(VehicleMode::kGo, 1));
  ASSERT_TRUE(flight.StepUntil(VehicleMode::kHover, 40));
  EXPECT_LT(std::abs(WrapAngle(Yaw(flight) - Rad(-120))), Rad(4));
}

TEST(Go, TheVehicleAsksByItself) {
  struct Row {
    const char* reason;
    std::function<void(GoRequest&)> change;
  };
  for (const Row& row : std::vector<Row>{
           {"more than 100 m away", [](GoRequest& g) { g.p_WB.x() += 101; }},
           {"more than 50 m higher", [](GoRequest& g) { g.p_WB.z() -= 52; }},
           {"lower than the vehicle", [](GoRequest& g) { g.p_WB.z() += 3; }},
           {"not a number", [](GoRequest& g) { g.p_WB.y() = NAN; }},
           {"not a number", [](GoRequest& g) { g.heading_rad = INFINITY; }},
           {"another start", [](GoRequest& g) { g.vehicle_boot_id ^= 1; }},
           {"Expired", [](GoRequest& g) { g.expires_at = AddSeconds(g.expires_at, -6); }},
           {"longer than 10 s",
            [](GoRequest& g) { g.expires_at = AddSeconds(g.expires_at, 60); }}}) {
    Flight flight(Options(33));
    GoRequest go = To(flight, {5, 0, 0}, 0);
    row.change(go);
    flight.simulator.Send(go);
    flight.Step();
    ASSERT_FALSE(flight.acks.empty()) << row.reason;
    EXPECT_EQ(flight.acks.back().result, AckResult::kRefused) << row.reason;
    EXPECT_NE(flight.acks.back().reason.find(row.reason), std::string::npos)
        << flight.acks.back().reason;
    EXPECT_EQ(flight.last->status->mode, VehicleMode::kHover) << row.reason;
  }
}

TEST(Go, WithAKeyOnlyWhatItsStationSealedIsObeyed) {
  SimulatorOptions options = Options(34);
  Key(options);
  Flight flight(options);
  flight.simulator.Send(To(flight, {5, 0, 0}, 0));
  flight.Step();
  EXPECT_EQ(flight.acks.back().reason, "Not sealed");
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kHover);
  flight.Send(To(flight, {5, 0, 0}, 0, 91));
  EXPECT_TRUE(flight.StepUntil(VehicleMode::kGo, 1));
}

TEST(Go, StopsForAHoldClimbsForAWaveOffAndTakesAnApproval) {
  const auto under_way = [](Flight& flight) {
    flight.simulator.Send(To(flight, {40, 0, 0}, 0));
    flight.StepSeconds(6);
    return flight.last->status->mode == VehicleMode::kGo &&
           flight.last->truth.back().v_WB.norm() > 1;
  };
  Flight held(Options(35));
  ASSERT_TRUE(under_way(held));
  held.simulator.Send(HoldRequest{501, "operator", {}});
  ASSERT_TRUE(held.StepUntil(VehicleMode::kHold, 1));
  const Vector3d at = held.last->truth.back().X_WB.p;
  held.StepSeconds(10);
  EXPECT_LT((held.last->truth.back().X_WB.p - at).norm(), 6);
  EXPECT_LT(held.last->truth.back().v_WB.norm(), 0.5);

  Flight away(Options(35));
  ASSERT_TRUE(under_way(away));
  away.simulator.Send(AbortRequest{502, "operator"});
  EXPECT_TRUE(away.StepUntil(VehicleMode::kAbort, 1));

  Flight lands(Options(35));
  ASSERT_TRUE(under_way(lands));
  const Vector3d now = lands.last->truth.back().X_WB.p;
  lands.simulator.Send(lands.MakeApproval({now.x() + 20, now.y(), 0}));
  lands.estimates_on = true;
  EXPECT_TRUE(lands.StepUntil(VehicleMode::kDescend, 60));
}

TEST(Go, IsRefusedInADescent) {
  Flight flight(Options(36));
  flight.simulator.Send(flight.MakeApproval({15.7, 0, 0}));
  flight.estimates_on = true;
  ASSERT_TRUE(flight.StepUntil(VehicleMode::kDescend, 60));
  flight.simulator.Send(To(flight, {5, 0, 0}, 0));
  flight.Step();
  EXPECT_EQ(flight.acks.back().reason, "the vehicle is not in hover");
  EXPECT_EQ(flight.last->status->mode, VehicleMode::kDescend);
}

}  // namespace
}  // namespace palace
