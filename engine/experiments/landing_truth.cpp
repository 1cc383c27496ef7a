#include "engine/experiments/landing_truth.h"

namespace palace {
namespace {

constexpr double kTruthBeyondDisc_m = 1.5;  // so that slopes and steps at its rim are known

}  // namespace

const char* MissionOutcomeName(MissionOutcome outcome) {
  static constexpr const char* kNames[kMissionOutcomeCount] = {
      "landed_right", "landed_on_hazard", "held", "aborted", "refused", "unfinished"};
  return kNames[static_cast<int>(outcome)];
}

MissionOutcome OutcomeOf(MissionState last, bool approved, const std::optional<DiscTruth>& under,
                         const TruthLimits& limits) {
  if (under && !WithinLimits(*under, limits.Scaled(kTruthGrace))) {
    return MissionOutcome::kLandedOnHazard;
  }
  switch (last) {
    case MissionState::kHold:
      return MissionOutcome::kHeld;
    case MissionState::kAborting:
      return MissionOutcome::kAborted;
    case MissionState::kLanded:
      return under ? MissionOutcome::kLandedRight : MissionOutcome::kLandedOnHazard;
    case MissionState::kApproved:
    case MissionState::kDescending:
      return MissionOutcome::kUnfinished;
    default:
      return approved ? MissionOutcome::kHeld : MissionOutcome::kRefused;
  }
}

TruthLimits TruthLimitsOf(const Settings& settings) {
  const HazardLimits& limits = settings.slad.limits;
  return {limits.max_slope_deg, limits.max_deviation_m, limits.max_step_m};
}

/// Of the ground about one place at one moment.
DiscTruth DiscAt(const World& world, const Eigen::Vector2d& place_m, double radius_m,
                 double time_s) {
  const double reach = radius_m + kTruthBeyondDisc_m;
  const GroundTruth truth = TruthOf(world,
                                    {.north_min_m = place_m.x() - reach,
                                     .north_max_m = place_m.x() + reach,
                                     .east_min_m = place_m.y() - reach,
                                     .east_max_m = place_m.y() + reach},
                                    time_s);
  return TruthOfDisc(truth, place_m, radius_m);
}

}  // namespace palace
