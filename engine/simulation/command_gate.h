// What the simulated vehicle demands of a command before it moves: the last check before flight.
#pragma once

#include <string>

#include "engine/simulation/vehicle_description.h"
#include "engine/trust/approval_verifier.h"

namespace palace {

class CommandGate {
 public:
  CommandGate(VehicleTrust trust, const FlightLimits& limits)
      : limits_(limits), authority_(std::move(trust)), verifier_(authority_) {}
  CommandGate(const CommandGate&) = delete;
  CommandGate& operator=(const CommandGate&) = delete;

  /// Empty: admitted. Otherwise the reason of the refusal. Demands all that ApprovalVerifier does,
  /// and what this vehicle can fly by its limits. `busy`: why it cannot now; empty: it can.
  std::string Admit(const Approval& approval, const VehicleSituation& vehicle,
                    const std::string& busy = {});
  std::string Admit(const HoldRequest& hold, Timestamp now);
  /// To a hover in reach: within 100 m, no more than 50 m up and hardly lower than now.
  std::string Admit(const GoRequest& go, const VehicleSituation& vehicle,
                    const std::string& busy = {});
  std::string Admit(const PositionEstimate& estimate, Timestamp now);
  /// The answer to the approval admitted last was lost: to be answered as accepted, no more.
  bool IsRepeat(const Approval& approval) const { return verifier_.IsRepeat(approval); }

  VehicleAuthority& authority() { return authority_; }

 private:
  FlightLimits limits_;
  VehicleAuthority authority_;
  ApprovalVerifier verifier_;
};

}  // namespace palace
