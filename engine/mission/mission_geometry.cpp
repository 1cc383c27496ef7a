// Where the vehicle is: on the way to the site, and against the limits of that way.
#include <cmath>

#include "engine/core/units.h"
#include "engine/mission/descent_limits.h"
#include "engine/mission/mission.h"

namespace palace {

void Mission::PublishGeometry(const MissionInputs& in) {
  const LandingSite* site = SiteInQuestion();
  status_.height_above_site_m = status_.distance_to_site_m = status_.time_to_touchdown_s = NAN;
  status_.path = {};
  if (site == nullptr || !in.skid_centre_W.allFinite()) {
    return;
  }
  status_.height_above_site_m = site->p_WS.z() - in.skid_centre_W.z();
  status_.distance_to_site_m = (site->p_WS - in.skid_centre_W).head<2>().norm();
  const FlightPath path = PathTo(*site);
  status_.time_to_touchdown_s = TimeLeft(path);
  if (FliesPath() && facts_.p_WB.allFinite() && facts_.v_WB.allFinite()) {
    status_.path = ProgressOn(path, facts_.p_WB, facts_.v_WB);
  }
}

const LandingSite* Mission::SiteInQuestion() const {
  if (status_.armed) {
    return &*status_.armed;
  }
  const LandingSite* leader = FindSite(winner_.id);
  return leader != nullptr ? leader : status_.BestStanding(facts_.sites);
}

FlightPath Mission::PathTo(const LandingSite& site) const {
  if (status_.approval) {
    return PathOf(*status_.approval, facts_.p_BC);
  }
  const ApproachPlan plan = status_.approach ? *status_.approach : StraightPlan(site.p_WS);
  return {site.p_WS,
          plan.heading_rad,
          plan.glide_slope_rad,
          facts_.p_BC,
          {.sink_mps = plan.descent_rate_mps}};
}

ApproachPlan Mission::StraightPlan(const Eigen::Vector3d& p_WS) const {
  return {StraightHeading(facts_.skid_centre_W, p_WS), Rad(facts_.limits.glide_slope_deg),
          facts_.limits.descent_rate_mps};
}

void Mission::PlanApproach() {
  if (status_.armed && !status_.approach && facts_.skid_centre_W.allFinite()) {
    status_.approach = StraightPlan(status_.armed->p_WS);
  }
}

double Mission::KnownWind(Timestamp now) const {
  const bool fresh = watch_.LinkAge(now) <= GuardLimits::link_s;
  return fresh && watch_.vehicle() ? watch_.vehicle()->wind_speed_mps : NAN;
}

void Mission::PublishLimits(const MissionInputs& in) {
  const bool on_vision = in.navigation.handover == NavigationStatus::Handover::kVision;
  const PositionEstimate& estimate =
      (on_vision ? in.navigation.vision : in.navigation.gps).estimate;
  const LandingSite* site = SiteInQuestion();
  DescentFigures f;
  f.state = status_.state;
  f.mode = watch_.vehicle() ? watch_.vehicle()->mode : VehicleMode::kUnknown;
  f.off_path_m = status_.path.off_path_m;
  f.from_centre_m = status_.distance_to_site_m;
  f.horizontal_3s_m = 3 * estimate.sigma_p_m.head<2>().norm();
  f.descent_rate_mps = facts_.v_WB.z();
  f.descent_rate_3s_mps = 3 * estimate.sigma_v_mps.z();
  f.approved_rate_mps =
      status_.approach ? status_.approach->descent_rate_mps : facts_.limits.descent_rate_mps;
  f.nav_error_m = in.settings.slad.nav_error_m;
  f.tracked = in.tracker.locked;
  f.coherence = in.tracker.coherence;
  f.min_coherence = in.settings.tracking.min_coherence;
  f.residual_sigma = in.navigation.vision.residual_sigma;
  f.max_residual_sigma = in.navigation.vision.max_residual_sigma;
  f.wind_mps = KnownWind(in.now);
  if (site != nullptr && std::isfinite(f.wind_mps)) {
    f.off_wind_rad =
        std::abs(WrapAngle(PathTo(*site).heading_rad - watch_.vehicle()->wind_from_rad));
  }
  status_.limits = LimitsOfDescent(f);
  const auto add = [&](const std::vector<LimitRow>& rows) {
    status_.limits.insert(status_.limits.end(), rows.begin(), rows.end());
  };
  if (status_.armed && (newest_ || !site_.evaluated())) {
    add(SiteLimits(newest_ ? *newest_ : *status_.armed, in.settings.slad));
  }
  add(LimitsOfCameras(in.stereo, in.range_agreement));
}

double Mission::TimeLeft(const FlightPath& path) const {
  switch (status_.state) {
    case MissionState::kLanded:
      return 0;
    case MissionState::kHold:
    case MissionState::kAborting:
      return NAN;
    case MissionState::kDescending:
      return TimeToTouchdown(path, facts_.p_WB, facts_.v_WB);
    default:
      return TimeToAlign(path, facts_.p_WB, facts_.yaw_rad) +
             TimeToTouchdown(path, path.Start(facts_.p_WB), Eigen::Vector3d::Zero());
  }
}

bool Mission::FliesPath() const {
  const VehicleMode mode = watch_.vehicle() ? watch_.vehicle()->mode : VehicleMode::kUnknown;
  // Turning towards its start is no deviation from it.
  return status_.state == MissionState::kDescending && status_.approval &&
         (mode == VehicleMode::kDescend || mode == VehicleMode::kSettle ||
          mode == VehicleMode::kSink);
}

}  // namespace palace
