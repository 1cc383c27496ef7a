#include "engine/simulation/instrumented_aircraft.h"

#include <cmath>

namespace palace {

using Eigen::Vector3d;

InstrumentedAircraft::InstrumentedAircraft(const VehicleDescription& vehicle,
                                           const WindOptions& wind, std::uint64_t seed,
                                           const Start& start)
    : sensors_(vehicle.sensors),
      aircraft_(vehicle, start.p_WB, start.yaw_rad),
      actuators_(vehicle.actuators, Aircraft::kStep_s),
      wind_(wind, seed),
      imu_(vehicle.sensors.imu, vehicle.sensors.imu_rate_hz, seed),
      ahrs_(vehicle.sensors.attitude, vehicle.sensors.imu_rate_hz, seed),
      gps_(vehicle.sensors.gps, seed),
      navigator_({start.time, start.p_WB, Vector3d::Zero()}, vehicle.sensors.gps.velocity_mps),
      attitude_(aircraft_.body().R_WB) {}

bool InstrumentedAircraft::IsDue(double rate_hz) const {
  return step_ % std::llround(1 / (Aircraft::kStep_s * rate_hz)) == 0;
}

void InstrumentedAircraft::StepPhysics(double height_m) {
  wind_W_ = wind_.Advance(Aircraft::kStep_s, height_m, (body().v_WB() - wind_W_).norm());
  aircraft_.Step(actuators_.Act(), wind_W_, height_m);
  ++step_;
}

std::optional<InstrumentedAircraft::Inertial> InstrumentedAircraft::StepInertial(Timestamp now) {
  if (!IsDue(sensors_.imu_rate_hz)) {
    return std::nullopt;
  }
  const BodyState state = body();
  Inertial inertial;
  inertial.sample = imu_.Measure(now, aircraft_.SpecificForce(), state.angular_rate_B);
  attitude_ = ahrs_.Measure(state.R_WB);
  angular_rate_B_ = inertial.sample.angular_rate_B;
  inertial.a_W = AccelerationInWorld(inertial.sample, attitude_);
  navigator_.Propagate(now, inertial.a_W);
  return inertial;
}

std::optional<GpsFix> InstrumentedAircraft::StepGps(Timestamp now) {
  if (IsDue(sensors_.gps_rate_hz)) {
    const BodyState state = body();
    gps_.Measure(now, state.p_WB, state.v_WB());
  }
  std::optional<GpsFix> fix = gps_.Deliver(now);
  if (fix) {
    navigator_.Update(*fix);
  }
  return fix;
}

FlightState InstrumentedAircraft::Believed() const {
  return {navigator_.now().p_WB, navigator_.now().v_WB, attitude_, angular_rate_B_};
}

}  // namespace palace
