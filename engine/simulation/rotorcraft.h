// Rotorcraft: a helicopter with stabiliser bar as an identified 13-state hover model inside full
// non-linear rigid-body kinematics (rigid_body.h), integrated by Runge-Kutta 4 at 200 Hz.
//
//   aerodynamics (body axes x forward, y right, z down; velocities relative to the air):
//     f_x = Xu u + Xa a                p' = Lu u + Lv v + Lb b
//     f_y = Yv v + Yb b                q' = Mu u + Mv v + Ma a
//     f_z = Za a + Zb b + Zw w + Zr r + Zcol col - g + (k - 1) (Zcol col - g)
//     r'  = Nv v + Np p + Nw w + Nr r + Nrfb r_fb + Nped ped(t - tau_p) + Ncol col
//     r_fb' = Kr r + Krfb r_fb                                            (yaw damper)
//     tau_f a' = -a - tau_f q + Ab b + Ac c + Alat lat + Alon lon         (rotor flap)
//     tau_f b' = -b - tau_f p + Ba a + Bd d + Blat lat + Blon lon
//     tau_s c' = -c - tau_s q + Clon lon                                  (stabiliser bar)
//     tau_s d' = -d - tau_s p + Dlat lat
//
// Trim thrust is -g on body z; k is the thrust in ground effect over that free of it. Valid near
// hover: |v| below about 5 m/s, tilt below about 20 degrees. Source: B. Mettler, T. Kanade,
// M. Tischler, "System Identification Modeling of a Model-Scale Helicopter", CMU-RI-TR-00-03, 2000
// (hover, explicit bar). Left out: h_cg (a sensor offset, no dynamics).
#pragma once

#include <array>

#include "engine/flight/controllers.h"
#include "engine/simulation/rigid_body.h"

namespace palace {

/// Identified derivatives, in the units of the source: feet, seconds, radians, normalised stick.
struct RotorcraftParameters {
  double tau_f, tau_s, tau_p;
  double Xu, Xa, Yv, Yb;
  double Lu, Lv, Lb, Mu, Mv, Ma;
  double Ab, Ac, Alat, Alon, Ba, Bd, Blat, Blon;
  double Za, Zb, Zw, Zr, Zcol;
  double Np, Nv, Nw, Nr, Nrfb, Nped, Ncol, Kr, Krfb;
  double Clon, Dlat;
};

/// The rigid body, then rotor a b, bar c d, and the yaw damper. SI.
struct RotorcraftState {
  static constexpr int kA = RigidBody::kSize, kB = kA + 1, kC = kA + 2, kD = kA + 3, kRfb = kA + 4,
                       kSize = kA + 5;
  using Vector = Eigen::Matrix<double, kSize, 1>;
};

class Rotorcraft {
 public:
  static constexpr double kStep_s = 0.005;
  static constexpr int kPedalHistory = 32;
  /// The pedal's delay is kept in steps: tau_p must be shorter.
  static constexpr double kLongestPedalDelay_s = kStep_s * (kPedalHistory - 2);

  /// Hovering at rest in still air.
  Rotorcraft(const RotorcraftParameters& parameters, const Eigen::Vector3d& p_WB, double yaw_rad);

  /// One step of kStep_s with the sticks and the surroundings held.
  void Step(const StickCommand& stick, const Surroundings& around);
  /// Rotor thrust off, at rest where it is. Steps change nothing any more.
  void Freeze();

  BodyState body() const { return BodyStateOf(x_.head<RigidBody::kSize>()); }
  bool frozen() const { return frozen_; }
  /// What an ideal accelerometer at B reads, m/s^2.
  Eigen::Vector3d SpecificForce() const;
  /// Time derivative of the state; the pedal argument is the delayed one.
  RotorcraftState::Vector Derivative(const RotorcraftState::Vector& x, const StickCommand& stick,
                                     const Surroundings& around) const;

 private:
  Eigen::Vector3d AeroForce(const RotorcraftState::Vector& x, double col,
                            const Eigen::Vector3d& v_air_B, double thrust_ratio) const;
  double DelayedPedal(double pedal);

  RotorcraftParameters si_;  ///< converted to metres
  RotorcraftState::Vector x_ = RotorcraftState::Vector::Zero();
  std::array<double, kPedalHistory> pedal_{};
  int pedal_head_ = 0;
  StickCommand last_stick_;
  Surroundings last_around_;
  bool frozen_ = false;
};

}  // namespace palace
