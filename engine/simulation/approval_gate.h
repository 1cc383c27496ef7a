// What the simulated vehicle demands of an approval before it moves: the last check before flight.
#pragma once

#include <optional>
#include <string>

#include "engine/trust/approval_verifier.h"

namespace palace {

class ApprovalGate {
 public:
  /// As ApprovalVerifier.
  ApprovalGate(std::uint64_t boot_id, std::optional<PublicKey> station_key)
      : verifier_(boot_id, station_key) {}

  /// Empty: accepted, and its counter is spent. Otherwise the reason of the refusal. Demands what
  /// this vehicle can fly, a glide slope of 15 to 90 degrees, a descent rate of 0.1 to 1.5 m/s and a
  /// site within 100 m, and all that ApprovalVerifier does.
  std::string Admit(const Approval& approval, Timestamp now, const Eigen::Vector3d& p_WB);
  /// The answer to the approval admitted last was lost: to be answered as accepted, no more.
  bool IsRepeat(const Approval& approval) const { return verifier_.IsRepeat(approval); }

 private:
  ApprovalVerifier verifier_;
};

}  // namespace palace
