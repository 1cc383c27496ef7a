// How stable the loop is that flies each vehicle, and how far its parameters may be off.
//
// The very code that flies is asked: aircraft, actuators and cascade, kicked by so little (1e-5)
// that what follows is linear, are flown in still air. Every mode dies or grows as exp(s t); after
// 30 s the slowest is left, and the real part of its s is the slope of the logarithm of how far the
// vehicle still moves, over the next 30 s. Above 0 the loop is unstable. That is the largest real
// part of the sampled loop's poles, its delays included, without a formula of the loop.
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/simulation/aircraft.h"
#include "engine/simulation/vehicle_file.h"

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kSeed = 2025;
constexpr int kLoops = 400;
constexpr double kKick = 1e-5;

Vector3d Kick(RandomStream& random) {
  const double x = random.Normal(), y = random.Normal(), z = random.Normal();
  return kKick * Vector3d(x, y, z);
}

/// Largest real part of the closed loop's modes, 1/s; infinite where it left the linear range.
double SlowestMode(const VehicleDescription& vehicle, std::uint64_t seed) {
  RandomStream random(seed, "kick");
  const Vector3d start = Kick(random);
  Aircraft aircraft(vehicle, start, Kick(random).x());
  Actuators actuators(vehicle.actuators, Aircraft::kStep_s);
  FlightController controller(vehicle.gains);
  const int control_steps =
      static_cast<int>(std::lround(1 / (Aircraft::kStep_s * vehicle.actuators.control_rate_hz)));
  const double period_s = 1 / vehicle.actuators.control_rate_hz;
  // The sticks are kicked for 0.1 s, which wakes every mode; then it is still.
  const auto steps = [](double time_s) {
    return static_cast<int>(std::lround(time_s / Aircraft::kStep_s));
  };
  const Vector3d kick_W = Kick(random);
  double first = 0, last = 0;
  for (int i = 0; i < steps(70); ++i) {
    const BodyState s = aircraft.body();
    if (i % control_steps == 0) {
      actuators.Command(
          controller.Update({}, {s.p_WB, s.v_WB(), s.R_WB, s.angular_rate_B}, period_s));
    }
    StickCommand stick = actuators.Act();
    if (i < 20) {
      stick.lat += kick_W.x(), stick.lon += kick_W.y(), stick.ped += kick_W.z();
    }
    aircraft.Step(stick, Vector3d::Zero(), 15);
    const double moves = s.p_WB.norm() + s.v_B.norm() + s.angular_rate_B.norm() +
                         std::abs(EulerFromRotation(s.R_WB).yaw_rad);
    if (!(moves < 1)) {
      return INFINITY;
    }
    double* window = i >= steps(60) ? &last : i >= steps(30) && i < steps(40) ? &first : nullptr;
    if (window != nullptr) {
      *window = std::max(*window, moves);
    }
  }
  return std::log(last / first) / 30;
}

double Off(RandomStream& random, double value, double share) {
  return value * random.Uniform(1 - share, 1 + share);
}

void Spoil(RotorcraftParameters& p, RandomStream& random, double share) {
  for (double* value :
       {&p.tau_f, &p.tau_s, &p.tau_p, &p.Xu, &p.Xa,   &p.Yv,   &p.Yb,   &p.Lu, &p.Lv, &p.Lb,
        &p.Mu,    &p.Mv,    &p.Ma,    &p.Ab, &p.Ac,   &p.Alat, &p.Alon, &p.Ba, &p.Bd, &p.Blat,
        &p.Blon,  &p.Za,    &p.Zb,    &p.Zw, &p.Zr,   &p.Zcol, &p.Np,   &p.Nv, &p.Nw, &p.Nr,
        &p.Nrfb,  &p.Nped,  &p.Ncol,  &p.Kr, &p.Krfb, &p.Clon, &p.Dlat}) {
    *value = Off(random, *value, share);
  }
}

void Spoil(MultirotorParameters& p, RandomStream& random, double share) {
  for (int axis = 0; axis < 3; ++axis) {
    p.inertia_kgm2[axis] = Off(random, p.inertia_kgm2[axis], share);
    p.drag_ns_per_m[axis] = Off(random, p.drag_ns_per_m[axis], share);
    p.rate_gain_per_s[axis] = Off(random, p.rate_gain_per_s[axis], share);
    p.max_rate_rad_s[axis] = Off(random, p.max_rate_rad_s[axis], share);
  }
  p.arm_m = Off(random, p.arm_m, share);
  p.torque_per_thrust_m = Off(random, p.torque_per_thrust_m, share);
  p.motor_lag_s = Off(random, p.motor_lag_s, share);
}

struct Robustness {
  int unstable = 0;
  double worst = -INFINITY;
};

Robustness Of(const VehicleDescription& nominal, double share, int loops) {
  RandomStream random(kSeed, "parameters");
  Robustness found;
  for (int i = 0; i < loops; ++i) {
    VehicleDescription vehicle = nominal;
    std::visit([&](auto& model) { Spoil(model, random, share); }, vehicle.model);
    const double mode = SlowestMode(vehicle, kSeed + static_cast<std::uint64_t>(i));
    found.unstable += mode < 0 ? 0 : 1;
    found.worst = std::max(found.worst, mode);
  }
  return found;
}

class ClosedLoop : public testing::TestWithParam<std::string> {
 protected:
  const VehicleDescription vehicle_ = LoadVehicle(GetParam()).value();
};

TEST_P(ClosedLoop, DecaysByADecadeInTwelveSeconds) {
  const double mode = SlowestMode(vehicle_, kSeed);
  std::printf("  %s: slowest mode %.3f 1/s\n", GetParam().c_str(), mode);
  EXPECT_LT(mode, -0.19);
}

TEST_P(ClosedLoop, NoneOf400IsUnstableWithEveryParameterOffByUpToAFifth) {
  const Robustness fifth = Of(vehicle_, 0.2, kLoops);
  std::printf("  %s, seed %d: %d of %d unstable at 20 %%, slowest mode of the worst %.3f 1/s\n",
              GetParam().c_str(), static_cast<int>(kSeed), fifth.unstable, kLoops, fifth.worst);
  EXPECT_EQ(fifth.unstable, 0) << "seed " << kSeed;
}

// That the measure can tell: the helicopter's roll loop has 6 dB to spare, twice its gain, before
// its flap modes grow.
TEST(ClosedLoopMeasure, SeesTheGainMargin) {
  VehicleDescription stiff = DefaultVehicle();
  stiff.gains.roll_per_rad = 1.5 * DefaultVehicle().gains.roll_per_rad;
  EXPECT_LT(SlowestMode(stiff, kSeed), -0.1);
  stiff.gains.roll_per_rad = 2.25 * DefaultVehicle().gains.roll_per_rad;
  EXPECT_GT(SlowestMode(stiff, kSeed), 0);
}

INSTANTIATE_TEST_SUITE_P(Of, ClosedLoop, testing::ValuesIn(VehicleNames()),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace palace
