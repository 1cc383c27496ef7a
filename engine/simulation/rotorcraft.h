// Rotorcraft: the Yamaha R-50 as an identified 13-state hover model inside full non-linear
// rigid-body kinematics, integrated by Runge-Kutta 4 at 200 Hz.
//
//   aerodynamics (body axes x forward, y right, z down; velocities relative to the air):
//     f_x = Xu u + Xa a                p' = Lu u + Lv v + Lb b
//     f_y = Yv v + Yb b                q' = Mu u + Mv v + Ma a
//     f_z = Za a + Zb b + Zw w + Zr r + Zcol col - g
//     r'  = Nv v + Np p + Nw w + Nr r + Nrfb r_fb + Nped ped(t - tau_p) + Ncol col
//     r_fb' = Kr r + Krfb r_fb                                            (yaw damper)
//     tau_f a' = -a - tau_f q + Ab b + Ac c + Alat lat + Alon lon         (rotor flap)
//     tau_f b' = -b - tau_f p + Ba a + Bd d + Blat lat + Blon lon
//     tau_s c' = -c - tau_s q + Clon lon                                  (stabiliser bar)
//     tau_s d' = -d - tau_s p + Dlat lat
//   kinematics: v_B' = f + R_BW g_W - omega x v_B, p_W' = R_WB v_B, quaternion attitude
//
// Trim thrust is -g on body z. Valid near hover: |v| below about 5 m/s, tilt below about 20
// degrees. Source: B. Mettler, T. Kanade, M. Tischler, "System Identification Modeling of a
// Model-Scale Helicopter", CMU-RI-TR-00-03, 2000 (hover, explicit bar). Left out: ground effect,
// h_cg (a sensor offset, no dynamics).
#pragma once

#include <array>

#include "engine/flight/controllers.h"

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

/// Hover column of the R-50. The values were recalled, not copied from the report's table; they
/// reproduce its eigenvalues (tests/simulation/rotorcraft_test.cpp).
RotorcraftParameters R50Hover();

/// SI. `p`, `v_B`, attitude (w x y z), body rates, then rotor a b, bar c d, and the yaw damper.
struct RotorcraftState {
  enum Index {
    kPosition = 0,
    kVelocity = 3,
    kQuaternion = 6,
    kRate = 10,
    kA = 13,
    kB,
    kC,
    kD,
    kRfb
  };
  static constexpr int kSize = 18;
  using Vector = Eigen::Matrix<double, kSize, 1>;
  Vector x = Vector::Zero();

  Eigen::Vector3d p_WB() const { return x.segment<3>(kPosition); }
  Eigen::Vector3d v_B() const { return x.segment<3>(kVelocity); }
  Eigen::Vector3d angular_rate_B() const { return x.segment<3>(kRate); }
  Eigen::Matrix3d R_WB() const;
  Eigen::Vector3d v_WB() const { return R_WB() * v_B(); }
};

class Rotorcraft {
 public:
  /// Hovering at rest in still air.
  Rotorcraft(const RotorcraftParameters& parameters, const Eigen::Vector3d& p_WB, double yaw_rad);

  static constexpr double kStep_s = 0.005;
  /// One step of kStep_s with the sticks and the wind (velocity of the air in W) held.
  void Step(const StickCommand& stick, const Eigen::Vector3d& wind_W);
  /// Rotor thrust off, at rest where it is. Steps change nothing any more.
  void Freeze();

  const RotorcraftState& state() const { return state_; }
  bool frozen() const { return frozen_; }
  /// What an ideal accelerometer at B reads, m/s^2.
  Eigen::Vector3d SpecificForce() const;
  /// Time derivative of the state; the pedal argument is the delayed one.
  RotorcraftState::Vector Derivative(const RotorcraftState::Vector& x, const StickCommand& stick,
                                     const Eigen::Vector3d& wind_W) const;

 private:
  static constexpr int kPedalHistory = 32;
  Eigen::Vector3d AeroForce(const RotorcraftState::Vector& x, double col,
                            const Eigen::Vector3d& v_air_B) const;
  double DelayedPedal(double pedal);

  RotorcraftParameters si_;  ///< converted to metres
  RotorcraftState state_;
  std::array<double, kPedalHistory> pedal_{};
  int pedal_head_ = 0;
  StickCommand last_stick_;
  Eigen::Vector3d last_wind_W_ = Eigen::Vector3d::Zero();
  bool frozen_ = false;
};

}  // namespace palace
