// Autopilot: the modes of the simulated vehicle, from hover to touchdown.
//
//   kHover  holds a point on GPS. An admitted approval starts kAlign, a way elsewhere kGo.
//   kGo     up and round where it is, then straight to another hover on GPS, and kHover there.
//   kAlign  at the present height to the start of the glide slope, turning to the approach heading.
//           Leaves when within 0.5 m, 3 deg and 0.4 m/s AND healthy vision estimates for this
//           approval arrive; too late for the expiry means kHold.
//   kDescend, kSettle, kSink  fly on vision: down the slope, level until the skids are above the
//           site, then straight down until they touch. Geometry and speeds: flight_path.h. A look
//           ends its approval in kHover, where the slope ends.
//   kLanded stays. kHold hovers where it is on GPS. kAbort climbs at the climb rate of its limits,
//   then kHover.
//
// On vision, no healthy estimate with an advancing stamp for 0.5 s stops the motion (inertial
// hover); for 2 s climbs away 10 m. Hold, abort, expiry and outage end the approval for good.
// Estimates that move away from the vehicle's own solution (estimate_watch.h), and another station
// taking command, end it with a hold; the reason goes out as a refusal of the approval.
// At the hand-over the reference is shifted by vision minus GPS, so the control error is unchanged;
// the shift then fades (slope_reference.h).
#pragma once

#include <optional>
#include <vector>

#include "engine/flight/controllers.h"
#include "engine/flight/estimate_watch.h"
#include "engine/flight/slope_reference.h"
#include "engine/flight/waypoints.h"
#include "engine/simulation/command_gate.h"
#include "engine/simulation/vehicle_navigator.h"

namespace palace {

struct AutopilotOptions {
  VehicleTrust trust{};  ///< whom it obeys
  Eigen::Vector3d hover_p_WB = Eigen::Vector3d::Zero();
  double hover_yaw_rad = 0;
  PathVehicle vehicle{};
  FlightLimits limits{};
  CascadeGains gains{};
  double control_period_s = 0.02;
};

class Autopilot {
 public:
  explicit Autopilot(const AutopilotOptions& options);

  void Receive(const VehicleMessage& message, const VehicleSituation& vehicle);
  /// The inertial step of the vision solution, 100 Hz; a_W with the bias removed.
  void Propagate(Timestamp now, const Eigen::Vector3d& a_W);
  /// One control step. `gps` carries attitude and rates, and position and velocity on GPS.
  StickCommand Control(Timestamp now, const FlightState& gps, bool on_ground);

  VehicleMode mode() const { return mode_; }
  bool flies_on_vision() const { return flies_on_vision_; }
  std::uint64_t approval_id() const { return approval_ ? approval_->id : 0; }
  std::vector<CommandAck> TakeAcks();
  VehicleAuthority& authority() { return gate_.authority(); }

 private:
  void ReceiveApproval(const Approval& approval, const VehicleSituation& vehicle);
  /// Hovers, or is on its way to another hover: it takes an approval.
  bool IsFree() const;
  void ReceiveGo(const GoRequest& go, const VehicleSituation& vehicle);
  void ReceiveRequest(const SessionRequest& request, Timestamp now);
  /// Holds, and answers the approval that it flew with the reason.
  void GiveUp(const std::string& why, Timestamp now);
  void ReceiveEstimate(const PositionEstimate& estimate, Timestamp now);
  void ReceiveHold(const HoldRequest& request, Timestamp now);
  void ReceiveAbort(const AbortRequest& request, Timestamp now);
  void Acknowledge(std::uint64_t id, const std::string& refusal, Timestamp now);
  /// Seconds without a usable estimate; infinite before the first.
  double VisionAge(Timestamp now) const;

  /// The reference stops after braking from this velocity.
  Eigen::Vector3d StoppingPoint(const Eigen::Vector3d& p, const Eigen::Vector3d& v) const;
  void StepMode(Timestamp now);
  void StepAlign(Timestamp now);
  void StepDescend(bool fresh);
  void StepSettle(Timestamp now, bool fresh);
  void StepSink(bool fresh);
  void StepAbort();
  void StepGo();
  void HandOverToVision();
  void ReturnToGps();
  /// Ends the approval; hovers where it is.
  void EnterHover(VehicleMode mode);
  void EnterHold() { EnterHover(VehicleMode::kHold); }
  void EnterAbort(double target_down_m);

  AutopilotOptions options_;
  TravelLimits stop_;
  CommandGate gate_;
  FlightController controller_;
  VehicleMode mode_ = VehicleMode::kHover;
  std::optional<Approval> approval_;
  FlightPath path_;

  FlightState gps_;  ///< of the last control step
  FlightState flown_;
  bool flies_on_vision_ = false;
  std::optional<VisionNavigator> vision_;
  EstimateWatch watch_;
  std::optional<PositionEstimate> last_estimate_;
  std::optional<Timestamp> last_arrival_;
  int estimates_seen_ = 0;

  MovingReference reference_;
  double yaw_reference_rad_ = 0;
  Eigen::Vector3d hold_p_W_;
  double hover_down_m_ = 0;  ///< of the highest hover that it was sent to: wave-offs climb there
  SlopeReference slope_;     ///< its height and rate are also those of the sink
  Eigen::Vector3d skid_lever_W_;  ///< R_WB p_B,skid, averaged: the mean tilt in wind
  double settle_time_s_ = 0;
  double settled_s_ = 0;
  Eigen::Vector3d go_from_W_ = Eigen::Vector3d::Zero();  ///< where a way elsewhere begins
  double go_heading_rad_ = 0;
  double go_time_s_ = 0;
  bool go_leaves_ = false;  ///< up and round is done
  double climb_to_down_m_ = 0;
  double abort_time_s_ = 0;
  std::vector<CommandAck> acks_;
};

}  // namespace palace
