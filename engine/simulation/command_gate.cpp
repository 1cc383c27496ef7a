#include "engine/simulation/command_gate.h"

#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kMinSlope_rad = Rad(15);
constexpr double kMinSink_mps = 0.1;
constexpr double kMaxSink_mps = 1.5;  // what the cascade's height loop holds

std::string WhyNotFlown(const Approval& approval) {
  if (approval.glide_slope_rad < kMinSlope_rad) {
    return "The glide slope is outside 15 to 90 degrees";
  }
  const double rate_mps = approval.descent_rate_mps;
  return rate_mps < kMinSink_mps || rate_mps > kMaxSink_mps
             ? "The descent rate is outside 0.1 to 1.5 m/s"
             : "";
}

}  // namespace

std::string CommandGate::Admit(const Approval& approval, const VehicleSituation& vehicle,
                               const std::string& busy) {
  // Nobody but the station itself is told what this vehicle can fly.
  const std::string why = WhyNotFlown(approval);
  return verifier_.Verify(approval, vehicle, why.empty() ? busy : why);
}

std::string CommandGate::Admit(const HoldRequest& hold, Timestamp now) {
  return authority_.Check(SealedChannel::kCommand, SealedBytes(hold), hold.seal, now);
}

std::string CommandGate::Admit(const PositionEstimate& estimate, Timestamp now) {
  return authority_.Check(SealedChannel::kEstimate, SealedBytes(estimate), estimate.seal, now);
}

}  // namespace palace
