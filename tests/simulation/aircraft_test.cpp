// What is the same for every vehicle: its cascade flies it, its actuators and the ground near it.
#include "engine/simulation/aircraft.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/simulation/vehicle_file.h"

namespace palace {
namespace {

using Eigen::Vector3d;

class EveryVehicle : public testing::TestWithParam<std::string> {
 protected:
  const VehicleDescription vehicle_ = LoadVehicle(GetParam()).value();
};

TEST_P(EveryVehicle, ItsCascadeFliesAStepWithATurn) {
  Aircraft aircraft(vehicle_, {0, 0, -15}, 0);
  Actuators actuators(vehicle_.actuators, Aircraft::kStep_s);
  FlightController controller(vehicle_.gains);
  const FlightSetpoint setpoint{{5, 3, -17}, Vector3d::Zero(), Rad(60)};
  double worst_tilt = 0;
  for (int i = 0; i < 40 * 200; ++i) {
    if (i % 4 == 0) {
      const BodyState s = aircraft.body();
      actuators.Command(
          controller.Update(setpoint, {s.p_WB, s.v_WB(), s.R_WB, s.angular_rate_B}, 0.02));
    }
    aircraft.Step(actuators.Act(), Vector3d::Zero(), 15);
    worst_tilt = std::max(worst_tilt, std::acos(std::min(1.0, aircraft.body().R_WB(2, 2))));
  }
  EXPECT_LT((aircraft.body().p_WB - setpoint.p_WB).norm(), 0.02);
  EXPECT_NEAR(EulerFromRotation(aircraft.body().R_WB).yaw_rad, Rad(60), Rad(0.5));
  EXPECT_LT(worst_tilt, vehicle_.gains.max_tilt_rad + Rad(1));
}

TEST_P(EveryVehicle, HoldsStillInWind) {
  Aircraft aircraft(vehicle_, {0, 0, -15}, 0);
  Actuators actuators(vehicle_.actuators, Aircraft::kStep_s);
  FlightController controller(vehicle_.gains);
  const Vector3d wind(vehicle_.limits.max_wind_mps, 0, 0);
  for (int i = 0; i < 60 * 200; ++i) {
    if (i % 4 == 0) {
      const BodyState s = aircraft.body();
      actuators.Command(controller.Update({.p_WB = {0, 0, -15}},
                                          {s.p_WB, s.v_WB(), s.R_WB, s.angular_rate_B}, 0.02));
    }
    aircraft.Step(actuators.Act(), wind, 15);
  }
  EXPECT_LT((aircraft.body().p_WB - Vector3d(0, 0, -15)).norm(), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Of, EveryVehicle, testing::ValuesIn(VehicleNames()),
                         [](const auto& name) { return name.param; });

TEST(GroundEffect, IsCheesemanAndBennetts) {
  const GroundEffect off{false, 1.5, 0.5};
  EXPECT_EQ(ThrustRatio(off, 0.1), 1);
  const GroundEffect on{true, 1.5, 0.5};
  EXPECT_NEAR(ThrustRatio(on, 1.0), 1 / (1 - 0.0625), 1e-12);  // z = R: 6.7 %
  EXPECT_NEAR(ThrustRatio(on, 100), 1, 2e-5);
  EXPECT_EQ(ThrustRatio(on, -1), ThrustRatio(on, 0.25)) << "below half a radius it grows no more";
}

// The thrust at trim grows by the ratio: the vehicle gains (k - 1) g upwards.
TEST_P(EveryVehicle, ClimbsInGroundEffectByWhatItsThrustGains) {
  VehicleDescription vehicle = vehicle_;
  vehicle.ground_effect.on = true;
  const double height_m = 1.2;
  const double ratio = ThrustRatio(vehicle.ground_effect, height_m);
  Aircraft aircraft(vehicle, Vector3d::Zero(), 0);
  aircraft.Step({}, Vector3d::Zero(), height_m);
  const double gained = -aircraft.body().v_B.z() / Aircraft::kStep_s;
  EXPECT_NEAR(gained, (ratio - 1) * kStandardGravity_mps2, 0.01 * gained);
  EXPECT_GT(ratio, 1.001);
}

TEST(Actuators, DelayTravelAndRate) {
  Actuators plain({.delay_s = 0.02}, 0.005);
  plain.Command({.lat = 0.5});
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(plain.Act().lat, 0) << i;
  }
  EXPECT_EQ(plain.Act().lat, 0.5);
  Actuators slow({.delay_s = 0, .travel = 0.3, .rate_per_s = 10}, 0.005);
  slow.Command({.lat = 1, .col = -1});
  EXPECT_NEAR(slow.Act().lat, 0.05, 1e-12);
  for (int i = 0; i < 20; ++i) {
    slow.Act();
  }
  EXPECT_EQ(slow.Act().lat, 0.3);
  EXPECT_EQ(slow.Act().col, -0.3);
}

}  // namespace
}  // namespace palace
