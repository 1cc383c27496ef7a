#include "engine/flight/controllers.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"

namespace palace {
namespace {

Eigen::Vector2d LimitNorm(const Eigen::Vector2d& v, double limit) {
  const double norm = v.norm();
  return norm > limit ? Eigen::Vector2d(v * (limit / norm)) : v;
}

double LimitStick(double value) { return std::clamp(value, -1.0, 1.0); }

}  // namespace

StickCommand FlightController::Update(const FlightSetpoint& setpoint, const FlightState& state,
                                      double dt_s) {
  PALACE_CHECK(setpoint.p_WB.allFinite() && setpoint.v_WB.allFinite(), setpoint.p_WB.transpose());
  PALACE_CHECK(state.p_WB.allFinite() && state.v_WB.allFinite(), state.p_WB.transpose());
  const EulerAngles attitude = EulerFromRotation(state.R_WB);
  const Eigen::Vector2d tilt = TiltForHorizontal(setpoint, state, attitude.yaw_rad, dt_s);
  const Eigen::Vector3d& rate = state.angular_rate_B;
  StickCommand stick;
  stick.lat = LimitStick(gains_.roll_per_rad * (tilt.x() - attitude.roll_rad) -
                         gains_.roll_rate_s * rate.x());
  stick.lon = LimitStick(
      -(gains_.pitch_per_rad * (tilt.y() - attitude.pitch_rad) - gains_.pitch_rate_s * rate.y()));
  stick.ped = Pedal(WrapAngle(setpoint.yaw_rad - attitude.yaw_rad), dt_s);
  stick.col = Collective(setpoint, state, dt_s);
  return stick;
}

Eigen::Vector2d FlightController::TiltForHorizontal(const FlightSetpoint& setpoint,
                                                    const FlightState& state, double yaw_rad,
                                                    double dt_s) {
  // The feed-forward tilts at once, the airframe follows tilt_lag_s later; feedback that compares
  // with the reference of that moment would count the lag as an error and charge its integral.
  const double lag = gains_.tilt_lag_s;
  const Eigen::Vector2d v_ff = (setpoint.v_WB - lag * setpoint.a_WB).head<2>();
  const Eigen::Vector2d position_error =
      (setpoint.p_WB - lag * setpoint.v_WB + lag * lag / 2 * setpoint.a_WB - state.p_WB).head<2>();
  const Eigen::Vector2d v_c =
      LimitNorm(gains_.position_per_s * position_error + v_ff, gains_.max_speed_mps);
  const Eigen::Vector2d velocity_error = v_c - state.v_WB.head<2>();
  const Eigen::Vector2d wanted = gains_.velocity_per_s * velocity_error +
                                 gains_.velocity_integral_per_s2 * velocity_integral_m_ +
                                 setpoint.a_WB.head<2>();
  const Eigen::Vector2d a_W = LimitNorm(wanted, gains_.max_acceleration_mps2);
  if (a_W == wanted) {
    velocity_integral_m_ += velocity_error * dt_s;
  }
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  const double forward = c * a_W.x() + s * a_W.y();
  const double right = -s * a_W.x() + c * a_W.y();
  const double limit = gains_.max_tilt_rad;
  return {std::clamp(right / kStandardGravity_mps2, -limit, limit),
          std::clamp(-forward / kStandardGravity_mps2, -limit, limit)};
}

double FlightController::Collective(const FlightSetpoint& setpoint, const FlightState& state,
                                    double dt_s) {
  const double v_c =
      std::clamp(gains_.height_per_s * (setpoint.p_WB.z() - state.p_WB.z()) + setpoint.v_WB.z(),
                 -gains_.max_climb_mps, gains_.max_climb_mps);
  const double error = v_c - state.v_WB.z();
  const double wanted =
      -(gains_.climb_s_per_m * error + gains_.climb_integral_per_m * climb_integral_m_);
  const double limited = std::clamp(wanted, -gains_.max_collective, gains_.max_collective);
  if (limited == wanted) {
    climb_integral_m_ += error * dt_s;
  }
  return limited;
}

double FlightController::Pedal(double yaw_error_rad, double dt_s) {
  const double error =
      std::clamp(yaw_error_rad, -gains_.max_yaw_error_rad, gains_.max_yaw_error_rad);
  const double wanted =
      gains_.yaw_per_rad * error + gains_.yaw_integral_per_rad_s * yaw_integral_rad_s_;
  const double limited = LimitStick(wanted);
  // A turn would charge the integral with an error that the turn itself removes.
  if (limited == wanted && std::abs(yaw_error_rad) < Rad(10)) {
    yaw_integral_rad_s_ += error * dt_s;
  }
  return limited;
}

}  // namespace palace
