// ApprovalVerifier: the vehicle's side of an approval, as a function that a vehicle can be handed.
#pragma once

#include <functional>
#include <string>

#include "engine/trust/approval.h"

namespace palace {

/// VerifyApproval with the station's public key and its own memory of what it accepted. Empty:
/// accepted; else the reason. Copies share that memory: hand it to one vehicle only.
std::function<std::string(const Approval&, Timestamp vehicle_now, std::uint64_t boot_id)>
MakeApprovalVerifier(const PublicKey& station_key);

}  // namespace palace
