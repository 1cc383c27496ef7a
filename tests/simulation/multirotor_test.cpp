// The quadrotor: sticks mean what they mean to the helicopter, thrusts stay in reach, forces
// balance.
#include "engine/simulation/multirotor.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/simulation/vehicle_file.h"

namespace palace {
namespace {

using Eigen::Vector3d;

MultirotorParameters Plain() {
  return std::get<MultirotorParameters>(LoadVehicle("multirotor").value().model);
}

Multirotor Flown(const StickCommand& stick, double time_s, const Surroundings& around = {}) {
  Multirotor multirotor(Plain(), Vector3d::Zero(), 0);
  for (int i = 0; i < std::lround(time_s / Multirotor::kStep_s); ++i) {
    multirotor.Step(stick, around);
  }
  return multirotor;
}

TEST(Multirotor, QuietHoverReadsGravityAndStays) {
  Multirotor multirotor(Plain(), {1, 2, -15}, 0.3);
  for (int i = 0; i < 2000; ++i) {
    multirotor.Step({}, {});
  }
  EXPECT_NEAR((multirotor.SpecificForce() - Vector3d(0, 0, -kStandardGravity_mps2)).norm(), 0,
              1e-12);
  EXPECT_NEAR((multirotor.body().p_WB - Vector3d(1, 2, -15)).norm(), 0, 1e-9);
}

TEST(Multirotor, SticksTurnIntoRatesAndClimb) {
  const MultirotorParameters p = Plain();
  EXPECT_NEAR(Flown({.lat = 0.1}, 0.6).body().angular_rate_B.x(), 0.1 * p.max_rate_rad_s.x(), 0.01);
  EXPECT_NEAR(Flown({.lon = 0.1}, 0.6).body().angular_rate_B.y(), -0.1 * p.max_rate_rad_s.y(),
              0.01);
  EXPECT_NEAR(Flown({.ped = 0.1}, 2.0).body().angular_rate_B.z(), 0.1 * p.max_rate_rad_s.z(), 0.01);
  const BodyState climbing = Flown({.col = 0.1}, 1).body();
  EXPECT_LT(climbing.v_WB().z(), -0.7);
  EXPECT_NEAR(climbing.R_WB(2, 2), 1, 1e-12);
}

// In steady air of speed V it drifts along until no drag is left: v = V (1 - exp(-D t / m)).
TEST(Multirotor, DriftsWithTheWindAsItsDragSays) {
  const MultirotorParameters p = Plain();
  const double t = 3;
  const Multirotor drifting = Flown({}, t, {.wind_W = {4, 0, 0}});
  EXPECT_NEAR(drifting.body().v_WB().x(), 4 * (1 - std::exp(-p.drag_ns_per_m.x() * t / p.mass_kg)),
              1e-6);
}

TEST(Multirotor, EveryThrustIsWithinItsMotorWhateverTheSticks) {
  RandomStream random(5);
  const MultirotorParameters p = Plain();
  const Multirotor multirotor(p, Vector3d::Zero(), 0);
  for (int i = 0; i < 2000; ++i) {
    const auto draw = [&] { return random.Uniform(-1, 1); };
    const StickCommand stick{draw(), draw(), draw(), draw()};
    const Vector3d rate(5 * draw(), 5 * draw(), 5 * draw());
    const Eigen::Vector4d asked = multirotor.Mix(stick, rate);
    ASSERT_GE(asked.minCoeff(), p.min_thrust_n) << "seed 5, draw " << i;
    ASSERT_LE(asked.maxCoeff(), p.max_thrust_n) << "seed 5, draw " << i;
  }
}

// In reach the four thrusts make the weight and the moments that were asked for.
TEST(Multirotor, MixingGivesTheMomentsAskedFor) {
  RandomStream random(6);
  const MultirotorParameters p = Plain();
  for (int i = 0; i < 200; ++i) {
    const auto draw = [&] { return random.Uniform(-0.03, 0.03); };
    const StickCommand stick{draw(), draw(), draw(), draw()};
    const Multirotor multirotor(p, Vector3d::Zero(), 0);
    MultirotorState::Vector x = MultirotorState::Vector::Zero();
    x.head<RigidBody::kSize>() = RestingBody(Vector3d::Zero(), 0);
    x.tail<4>() = multirotor.Mix(stick, Vector3d::Zero());
    const auto dx = multirotor.Derivative(x, x.tail<4>(), {});
    const Vector3d wanted = p.rate_gain_per_s.cwiseProduct(
        p.max_rate_rad_s.cwiseProduct(Vector3d(stick.lat, -stick.lon, stick.ped)));
    EXPECT_NEAR((dx.segment<3>(RigidBody::kRate) - wanted).norm(), 0, 1e-9) << "seed 6, draw " << i;
    EXPECT_NEAR(dx[RigidBody::kVelocity + 2], -kStandardGravity_mps2 * stick.col, 1e-9);
  }
}

}  // namespace
}  // namespace palace
