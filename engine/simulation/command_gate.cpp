#include "engine/simulation/command_gate.h"

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

}  // namespace

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
