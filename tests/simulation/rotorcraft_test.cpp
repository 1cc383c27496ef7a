// The identified hover model against its published modes, and the cascade that flies it.
#include "engine/simulation/rotorcraft.h"

#include <cmath>
#include <complex>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace palace {
namespace {

using Index = RotorcraftState::Index;
using Matrix13 = Eigen::Matrix<double, 13, 13>;
using Vector13 = Eigen::Matrix<double, 13, 1>;

/// Small-perturbation state: body velocity (3), rates (3), roll, pitch, a b c d r_fb.
RotorcraftState::Vector FromSmall(const Vector13& s) {
  RotorcraftState::Vector x = RotorcraftState::Vector::Zero();
  x.segment<3>(Index::kVelocity) = s.segment<3>(0);
  x.segment<3>(Index::kRate) = s.segment<3>(3);
  const Eigen::Quaterniond q(RotationFromEuler({s[6], s[7], 0}));
  x.segment<4>(Index::kQuaternion) << q.w(), q.x(), q.y(), q.z();
  x.segment<5>(Index::kA) = s.segment<5>(8);
  return x;
}

Vector13 ToSmallDerivative(const RotorcraftState::Vector& dx) {
  Vector13 ds;
  ds << dx.segment<3>(Index::kVelocity), dx.segment<3>(Index::kRate),
      2 * dx[Index::kQuaternion + 1], 2 * dx[Index::kQuaternion + 2], dx.segment<5>(Index::kA);
  return ds;
}

Matrix13 Linearise(const Rotorcraft& rotorcraft) {
  Matrix13 A;
  const double h = 1e-5;
  for (int i = 0; i < 13; ++i) {
    const Vector13 step = h * Vector13::Unit(i);
    const auto at = [&](const Vector13& s) {
      return ToSmallDerivative(rotorcraft.Derivative(FromSmall(s), {}, Eigen::Vector3d::Zero()));
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
  const Rotorcraft rotorcraft(R50Hover(), Eigen::Vector3d::Zero(), 0);
  const Eigen::EigenSolver<Matrix13> solver(Linearise(rotorcraft), false);
  for (const Mode& mode : published) {
    double nearest = 1e9;
    for (int i = 0; i < 13; ++i) {
      const std::complex<double> root = solver.eigenvalues()[i];
      nearest = std::min(nearest, std::max(std::abs(root.real() - mode.root.real()),
                                           std::abs(root.imag() - mode.root.imag())));
    }
    EXPECT_LE(nearest, mode.rounding + 1e-3) << mode.name << "\n" << solver.eigenvalues();
  }
}

TEST(Rotorcraft, SteadyClimbPerCollectiveIsZcolOverZw) {
  Rotorcraft rotorcraft(R50Hover(), Eigen::Vector3d::Zero(), 0);
  StickCommand stick;
  stick.col = 0.02;
  // Heave alone: a short look at the initial acceleration, then the closed form of a first order.
  const double step_s = Rotorcraft::kStep_s;
  for (int i = 0; i < 40; ++i) {
    rotorcraft.Step(stick, Eigen::Vector3d::Zero());
  }
  const double t = 40 * step_s, zw = -0.614, zcol = -45.8 * 0.3048;
  const double expected = zcol * stick.col / -zw * (1 - std::exp(zw * t));
  EXPECT_NEAR(rotorcraft.state().v_WB().z(), expected, 0.01 * std::abs(expected));
}

TEST(Rotorcraft, PedalActsAfterItsDelay) {
  Rotorcraft rotorcraft(R50Hover(), Eigen::Vector3d::Zero(), 0);
  StickCommand stick;
  stick.ped = 0.1;
  int steps = 0;
  while (rotorcraft.state().angular_rate_B().z() == 0 && steps < 100) {
    rotorcraft.Step(stick, Eigen::Vector3d::Zero());
    ++steps;
  }
  EXPECT_EQ(steps, 20);  // 0.0991 s on a grid of 5 ms: the 20th step is the first to see it
}

TEST(Rotorcraft, QuietHoverReadsGravityAndStays) {
  Rotorcraft rotorcraft(R50Hover(), {1, 2, -15}, 0.3);
  rotorcraft.Step({}, Eigen::Vector3d::Zero());
  EXPECT_TRUE(rotorcraft.SpecificForce().isApprox(Eigen::Vector3d(0, 0, -9.80665), 1e-12));
  EXPECT_TRUE(rotorcraft.state().p_WB().isApprox(Eigen::Vector3d(1, 2, -15), 1e-12));
}

TEST(Rotorcraft, CascadeFliesAStepWithATurn) {
  Rotorcraft rotorcraft(R50Hover(), {0, 0, -15}, 0);
  FlightController controller;
  const FlightSetpoint setpoint{{5, 3, -17}, Eigen::Vector3d::Zero(), Rad(60)};
  double worst_tilt = 0;
  StickCommand stick;
  for (int i = 0; i < 40 * 200; ++i) {
    if (i % 4 == 0) {
      const RotorcraftState& s = rotorcraft.state();
      stick = controller.Update(setpoint, {s.p_WB(), s.v_WB(), s.R_WB(), s.angular_rate_B()}, 0.02);
    }
    rotorcraft.Step(stick, Eigen::Vector3d::Zero());
    worst_tilt = std::max(worst_tilt, std::acos(std::min(1.0, rotorcraft.state().R_WB()(2, 2))));
  }
  EXPECT_LT((rotorcraft.state().p_WB() - setpoint.p_WB).norm(), 0.02);
  EXPECT_NEAR(EulerFromRotation(rotorcraft.state().R_WB()).yaw_rad, Rad(60), Rad(0.5));
  EXPECT_LT(worst_tilt, Rad(15));
}

}  // namespace
}  // namespace palace
