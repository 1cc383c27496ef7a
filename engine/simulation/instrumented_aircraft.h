// InstrumentedAircraft: an aircraft in its wind with actuators, inertial unit, attitude reference,
// GPS and the navigation on these, on the simulation's grid of 5 ms. Who commands it and what it
// flies on is not its affair.
//
// One step: Command where control is due, StepPhysics, then StepInertial and StepGps, each with
// what the vehicle's clock shows.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/flight/controllers.h"
#include "engine/simulation/actuators.h"
#include "engine/simulation/aircraft.h"
#include "engine/simulation/attitude_sensor.h"
#include "engine/simulation/gps_sensor.h"
#include "engine/simulation/imu_sensor.h"
#include "engine/simulation/vehicle_navigator.h"
#include "engine/simulation/wind.h"

namespace palace {

class InstrumentedAircraft {
 public:
  struct Start {
    Timestamp time;  ///< by the vehicle's clock
    Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
    double yaw_rad = 0;
  };
  struct Inertial {
    ImuSample sample;
    Eigen::Vector3d a_W;  ///< of B, as navigation sees it, with the bias
  };

  /// Hovering at rest in still air, which it knows.
  InstrumentedAircraft(const VehicleDescription& vehicle, const WindOptions& wind,
                       std::uint64_t seed, const Start& start);

  /// Whether a sample of a rate that divides the grid's (vehicle_file.h) is due now.
  bool IsDue(double rate_hz) const;
  void Command(const StickCommand& stick) { actuators_.Command(stick); }
  /// `height_m`: of B above the bare ground.
  void StepPhysics(double height_m);
  /// Nothing: not due.
  std::optional<Inertial> StepInertial(Timestamp now);
  /// A fix that is delivered now, with its latency.
  std::optional<GpsFix> StepGps(Timestamp now);
  /// Where it touched the ground it stays.
  void Freeze() { aircraft_.Freeze(); }

  BodyState body() const { return aircraft_.body(); }
  bool frozen() const { return aircraft_.frozen(); }
  WindModel& wind() { return wind_; }
  const WindModel& wind() const { return wind_; }
  const ImuSensor& imu() const { return imu_; }
  const GpsNavigator& navigator() const { return navigator_; }
  /// On GPS.
  FlightState Believed() const;

 private:
  SensorFigures sensors_;
  std::int64_t step_ = 0;
  Aircraft aircraft_;
  Actuators actuators_;
  WindModel wind_;
  Eigen::Vector3d wind_W_ = Eigen::Vector3d::Zero();
  ImuSensor imu_;
  AhrsSensor ahrs_;
  GpsSensor gps_;
  GpsNavigator navigator_;
  Eigen::Matrix3d attitude_;
  Eigen::Vector3d angular_rate_B_ = Eigen::Vector3d::Zero();
};

}  // namespace palace
