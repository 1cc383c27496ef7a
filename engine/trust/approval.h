// Approvals: canonical encoding and Ed25519 signature. What a vehicle checks before it obeys is in
// approval_verifier.h.
//
// The signature covers a version string and every field of Approval except the signature itself,
// each as eight big-endian bytes (doubles by their IEEE bits), so that a change of any one field
// makes the approval void (invariant I1).
//
// Source: Bernstein et al. 2012, "High-speed high-security signatures" (Ed25519), by libsodium.
#pragma once

#include <array>
#include <cstdint>
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

/// True when the signature is that of the key over every field as it stands.
bool IsSignedBy(const PublicKey& public_key, const Approval& approval);

}  // namespace palace
