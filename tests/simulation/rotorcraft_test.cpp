// The identified hover model, as its file tells it, against its published modes.
#include "engine/simulation/rotorcraft.h"

#include <cmath>
#include <complex>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "engine/simulation/vehicle_description.h"

namespace palace {
namespace {

using State = RotorcraftState;
using Matrix13 = Eigen::Matrix<double, 13, 13>;
using Vector13 = Eigen::Matrix<double, 13, 1>;

RotorcraftParameters R50() { return std::get<RotorcraftParameters>(DefaultVehicle().model); }

/// Small-perturbation state: body velocity (3), rates (3), roll, pitch, a b c d r_fb.
State::Vector FromSmall(const Vector13& s) {
  State::Vector x = State::Vector::Zero();
  x.segment<3>(RigidBody::kVelocity) = s.segment<3>(0);
  x.segment<3>(RigidBody::kRate) = s.segment<3>(3);
  const Eigen::Quaterniond q(RotationFromEuler({s[6], s[7], 0}));
  x.segment<4>(RigidBody::kQuaternion) << q.w(), q.x(), q.y(), q.z();
  x.segment<5>(State::kA) = s.segment<5>(8);
  return x;
}

Vector13 ToSmallDerivative(const State::Vector& dx) {
  Vector13 ds;
  ds << dx.segment<3>(RigidBody::kVelocity), dx.segment<3>(RigidBody::kRate),
      2 * dx[RigidBody::kQuaternion + 1], 2 * dx[RigidBody::kQuaternion + 2],
      dx.segment<5>(State::kA);
  return ds;
}

Matrix13 Linearise(const Rotorcraft& rotorcraft) {
  Matrix13 A;
  const double h = 1e-5;
  for (int i = 0; i < 13; ++i) {
    const Vector13 step = h * Vector13::Unit(i);
    const auto at = [&](const Vector13& s) {
      return ToSmallDerivative(rotorcraft.Derivative(FromSmall(s), {}, {}));
    };
    A.col(i) = (at(step) - at(-step)) / (2 * h);
  }
  return A;
}

struct Mode {
  const char* name;
  std::complex<double> root;
  double rounding;  ///< half a unit of the last printed digit
};

TEST(Rotorcraft, HoverModesAreThePublishedOnes) {
  const std::vector<Mode> published = {
      {"unstable phugoid-like", {0.306, 0.094}, 0.0005},
      {"stable phugoid-like", {-0.401, 0.086}, 0.0005},
      {"heave", {-0.608, 0}, 0.0005},
      {"pitch fuselage/rotor/bar", {-1.70, 8.19}, 0.005},
      {"roll fuselage/rotor/bar", {-2.66, 11.56}, 0.005},
      {"yaw with damper", {-6.20, 8.20}, 0.005},
      {"fast flap", {-20.3, 4.74}, 0.05},
  };
  const Rotorcraft rotorcraft(R50(), Eigen::Vector3d::Zero(), 0);
  const Eigen::EigenSolver<Matrix13> solver(Linearise(rotorcraft), false);
  for (const Mode& mode : published) {
    double nearest = 1e9;
    for (int i = 0; i < 13; ++i) {
      const std::complex<double> root = solver.eigenvalues()[i];
      nearest = std::min(nearest, std::max(std::abs(root.real() - mode.root.real()),
                                           std::abs(root.imag() - mode.root.imag())));
    }
    EXPECT_LE(nearest, mode.rounding + 1e-3) << mode.name << "\n" << solver.eigenvalues();
    EXPECT_LE(nearest, 0.01 * std::abs(mode.root)) << mode.name;
  }
}

TEST(Rotorcraft, SteadyClimbPerCollectiveIsZcolOverZw) {
  Rotorcraft rotorcraft(R50(), Eigen::Vector3d::Zero(), 0);
  StickCommand stick;
  stick.col = 0.02;
  // Heave alone: a short look at the initial acceleration, then the closed form of a first order.
  const double step_s = Rotorcraft::kStep_s;
  for (int i = 0; i < 40; ++i) {
    rotorcraft.Step(stick, {});
  }
  const double t = 40 * step_s, zw = -0.614, zcol = -45.8 * 0.3048;
  const double expected = zcol * stick.col / -zw * (1 - std::exp(zw * t));
  EXPECT_NEAR(rotorcraft.body().v_WB().z(), expected, 0.01 * std::abs(expected));
}

TEST(Rotorcraft, PedalActsAfterItsDelay) {
  Rotorcraft rotorcraft(R50(), Eigen::Vector3d::Zero(), 0);
  StickCommand stick;
  stick.ped = 0.1;
  int steps = 0;
  while (rotorcraft.body().angular_rate_B.z() == 0 && steps < 100) {
    rotorcraft.Step(stick, {});
    ++steps;
  }
  EXPECT_EQ(steps, 20);  // 0.0991 s on a grid of 5 ms: the 20th step is the first to see it
}

TEST(Rotorcraft, QuietHoverReadsGravityAndStays) {
  Rotorcraft rotorcraft(R50(), {1, 2, -15}, 0.3);
  rotorcraft.Step({}, {});
  EXPECT_TRUE(rotorcraft.SpecificForce().isApprox(Eigen::Vector3d(0, 0, -9.80665), 1e-12));
  EXPECT_TRUE(rotorcraft.body().p_WB.isApprox(Eigen::Vector3d(1, 2, -15), 1e-12));
}

}  // namespace
}  // namespace palace
