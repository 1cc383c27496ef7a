#include "engine/mission/geometry.h"

#include <cmath>

#include "engine/core/units.h"
#include "engine/flight/flight_path.h"
#include "engine/mission/descent_limits.h"
#include "engine/mission/limits.h"

namespace palace {
namespace {

ApproachPlan StraightPlan(const MissionFacts& facts, const Eigen::Vector3d& p_WS) {
  return {.heading_rad = StraightHeading(facts.skid_centre_W, p_WS),
          .glide_slope_rad = Rad(facts.limits.glide_slope_deg),
          .descent_rate_mps = facts.limits.descent_rate_mps};
}

/// The approved path, else the one that would be approved.
FlightPath PathTo(const MissionMemory& m, const LandingSite& site) {
  if (m.status.approval) {
    return PathOf(*m.status.approval, m.facts.p_BC);
  }
  const ApproachPlan plan =
      m.status.approach ? *m.status.approach : StraightPlan(m.facts, site.p_WS);
  return {site.p_WS,
          plan.heading_rad,
          plan.glide_slope_rad,
          m.facts.p_BC,
          {.sink_mps = plan.descent_rate_mps}};
}

double TimeLeft(const MissionMemory& m, const FlightPath& path) {
  switch (m.status.state) {
    case MissionState::kLanded:
      return 0;
    case MissionState::kHold:
    case MissionState::kAborting:
      return NAN;
    case MissionState::kDescending:
      return TimeToTouchdown(path, m.facts.p_WB, m.facts.v_WB);
    default:
      return TimeToAlign(path, m.facts.p_WB, m.facts.yaw_rad) +
             TimeToTouchdown(path, path.Start(m.facts.p_WB), Eigen::Vector3d::Zero());
  }
}

VehicleMode ModeOf(const MissionMemory& m) {
  return m.watch.vehicle() ? m.watch.vehicle()->mode : VehicleMode::kUnknown;
}

bool FliesPath(const MissionMemory& m) {
  const VehicleMode mode = ModeOf(m);
  // Turning towards its start is no deviation from it.
  return m.status.state == MissionState::kDescending && m.status.approval &&
         (mode == VehicleMode::kDescend || mode == VehicleMode::kSettle ||
          mode == VehicleMode::kSink);
}

DescentFigures FiguresOf(const MissionMemory& m, const MissionInputs& in) {
  const NavigationStatus& navigation = in.navigation.navigation;
  const TrackerStatus& tracker = in.navigation.tracker;
  const bool on_vision = navigation.handover == NavigationStatus::Handover::kVision;
  const PositionEstimate& estimate = (on_vision ? navigation.vision : navigation.gps).estimate;
  const LandingSite* site = SiteInQuestion(m);
  DescentFigures f;
  f.state = m.status.state;
  f.mode = ModeOf(m);
  f.off_path_m = m.status.path.off_path_m;
  f.from_centre_m = m.status.distance_to_site_m;
  f.horizontal_3s_m = 3 * estimate.sigma_p_m.head<2>().norm();
  f.descent_rate_mps = m.facts.v_WB.z();
  f.descent_rate_3s_mps = 3 * estimate.sigma_v_mps.z();
  f.approved_rate_mps =
      m.status.approach ? m.status.approach->descent_rate_mps : m.facts.limits.descent_rate_mps;
  f.nav_error_m = in.limits.settings.slad.lander.nav_error_m;
  f.tracked = tracker.locked;
  f.coherence = tracker.coherence;
  f.min_coherence = in.limits.settings.tracking.min_coherence;
  f.residual_sigma = navigation.vision.residual_sigma;
  f.max_residual_sigma = navigation.vision.max_residual_sigma;
  f.wind_mps = KnownWind(m, in.session.now);
  if (site != nullptr && std::isfinite(f.wind_mps)) {
    f.off_wind_rad =
        std::abs(WrapAngle(PathTo(m, *site).heading_rad - m.watch.vehicle()->wind_from_rad));
  }
  return f;
}

}  // namespace

double HeightAboveSite(const MissionMemory& m) {
  // Down is positive in W: the skid is above the site when its z is smaller.
  return m.status.armed ? m.status.armed->p_WS.z() - m.facts.skid_centre_W.z() : NAN;
}

const LandingSite* SiteInQuestion(const MissionMemory& m) {
  if (m.status.armed) {
    return &*m.status.armed;
  }
  const LandingSite* leader = FindSite(m, m.winner.site_id);
  return leader != nullptr ? leader : m.status.BestStanding(m.facts.sites);
}

void PlanApproach(MissionMemory& m) {
  if (m.status.armed && !m.status.approach && m.facts.skid_centre_W.allFinite()) {
    m.status.approach = StraightPlan(m.facts, m.status.armed->p_WS);
  }
}

double KnownWind(const MissionMemory& m, Timestamp now) {
  const bool fresh = m.watch.LinkAge(now) <= GuardLimits::link_s;
  return fresh && m.watch.vehicle() ? m.watch.vehicle()->wind_speed_mps : NAN;
}

void PublishGeometry(MissionMemory& m, const MissionInputs& in) {
  const LandingSite* site = SiteInQuestion(m);
  const Eigen::Vector3d& skid_W = in.navigation.skid_centre_W;
  m.status.height_above_site_m = m.status.distance_to_site_m = m.status.time_to_touchdown_s = NAN;
  m.status.path = {};
  if (site == nullptr || !skid_W.allFinite()) {
    return;
  }
  m.status.height_above_site_m = site->p_WS.z() - skid_W.z();
  m.status.distance_to_site_m = (site->p_WS - skid_W).head<2>().norm();
  const FlightPath path = PathTo(m, *site);
  m.status.time_to_touchdown_s = TimeLeft(m, path);
  if (FliesPath(m) && m.facts.p_WB.allFinite() && m.facts.v_WB.allFinite()) {
    m.status.path = ProgressOn(path, m.facts.p_WB, m.facts.v_WB);
  }
}

void PublishLimits(MissionMemory& m, const MissionInputs& in) {
  std::vector<LimitRow>& limits = m.status.limits;
  limits = LimitsOfDescent(FiguresOf(m, in));
  const auto add = [&](const std::vector<LimitRow>& rows) {
    limits.insert(limits.end(), rows.begin(), rows.end());
  };
  if (m.status.armed && (m.newest || !m.site.evaluated())) {
    add(SiteLimits(m.newest ? *m.newest : *m.status.armed, in.limits.settings.slad));
  }
  add(LimitsOfCameras(in.navigation.stereo, in.navigation.range_agreement));
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
