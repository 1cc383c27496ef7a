// What the simulated vehicle demands of a command before it moves: the last check before flight.
#pragma once

#include <string>

#include "engine/trust/approval_verifier.h"

namespace palace {

class CommandGate {
 public:
  explicit CommandGate(VehicleTrust trust) : authority_(std::move(trust)), verifier_(authority_) {}
  CommandGate(const CommandGate&) = delete;
  CommandGate& operator=(const CommandGate&) = delete;

  /// Empty: admitted. Otherwise the reason of the refusal. Demands all that ApprovalVerifier does,
  /// and what this vehicle can fly: a glide slope of 15 to 90 degrees and a descent rate of 0.1 to
  /// 1.5 m/s. `busy`: why it cannot now; empty: it can.
  std::string Admit(const Approval& approval, const VehicleSituation& vehicle,
                    const std::string& busy = {});
  std::string Admit(const HoldRequest& hold, Timestamp now);
  std::string Admit(const PositionEstimate& estimate, Timestamp now);
  /// The answer to the approval admitted last was lost: to be answered as accepted, no more.
  bool IsRepeat(const Approval& approval) const { return verifier_.IsRepeat(approval); }

  VehicleAuthority& authority() { return authority_; }

 private:
  VehicleAuthority authority_;
  ApprovalVerifier verifier_;
};

}  // namespace palace
