#include "engine/trust/approval_verifier.h"

#include <cmath>

namespace palace {
namespace {

bool IsFinite(const Approval& a) {
  return a.p_WS.allFinite() && std::isfinite(a.approach_heading_rad) &&
         std::isfinite(a.glide_slope_rad) && std::isfinite(a.descent_rate_mps) &&
         std::isfinite(a.clear_radius_m);
}

std::vector<std::uint8_t> BytesOf(const Approval& approval) {
  std::vector<std::uint8_t> bytes = EncodeApproval(approval);
  bytes.insert(bytes.end(), approval.signature.begin(), approval.signature.end());
  return bytes;
}

}  // namespace

ApprovalVerifier::ApprovalVerifier(std::uint64_t boot_id, std::optional<PublicKey> station_key)
    : boot_id_(boot_id), station_key_(station_key) {}

std::string ApprovalVerifier::WhyRefused(const Approval& approval, Timestamp vehicle_now) const {
  if (station_key_ && !IsSignedBy(*station_key_, approval)) {
    return "Signature does not match";
  }
  if (!IsFinite(approval)) {
    return "A value is not finite";
  }
  if (approval.id == 0) {
    return "The approval has no id";
  }
  if (approval.vehicle_boot_id != boot_id_) {
    return "Given for another start of this vehicle";
  }
  const auto last = last_counter_.find(approval.session_id);
  if (station_key_ && !last_counter_.empty() && last == last_counter_.end()) {
    return "Given by another session";
  }
  if (last != last_counter_.end() && approval.counter <= last->second) {
    return "Counter " + std::to_string(approval.counter) + " was already used";
  }
  if (approval.expires_at <= approval.approved_at || vehicle_now >= approval.expires_at) {
    return "Expired";
  }
  return {};
}

std::string ApprovalVerifier::Verify(const Approval& approval, Timestamp vehicle_now) {
  std::string why = WhyRefused(approval, vehicle_now);
  if (!why.empty()) {
    ++refused_;
    return why;
  }
  last_counter_[approval.session_id] = approval.counter;
  last_accepted_ = BytesOf(approval);
  return {};
}

bool ApprovalVerifier::IsRepeat(const Approval& approval) const {
  return !last_accepted_.empty() && BytesOf(approval) == last_accepted_;
}

}  // namespace palace
