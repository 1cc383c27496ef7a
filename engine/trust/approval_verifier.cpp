#include "engine/trust/approval_verifier.h"

#include <memory>

namespace palace {

std::function<std::string(const Approval&, Timestamp, std::uint64_t)> MakeApprovalVerifier(
    const PublicKey& station_key) {
  auto state = std::make_shared<VerifierState>();
  return [state, station_key](const Approval& approval, Timestamp now, std::uint64_t boot_id) {
    return VerifyApproval(approval, station_key, *state, now, boot_id);
  };
}

}  // namespace palace
