#include "engine/simulation/approval_gate.h"

#include <cmath>
#include <utility>

#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kMinSlope_rad = Rad(15);
constexpr double kMaxSlope_rad = Rad(90.001);
constexpr double kMinSink_mps = 0.1;
constexpr double kMaxSink_mps = 1.5;  // what the cascade's height loop holds
constexpr double kMaxDistance_m = 100;

}  // namespace

ApprovalGate::ApprovalGate(std::uint64_t boot_id, Check signature_check)
    : boot_id_(boot_id), signature_check_(std::move(signature_check)) {}

std::string ApprovalGate::Admit(const Approval& approval, Timestamp now,
                                const Eigen::Vector3d& p_WB) {
  if (!approval.p_WS.allFinite() || !std::isfinite(approval.approach_heading_rad) ||
      !std::isfinite(approval.glide_slope_rad) || !std::isfinite(approval.descent_rate_mps)) {
    return "a number in the approval is not finite";
  }
  if (approval.id == 0) {
    return "the approval has no id";
  }
  if (approval.vehicle_boot_id != boot_id_) {
    return "the approval is for another start of the vehicle";
  }
  if (now > approval.expires_at) {
    return "the approval has expired";
  }
  const auto last = last_counter_.find(approval.session_id);
  if (last != last_counter_.end() && approval.counter <= last->second) {
    return "the approval's counter was used before";
  }
  if (approval.glide_slope_rad < kMinSlope_rad || approval.glide_slope_rad > kMaxSlope_rad) {
    return "the glide slope is outside 15 to 90 degrees";
  }
  if (approval.descent_rate_mps < kMinSink_mps || approval.descent_rate_mps > kMaxSink_mps) {
    return "the descent rate is outside 0.1 to 1.5 m/s";
  }
  if ((approval.p_WS - p_WB).norm() > kMaxDistance_m) {
    return "the site is more than 100 m away";
  }
  if (signature_check_) {
    std::string reason = signature_check_(approval, now, boot_id_);
    if (!reason.empty()) {
      return reason;
    }
  }
  last_counter_[approval.session_id] = approval.counter;
  return {};
}

}  // namespace palace
