#include "engine/trust/approval.h"

#include <bit>
#include <cmath>
#include <string_view>

#include <sodium.h>

#include "engine/core/check.h"

namespace palace {
namespace {

constexpr std::string_view kVersion = "PALACE-APPROVAL-2";

class Encoder {
 public:
  void Bytes(std::string_view text) { out_.insert(out_.end(), text.begin(), text.end()); }
  void Word(std::uint64_t value) {
    for (int shift = 56; shift >= 0; shift -= 8) {
      out_.push_back(static_cast<std::uint8_t>(value >> shift));
    }
  }
  void Real(double value) { Word(std::bit_cast<std::uint64_t>(value)); }
  void Time(Timestamp t) { Word(static_cast<std::uint64_t>(t.us)); }
  std::vector<std::uint8_t> Take() { return std::move(out_); }

 private:
  std::vector<std::uint8_t> out_;
};

void InitSodium() { PALACE_CHECK(sodium_init() >= 0); }

bool IsSigned(const Approval& approval, const PublicKey& public_key) {
  InitSodium();
  if (approval.signature.size() != crypto_sign_BYTES) {
    return false;
  }
  const auto bytes = EncodeApproval(approval);
  return crypto_sign_verify_detached(approval.signature.data(), bytes.data(), bytes.size(),
                                     public_key.data()) == 0;
}

bool IsFinite(const Approval& a) {
  return a.p_WS.allFinite() && std::isfinite(a.approach_heading_rad) &&
         std::isfinite(a.glide_slope_rad) && std::isfinite(a.descent_rate_mps) &&
         std::isfinite(a.clear_radius_m);
}

std::string WhyRefused(const Approval& approval, const PublicKey& public_key,
                       const VerifierState& state, Timestamp vehicle_now, std::uint64_t boot_id) {
  if (!IsSigned(approval, public_key)) {
    return "Signature does not match";
  }
  if (!IsFinite(approval)) {
    return "A value is not finite";
  }
  if (approval.vehicle_boot_id != boot_id) {
    return "Given for another start of this vehicle";
  }
  if (state.session_id && *state.session_id != approval.session_id) {
    return "Given by another session";
  }
  if (approval.counter <= state.last_counter) {
    return "Counter " + std::to_string(approval.counter) + " was already used";
  }
  if (approval.expires_at <= approval.approved_at || vehicle_now >= approval.expires_at) {
    return "Expired";
  }
  return {};
}

}  // namespace

std::vector<std::uint8_t> EncodeApproval(const Approval& a) {
  Encoder encoder;
  encoder.Bytes(kVersion);
  for (const std::uint64_t word : {a.id, a.session_id, a.counter, a.site_id, a.map_hash,
                                   a.settings_hash, a.calibration_hash, a.vehicle_boot_id}) {
    encoder.Word(word);
  }
  encoder.Time(a.approved_at);
  encoder.Time(a.expires_at);
  encoder.Word(a.provisional ? 1 : 0);
  for (const double value : {a.p_WS.x(), a.p_WS.y(), a.p_WS.z(), a.approach_heading_rad,
                             a.glide_slope_rad, a.descent_rate_mps, a.clear_radius_m}) {
    encoder.Real(value);
  }
  return encoder.Take();
}

ApprovalSigner ApprovalSigner::Random() {
  InitSodium();
  ApprovalSigner signer;
  PALACE_CHECK(crypto_sign_keypair(signer.public_key_.data(), signer.secret_key_.data()) == 0);
  return signer;
}

ApprovalSigner ApprovalSigner::FromSeed(std::uint64_t seed) {
  InitSodium();
  Encoder encoder;
  encoder.Bytes("PALACE-KEY-1");
  encoder.Word(seed);
  const auto bytes = encoder.Take();
  std::array<std::uint8_t, crypto_sign_SEEDBYTES> key_seed{};
  crypto_generichash(key_seed.data(), key_seed.size(), bytes.data(), bytes.size(), nullptr, 0);
  ApprovalSigner signer;
  PALACE_CHECK(crypto_sign_seed_keypair(signer.public_key_.data(), signer.secret_key_.data(),
                                        key_seed.data()) == 0);
  return signer;
}

void ApprovalSigner::Sign(Approval& approval) const {
  const auto bytes = EncodeApproval(approval);
  approval.signature.assign(crypto_sign_BYTES, 0);
  PALACE_CHECK(crypto_sign_detached(approval.signature.data(), nullptr, bytes.data(), bytes.size(),
                                    secret_key_.data()) == 0);
}

std::string VerifyApproval(const Approval& approval, const PublicKey& public_key,
                           VerifierState& state, Timestamp vehicle_now, std::uint64_t boot_id) {
  std::string why = WhyRefused(approval, public_key, state, vehicle_now, boot_id);
  if (!why.empty()) {
    ++state.refused;
    return why;
  }
  state.session_id = approval.session_id;
  state.last_counter = approval.counter;
  state.last_id = approval.id;
  return {};
}

bool IsRepeatOfAccepted(const Approval& approval, const PublicKey& public_key,
                        const VerifierState& state) {
  return state.session_id && *state.session_id == approval.session_id &&
         approval.counter == state.last_counter && approval.id == state.last_id &&
         IsSigned(approval, public_key);
}

}  // namespace palace
