// Multirotor: a quadrotor as a rigid body with four thrusts, flown by a rate controller of its own,
// integrated by Runge-Kutta 4 at 200 Hz. Rotors in an X, seen from above:
//
//        2   1       1, 3 turn against the clock (their drag yaws the body clockwise, +z),
//          X         2, 4 with it; l is the arm from the middle to a rotor, x_i = +-l / sqrt 2
//        3   4
//
//   thrust     f_i' = (f_ic - f_i) / tau_m                        motor and propeller lag
//   force      m f_B = -k sum f_i z - D v_air                     D: linear drag on each body axis
//   moment     M = sum (x_i x -f_i z) + sum +-c f_i z             c: rotor drag torque over thrust
//   rotation   J omega' = M - omega x J omega
//   rates      M_c = J K (omega_c - omega) + omega x J omega, K per axis, exact gyro
//   mixing     f_ic = T/4 and what gives M_c, each held within f_min .. f_max
//   sticks     omega_c = (lat, -lon, ped) times the largest rates, T = m g (1 + col)
//
// k is the thrust in ground effect over that free of it. So the sticks mean what they mean to the
// helicopter: +lat rolls right, +lon nose down, +ped nose right, +col climbs; the same cascade
// flies both. Source: textbook model (R. Mahony, V. Kumar, P. Corke, "Multirotor Aerial Vehicles",
// IEEE Robotics and Automation Magazine 19(3), 2012, eq. 1-8). Left out: blade flapping (the linear
// drag stands for it), battery sag, propeller inertia, drag of the moving air on the arms.
#pragma once

#include "engine/flight/controllers.h"
#include "engine/simulation/rigid_body.h"

namespace palace {

struct MultirotorParameters {
  double mass_kg = 0;
  Eigen::Vector3d inertia_kgm2 = Eigen::Vector3d::Zero();   ///< about x, y, z
  Eigen::Vector3d drag_ns_per_m = Eigen::Vector3d::Zero();  ///< forward, right, down
  Eigen::Vector3d rate_gain_per_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d max_rate_rad_s = Eigen::Vector3d::Zero();  ///< at full stick
  double arm_m = 0;
  double torque_per_thrust_m = 0;
  double motor_lag_s = 0;
  double min_thrust_n = 0;  ///< of one rotor
  double max_thrust_n = 0;
};

/// The rigid body, then the four thrusts, N.
struct MultirotorState {
  static constexpr int kThrust = RigidBody::kSize, kSize = kThrust + 4;
  using Vector = Eigen::Matrix<double, kSize, 1>;
};

class Multirotor {
 public:
  static constexpr double kStep_s = 0.005;

  /// Hovering at rest in still air.
  Multirotor(const MultirotorParameters& parameters, const Eigen::Vector3d& p_WB, double yaw_rad);

  /// One step of kStep_s with the sticks and the surroundings held.
  void Step(const StickCommand& stick, const Surroundings& around);
  /// Rotors off, at rest where it is. Steps change nothing any more.
  void Freeze();

  BodyState body() const { return BodyStateOf(x_.head<RigidBody::kSize>()); }
  bool frozen() const { return frozen_; }
  /// What an ideal accelerometer at B reads, m/s^2.
  Eigen::Vector3d SpecificForce() const;
  /// The thrusts asked of the motors, N, within their limits.
  Eigen::Vector4d Mix(const StickCommand& stick, const Eigen::Vector3d& rate_B) const;
  /// Time derivative of the state while these thrusts are asked for.
  MultirotorState::Vector Derivative(const MultirotorState::Vector& x,
                                     const Eigen::Vector4d& asked_n,
                                     const Surroundings& around) const;

 private:
  Eigen::Vector3d Force(const MultirotorState::Vector& x, const Eigen::Vector3d& v_air_B,
                        double thrust_ratio) const;

  MultirotorParameters p_;
  Eigen::Matrix4d effect_;  ///< (sum of thrust, moments) of the four thrusts
  Eigen::Matrix4d mixing_;  ///< its inverse
  MultirotorState::Vector x_ = MultirotorState::Vector::Zero();
  Surroundings last_around_;
  bool frozen_ = false;
};

}  // namespace palace
