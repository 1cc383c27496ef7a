// The cascade that flies the built-in vehicles: position -> velocity -> attitude -> stick, run at
// 50 Hz. Its gains and limits are the vehicle's own (config/vehicles).
//
//   horizontal  v_c = Kpos e_p + v_ff            |v_c| <= max_speed
//               a_c = Kv e_v + Ki int e_v + a_ff |a_c| <= max_acceleration, integral frozen
//               while limited; theta_c = -a_x / g, phi_c = a_y / g in the heading frame
//   attitude    lat = Kphi (phi_c - phi) - Kp p,   lon = -(Kth (theta_c - theta) - Kq q)
//   vertical    vz_c = Kz e_z + vz_ff, +-max_climb,  col = -(Kw e_vz + Kwi int e_vz)
//   yaw         ped = Kpsi e_psi + Kpsii int e_psi, e_psi clipped
//
// Stick signs: +lat right, +lon nose down, +ped nose right, +col up; +-1 is full travel. The
// horizontal integral lives in W, so a turn of the heading does not turn the wind it has learnt.
#pragma once

#include "engine/core/frames.h"
#include "engine/core/units.h"

namespace palace {

/// Normalised stick positions, +-1 full travel.
struct StickCommand {
  double lat = 0;
  double lon = 0;
  double ped = 0;
  double col = 0;
};

/// What the vehicle believes of itself.
struct FlightState {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();
  Eigen::Vector3d angular_rate_B = Eigen::Vector3d::Zero();
};

/// Where B should be, and how the wanted point moves.
struct FlightSetpoint {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();  ///< feed-forward
  double yaw_rad = 0;
  Eigen::Vector3d a_WB = Eigen::Vector3d::Zero();  ///< feed-forward, horizontal part used
};

/// All 0: a cascade that moves no stick. The values of a vehicle stand in its file.
struct CascadeGains {
  double roll_per_rad = 0;
  double roll_rate_s = 0;
  double pitch_per_rad = 0;
  double pitch_rate_s = 0;
  double velocity_per_s = 0;
  double velocity_integral_per_s2 = 0;
  double position_per_s = 0;
  double tilt_lag_s = 0;  ///< from commanded tilt to acceleration
  double climb_s_per_m = 0;
  double climb_integral_per_m = 0;
  double height_per_s = 0;
  double yaw_per_rad = 0;
  double yaw_integral_per_rad_s = 0;
  double max_speed_mps = 0;
  double max_acceleration_mps2 = 0;
  double max_tilt_rad = 0;
  double max_climb_mps = 0;
  double max_collective = 0;
  double max_yaw_error_rad = 0;
};

class FlightController {
 public:
  explicit FlightController(const CascadeGains& gains) : gains_(gains) {}
  /// One control step of dt_s. Both arguments must be finite.
  StickCommand Update(const FlightSetpoint& setpoint, const FlightState& state, double dt_s);

 private:
  /// Commanded (roll, pitch) in radians.
  Eigen::Vector2d TiltForHorizontal(const FlightSetpoint& setpoint, const FlightState& state,
                                    double yaw_rad, double dt_s);
  double Collective(const FlightSetpoint& setpoint, const FlightState& state, double dt_s);
  double Pedal(double yaw_error_rad, double dt_s);

  CascadeGains gains_;
  Eigen::Vector2d velocity_integral_m_ = Eigen::Vector2d::Zero();  ///< int e_v in W
  double climb_integral_m_ = 0;
  double yaw_integral_rad_s_ = 0;
};

}  // namespace palace
