// Approvals: canonical encoding, Ed25519 signature, and the check a vehicle makes before it obeys.
//
// The signature covers a version string and every field of Approval except the signature itself,
// each as eight big-endian bytes (doubles by their IEEE bits), so that a change of any one field
// makes the approval void (invariant I1). The vehicle includes this header too: a station cannot
// enforce I1, I4, I8 and I9 alone.
//
// Source: Bernstein et al. 2012, "High-speed high-security signatures" (Ed25519), by libsodium.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/time.h"
#include "engine/model/vehicle_message.h"

namespace palace {

using PublicKey = std::array<std::uint8_t, 32>;

/// The bytes that are signed.
std::vector<std::uint8_t> EncodeApproval(const Approval& approval);

/// Holds the session's secret key and signs approvals with it.
class ApprovalSigner {
 public:
  /// A key pair from the operating system's random numbers: for live sessions.
  static ApprovalSigner Random();
  /// The same seed gives the same key pair: for the simulator's lockstep flights only.
  static ApprovalSigner FromSeed(std::uint64_t seed);

  const PublicKey& public_key() const { return public_key_; }
  /// Fills approval.signature (64 bytes).
  void Sign(Approval& approval) const;

 private:
  ApprovalSigner() = default;
  PublicKey public_key_{};
  std::array<std::uint8_t, 64> secret_key_{};
};

/// What a vehicle remembers about approvals since it booted.
struct VerifierState {
  std::optional<std::uint64_t> session_id;  ///< set by the first accepted approval
  std::uint64_t last_counter = 0;           ///< of the last accepted approval
  std::uint64_t last_id = 0;                ///< of the last accepted approval
  std::uint64_t refused = 0;                ///< how many were refused
};

/// Checks an approval on the vehicle. Empty: accepted, and `state` remembers it. Otherwise the
/// reason, in words for the operator; `state` only counts the refusal.
std::string VerifyApproval(const Approval& approval, const PublicKey& public_key,
                           VerifierState& state, Timestamp vehicle_now, std::uint64_t boot_id);

/// True when `approval` is another copy of the one accepted last and is signed as such: the vehicle
/// repeats its acknowledgement and does nothing else (I8).
bool IsRepeatOfAccepted(const Approval& approval, const PublicKey& public_key,
                        const VerifierState& state);

}  // namespace palace
