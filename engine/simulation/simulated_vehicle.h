// SimulatedVehicle: airframe, wind, sensors, navigation and autopilot advanced together on one
// 5 ms grid. No threads, no clock: the same options and messages give the same bits.
//
//   physics 200 Hz, inertial unit and attitude 100 Hz, control, pose and truth 50 Hz, laser 20 Hz,
//   GPS 5 Hz. Sticks computed at one control step act from the next one on (20 ms).
#pragma once

#include <optional>
#include <vector>

#include "engine/simulation/autopilot.h"
#include "engine/simulation/rotorcraft.h"
#include "engine/simulation/sensors.h"
#include "engine/simulation/simulator.h"

namespace palace {

class SimulatedVehicle {
 public:
  /// Flies a hidden lead-in of kLeadIn_s, so that filters have converged and the wind is trimmed
  /// out when time starts at Simulator::kEpoch.
  explicit SimulatedVehicle(const SimulatorOptions& options);

  static constexpr double kLeadIn_s = 20;
  static constexpr std::int64_t kStep_us = 5'000;

  void Receive(const VehicleMessage& message);
  /// Advances to the first grid point at or after `until`; appends every sample to the bundle.
  void AdvanceTo(Timestamp until, FrameBundle& bundle);

  Timestamp now() const { return now_; }
  std::uint64_t boot_id() const { return boot_id_; }
  VehicleAuthority& authority() { return autopilot_.authority(); }
  RigidTransform X_WB() const { return {rotorcraft_.state().R_WB(), rotorcraft_.state().p_WB()}; }
  const std::optional<Touchdown>& touchdown() const { return touchdown_; }
  const ImuSensor& imu() const { return imu_; }
  /// The navigation solution now.
  VehiclePose Pose() const;
  VehicleStatus Status() const;

 private:
  void Step(FrameBundle& bundle);
  void StepControl();
  void StepInertial(FrameBundle& bundle);
  void StepSlowSensors(FrameBundle& bundle);
  void CheckGround();
  double HeightAboveGround() const;

  World world_;
  Airframe airframe_;
  RigidTransform X_BC_;
  Timestamp now_;
  std::int64_t step_ = 0;
  std::uint64_t boot_id_;
  Rotorcraft rotorcraft_;
  WindModel wind_;
  Eigen::Vector3d wind_W_ = Eigen::Vector3d::Zero();
  ImuSensor imu_;
  AhrsSensor ahrs_;
  GpsSensor gps_;
  LaserSensor laser_;
  GpsNavigator navigator_;
  Autopilot autopilot_;
  double ground_down_m_ = NAN;  ///< of the laser's newest spot
  Timestamp authority_told_;
  StickCommand stick_;       ///< acting now
  StickCommand next_stick_;  ///< acts from the next control step on
  Eigen::Matrix3d attitude_;
  Eigen::Vector3d angular_rate_B_ = Eigen::Vector3d::Zero();
  std::optional<Touchdown> touchdown_;
};

}  // namespace palace
