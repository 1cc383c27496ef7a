#include "engine/simulation/approval_gate.h"

#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kMinSlope_rad = Rad(15);
constexpr double kMaxSlope_rad = Rad(90.001);
constexpr double kMinSink_mps = 0.1;
constexpr double kMaxSink_mps = 1.5;  // what the cascade's height loop holds
constexpr double kMaxDistance_m = 100;

/// Values that are not finite pass: the verifier refuses them.
std::string WhyNotFlown(const Approval& approval, const Eigen::Vector3d& p_WB) {
  if (approval.glide_slope_rad < kMinSlope_rad || approval.glide_slope_rad > kMaxSlope_rad) {
    return "The glide slope is outside 15 to 90 degrees";
  }
  if (approval.descent_rate_mps < kMinSink_mps || approval.descent_rate_mps > kMaxSink_mps) {
    return "The descent rate is outside 0.1 to 1.5 m/s";
  }
  if ((approval.p_WS - p_WB).norm() > kMaxDistance_m) {
    return "The site is more than 100 m away";
  }
  return {};
}

}  // namespace

std::string ApprovalGate::Admit(const Approval& approval, Timestamp now,
                                const Eigen::Vector3d& p_WB) {
  const std::string why = WhyNotFlown(approval, p_WB);
  // Nobody but the station itself is told what this vehicle can fly.
  const bool own = verifier_.WhyRefused(approval, now).empty();
  return own && !why.empty() ? why : verifier_.Verify(approval, now);
}

}  // namespace palace
