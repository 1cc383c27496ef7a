#include "engine/simulation/command_gate.h"

#include <cmath>

#include "engine/core/text.h"
#include "engine/core/units.h"

namespace palace {
namespace {

std::string WhyNotFlown(const Approval& approval, const FlightLimits& limits) {
  if (approval.glide_slope_rad < limits.min_glide_slope_rad) {
    return WithNumbers("The glide slope is outside %.3g to 90 degrees",
                       Deg(limits.min_glide_slope_rad));
  }
  const double rate_mps = approval.descent_rate_mps;
  return rate_mps < limits.min_descent_rate_mps || rate_mps > limits.max_descent_rate_mps
             ? WithNumbers("The descent rate is outside %.3g to %.3g m/s",
                           limits.min_descent_rate_mps, limits.max_descent_rate_mps)
             : "";
}

constexpr double kLongestGo_s = 10;  // that one may wait for its turn
constexpr double kFarthestGo_m = 100, kHighestGo_m = 50, kDeepestGo_m = 1;

/// The vehicle asks by itself: a station may be mistaken.
std::string WhyNotGone(const GoRequest& go, const VehicleSituation& vehicle,
                       std::uint64_t boot_id) {
  if (!go.p_WB.allFinite() || !std::isfinite(go.heading_rad)) {
    return "The hover is not a number";
  }
  if (go.vehicle_boot_id != boot_id) {
    return "It is meant for another start of the vehicle";
  }
  const double left_s = SecondsBetween(vehicle.now, go.expires_at);
  if (!(left_s > 0 && left_s <= kLongestGo_s)) {
    return left_s > 0 ? "Valid for longer than 10 s" : "Expired";
  }
  const Eigen::Vector3d way = go.p_WB - vehicle.p_WB;
  if (way.head<2>().norm() > kFarthestGo_m) {
    return WithNumbers("The hover is more than %.0f m away", kFarthestGo_m);
  }
  if (-way.z() > kHighestGo_m) {
    return WithNumbers("The hover is more than %.0f m higher", kHighestGo_m);
  }
  return way.z() > kDeepestGo_m ? "The hover is lower than the vehicle" : "";
}

}  // namespace

std::string CommandGate::Admit(const GoRequest& go, const VehicleSituation& vehicle,
                               const std::string& busy) {
  std::string why =
      authority_.Check(SealedChannel::kCommand, SealedBytes(go), go.seal, vehicle.now);
  if (why.empty()) {
    why = busy.empty() ? WhyNotGone(go, vehicle, authority_.boot_id()) : busy;
  }
  return why;
}

std::string CommandGate::Admit(const Approval& approval, const VehicleSituation& vehicle,
                               const std::string& busy) {
  // Nobody but the station itself is told what this vehicle can fly.
  const std::string why = WhyNotFlown(approval, limits_);
  return verifier_.Verify(approval, vehicle, why.empty() ? busy : why);
}

std::string CommandGate::Admit(const HoldRequest& hold, Timestamp now) {
  return authority_.Check(SealedChannel::kCommand, SealedBytes(hold), hold.seal, now);
}

std::string CommandGate::Admit(const PositionEstimate& estimate, Timestamp now) {
  return authority_.Check(SealedChannel::kEstimate, SealedBytes(estimate), estimate.seal, now);
}

}  // namespace palace
