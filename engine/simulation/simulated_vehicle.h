// SimulatedVehicle: airframe, wind, sensors, navigation and autopilot advanced together on one
// 5 ms grid. No threads, no clock: the same options and messages give the same bits.
//
// Physics runs at 200 Hz; inertial unit, control, laser and GPS at the rates of the vehicle's file,
// attitude as the inertial unit, pose and truth as control. Between a stick computed and the stick
// that acts lie its actuators.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "engine/simulation/autopilot.h"
#include "engine/simulation/instrumented_aircraft.h"
#include "engine/simulation/pose_history.h"
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
  /// From now on: another wind; cameras, and the laser beside them, looking another way.
  void SetWind(const WindOptions& wind) { aircraft_.wind().Set(wind); }
  void SetRig(const StereoRig& rig);
  /// Advances to the first grid point at or after `until`, a true time; appends every sample to the
  /// bundle.
  void AdvanceTo(Timestamp until, FrameBundle& bundle);

  /// By the vehicle's clock, which shows kEpoch at that true time and gains clock_drift.
  Timestamp now() const { return now_; }
  std::uint64_t boot_id() const { return boot_id_; }
  VehicleAuthority& authority() { return autopilot_.authority(); }
  RigidTransform X_WB() const { return {aircraft_.body().R_WB, aircraft_.body().p_WB}; }
  const std::optional<Touchdown>& touchdown() const { return touchdown_; }
  const ImuSensor& imu() const { return aircraft_.imu(); }
  /// Up to now.
  const PoseHistory& history() const { return history_; }
  /// The navigation solution now.
  VehiclePose Pose() const;
  VehicleStatus Status() const;

 private:
  void Step(FrameBundle& bundle);
  void StepSlowSensors(FrameBundle& bundle);
  void TellPoses(FrameBundle& bundle);
  void CheckGround();
  /// Angle to the vertical of the plane through the ground below the gear's ends.
  double GroundTilt(const RigidTransform& X_WB) const;
  double HeightAboveGround() const;

  World world_;
  VehicleDescription vehicle_;
  RigidTransform X_BC_;
  Timestamp true_now_;
  Timestamp now_;
  std::uint64_t boot_id_;
  InstrumentedAircraft aircraft_;
  LaserSensor laser_;
  Autopilot autopilot_;
  double ground_down_m_ = NAN;  ///< of the laser's newest spot
  Timestamp authority_told_;
  std::optional<Touchdown> touchdown_;
  PoseHistory history_;
  std::deque<VehiclePose> untold_;  ///< poses that the station is still to hear
};

}  // namespace palace
