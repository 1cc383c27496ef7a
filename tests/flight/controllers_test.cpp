// Signs and limits of the cascade, seen from outside.
#include "engine/flight/controllers.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

/// Of an airframe that follows at once; what is right for real ones is shown in tests/simulation.
constexpr CascadeGains kGains{.roll_per_rad = 1.6,
                              .roll_rate_s = 0.1,
                              .pitch_per_rad = 1.9,
                              .pitch_rate_s = 0.14,
                              .velocity_per_s = 0.9,
                              .velocity_integral_per_s2 = 0.25,
                              .position_per_s = 0.35,
                              .tilt_lag_s = 0.5,
                              .climb_s_per_m = 0.2,
                              .climb_integral_per_m = 0.08,
                              .height_per_s = 0.7,
                              .yaw_per_rad = 0.55,
                              .yaw_integral_per_rad_s = 0.1,
                              .max_speed_mps = 4,
                              .max_acceleration_mps2 = 2.5,
                              .max_tilt_rad = Rad(15),
                              .max_climb_mps = 1.5,
                              .max_collective = 0.4,
                              .max_yaw_error_rad = Rad(30)};

struct SignCase {
  const char* name;
  Eigen::Vector3d p_W;   ///< set-point, the vehicle is at the origin
  double yaw_rad;        ///< of vehicle and set-point
  double lat, lon, col;  ///< expected sign: -1, 0 or 1
};

int Sign(double value) { return value > 1e-9 ? 1 : value < -1e-9 ? -1 : 0; }

TEST(FlightController, LeansTowardsTheSetpoint) {
  const double quarter = std::numbers::pi / 2;
  const SignCase cases[] = {
      {"north, facing north: nose down", {1, 0, 0}, 0, 0, 1, 0},
      {"east, facing north: right", {0, 1, 0}, 0, 1, 0, 0},
      {"south, facing north: nose up", {-1, 0, 0}, 0, 0, -1, 0},
      {"north, facing east: left", {1, 0, 0}, quarter, -1, 0, 0},
      {"east, facing east: nose down", {0, 1, 0}, quarter, 0, 1, 0},
      {"up: more collective", {0, 0, -1}, 0, 0, 0, 1},
      {"down: less collective", {0, 0, 1}, 0, 0, 0, -1},
  };
  for (const SignCase& c : cases) {
    FlightController controller(kGains);
    FlightState state;
    state.R_WB = RotationFromEuler({0, 0, c.yaw_rad});
    const StickCommand stick =
        controller.Update({c.p_W, Eigen::Vector3d::Zero(), c.yaw_rad}, state, 0.02);
    EXPECT_EQ(Sign(stick.lat), c.lat) << c.name;
    EXPECT_EQ(Sign(stick.lon), c.lon) << c.name;
    EXPECT_EQ(Sign(stick.col), c.col) << c.name;
    EXPECT_EQ(Sign(stick.ped), 0) << c.name;
  }
}

TEST(FlightController, TurnsTheShortWayRound) {
  FlightController controller(kGains);
  FlightState state;
  state.R_WB = RotationFromEuler({0, 0, Rad(170)});
  FlightSetpoint setpoint;
  setpoint.yaw_rad = Rad(-170);
  EXPECT_GT(controller.Update(setpoint, state, 0.02).ped, 0);
}

TEST(FlightController, SticksStayInReachHoweverFarTheSetpoint) {
  RandomStream random(31);
  FlightController controller(kGains);
  for (int i = 0; i < 5000; ++i) {
    FlightState state;
    state.R_WB = RotationFromEuler(
        {random.Uniform(-0.4, 0.4), random.Uniform(-0.4, 0.4), random.Uniform(-3, 3)});
    state.v_WB = {random.Uniform(-5, 5), random.Uniform(-5, 5), random.Uniform(-3, 3)};
    FlightSetpoint setpoint;
    setpoint.p_WB = {random.Uniform(-1e3, 1e3), random.Uniform(-1e3, 1e3),
                     random.Uniform(-1e3, 1e3)};
    const StickCommand stick = controller.Update(setpoint, state, 0.02);
    for (const double value : {stick.lat, stick.lon, stick.ped, stick.col}) {
      ASSERT_LE(std::abs(value), 1) << "step " << i;
    }
  }
}

}  // namespace
}  // namespace palace
