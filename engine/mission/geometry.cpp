#include "engine/mission/geometry.h"

#include <algorithm>
#include <cmath>

namespace palace {
namespace {

// The path's last legs, as the vehicle flies them (DESIGN.md 6, last metres).
constexpr double kSettleHeight_m = 2;  // level above this, over the site
constexpr double kAlignTime_s = 7;     // turn to the site and fly to the slope, before descending
constexpr double kLevelSpeed_mps = 0.5;
constexpr double kSettleTime_s = 4;  // until it hovers still enough to sink
constexpr double kLastSinkRate_mps = 0.35;
constexpr double kOverSite_m = 0.3;
constexpr double kLeadPerHeight = 1.7;  // the camera leads the skids by about the settle height

double TimeLeft(const MissionMemory& m) {
  switch (m.status.state) {
    case MissionState::kLanded:
      return 0;
    case MissionState::kAborting:
    case MissionState::kHold:
      return NAN;
    default:
      break;
  }
  const double align_s = m.status.state == MissionState::kDescending ? 0 : kAlignTime_s;
  return align_s + TimeToTouchdown(m.status.height_above_site_m, m.status.distance_to_site_m,
                                   m.facts.limits.descent_rate_mps);
}

}  // namespace

double HeightAboveSite(const MissionMemory& m) {
  // Down is positive in W: the skid is above the site when its z is smaller.
  return m.status.armed ? m.status.armed->p_WS.z() - m.facts.skid_centre_W.z() : NAN;
}

double HeadingTo(const MissionMemory& m, const Eigen::Vector3d& p_WS) {
  const Eigen::Vector3d way = p_WS - m.facts.skid_centre_W;
  return std::atan2(way.y(), way.x());
}

double TimeToTouchdown(double height_m, double distance_m, double descent_rate_mps) {
  const double above_m = std::max(0.0, height_m - kSettleHeight_m);
  const double sink_s = std::clamp(height_m, 0.0, kSettleHeight_m) / kLastSinkRate_mps;
  const bool sinking = height_m < kSettleHeight_m - kOverSite_m;
  const double level_m = sinking ? 0 : above_m > 0 ? kLeadPerHeight * kSettleHeight_m : distance_m;
  const double settle_s = sinking ? 0 : kSettleTime_s;
  return above_m / descent_rate_mps + level_m / kLevelSpeed_mps + settle_s + sink_s;
}

void PublishGeometry(MissionMemory& m, const MissionInputs& in) {
  const LandingSite* site = m.status.armed ? &*m.status.armed : FindSite(m, m.winner.site_id);
  site = site != nullptr ? site : m.status.BestStanding(m.facts.sites);
  const Eigen::Vector3d& skid_W = in.navigation.skid_centre_W;
  m.status.height_above_site_m = m.status.distance_to_site_m = m.status.time_to_touchdown_s = NAN;
  if (site == nullptr || !skid_W.allFinite()) {
    return;
  }
  m.status.height_above_site_m = site->p_WS.z() - skid_W.z();
  m.status.distance_to_site_m = (site->p_WS - skid_W).head<2>().norm();
  m.status.time_to_touchdown_s = TimeLeft(m);
}

double LaserMismatch(const MissionInputs& in) {
  const FrameBundle& bundle = in.vehicle.bundle;
  const TerrainDecision* decision = in.terrain.decision;
  if (bundle.laser.empty() || !bundle.rig || !bundle.pose_at_exposure || decision == nullptr ||
      !decision->elevation) {
    return NAN;
  }
  // Where the beam meets the ground: p_WL = X_WB X_BC [0 0 range].
  const RigidTransform X_WC = bundle.pose_at_exposure->X_WB * bundle.rig->X_BC();
  const Eigen::Vector3d p_WL = X_WC * Eigen::Vector3d(0, 0, bundle.laser.back().range_m);
  const ElevationMap& map = *decision->elevation;
  const auto cell = map.geometry.CellFromPoint(p_WL.x(), p_WL.y());
  if (!p_WL.allFinite() || !cell || map.state.empty() ||
      map.state.at(*cell) != CellState::kMeasured) {
    return NAN;
  }
  return std::abs(HeightFromDown(p_WL.z()) - map.height_m.at(*cell));
}

std::optional<double> TouchdownMiss(const MissionMemory& m) {
  const Eigen::Vector3d miss = m.facts.skid_centre_W - m.status.armed->p_WS;
  return miss.allFinite() ? std::optional(miss.head<2>().norm()) : std::nullopt;
}

std::optional<double> TrueTouchdownMiss(const MissionMemory& m, const MissionInputs& in) {
  const auto& truth = in.vehicle.bundle.truth;
  if (truth.empty()) {
    return std::nullopt;
  }
  // The skid centre's place on the airframe is the same for estimate and truth.
  const Eigen::Vector3d skid_from_body = m.facts.skid_centre_W - in.navigation.p_WB_estimate;
  const Eigen::Vector3d skid_W = truth.back().X_WB.p + skid_from_body;
  return (skid_W - m.status.armed->p_WS).head<2>().norm();
}

}  // namespace palace
