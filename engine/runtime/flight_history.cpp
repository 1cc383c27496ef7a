#include "engine/runtime/flight_history.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"
#include "engine/flight/glide_slope.h"

namespace palace {
namespace {

constexpr std::size_t kMaxSamples = 6000;  // ten minutes at 10 Hz

double Horizontal(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return (from - to).head<2>().norm();
}

Eigen::Vector3d SkidOf(const Eigen::Vector3d& p_WB, const Eigen::Matrix3d& R_WB) {
  return p_WB + R_WB * SkidCentreBody();
}

/// Nearest point to p of the segment from a to b.
Eigen::Vector3d NearestOnSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& p) {
  const Eigen::Vector3d along = b - a;
  const double share = along.dot(p - a) / std::max(along.squaredNorm(), 1e-12);
  return a + std::clamp(share, 0.0, 1.0) * along;
}

/// Where B should be now: the nearest point of the whole path. The path runs down the line of sight
/// to kSettleHeight_m, level until the skids are above the site, then straight down.
Eigen::Vector3d NearestOnPath(const GlideSlope& slope, const Eigen::Vector3d& p_WB) {
  const double high_m = std::max(slope.SkidHeight(p_WB), kSettleHeight_m) + kSettleHeight_m;
  const Eigen::Vector3d corners[] = {slope.BodyAt(high_m), slope.BodyAt(kSettleHeight_m),
                                     slope.BodyAboveSite(kSettleHeight_m), slope.BodyAboveSite(0)};
  Eigen::Vector3d nearest = corners[0];
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d candidate = NearestOnSegment(corners[i], corners[i + 1], p_WB);
    if ((candidate - p_WB).norm() < (nearest - p_WB).norm()) {
      nearest = candidate;
    }
  }
  return nearest;
}

/// Only while the vehicle flies the path: turning towards its start is no deviation from it.
bool FliesPath(const EngineSnapshot& snapshot) {
  if (snapshot.mission.state != MissionState::kDescending || !snapshot.mission.approval ||
      !snapshot.rig) {
    return false;
  }
  const VehicleMode mode = snapshot.vehicle ? snapshot.vehicle->mode : VehicleMode::kUnknown;
  return mode == VehicleMode::kDescend || mode == VehicleMode::kSettle ||
         mode == VehicleMode::kSink;
}

void AddSiteFigures(HistorySample& sample, const EngineSnapshot& snapshot,
                    const Eigen::Matrix3d& R_WB) {
  const LandingSite& site = *snapshot.mission.armed;
  const Eigen::Vector3d skid = SkidOf(sample.estimate_p_WB, R_WB);
  sample.height_above_site_m = site.p_WS.z() - skid.z();
  sample.from_site_m = Horizontal(skid, site.p_WS);
  sample.from_site_gps_m = Horizontal(SkidOf(sample.gps_p_WB, R_WB), site.p_WS);
  if (snapshot.truth) {
    sample.from_site_truth_m =
        Horizontal(SkidOf(sample.truth_p_WB, snapshot.truth->X_WB.R), site.p_WS);
  }
  if (FliesPath(snapshot) && sample.estimate_p_WB.allFinite()) {
    const Approval& approval = *snapshot.mission.approval;
    const GlideSlope slope{approval.p_WS, approval.approach_heading_rad, approval.glide_slope_rad,
                           snapshot.rig->position_body_m};
    const Eigen::Vector3d planned = NearestOnPath(slope, sample.estimate_p_WB);
    sample.plan_height_m = slope.SkidHeight(planned);
    sample.glide_deviation_m = (sample.estimate_p_WB - planned).norm();
  }
}

}  // namespace

void FlightHistory::Add(const HistorySample& sample) {
  if (samples_.size() >= kMaxSamples) {
    samples_.erase(samples_.begin(), samples_.begin() + kMaxSamples / 10);
  }
  samples_.push_back(sample);
}

std::shared_ptr<const std::vector<HistorySample>> FlightHistory::Publish() const {
  return std::make_shared<const std::vector<HistorySample>>(samples_);
}

HistorySample SampleOf(const EngineSnapshot& snapshot, const FrameBundle& bundle) {
  HistorySample sample;
  sample.time = snapshot.time;
  sample.state = snapshot.mission.state;
  sample.rebuilding = snapshot.maps_to_rebuild > 0;
  const NavigationStatus& nav = snapshot.navigation;
  const bool vision = nav.handover == NavigationStatus::Handover::kVision;
  const FilterStatus& filter = vision ? nav.vision : nav.gps;
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();
  if (snapshot.pose) {
    R_WB = snapshot.pose->X_WB.R;
    sample.estimate_p_WB = snapshot.pose->X_WB.p;
    sample.estimate_v_WB = snapshot.pose->v_WB;
  }
  if (filter.running) {
    sample.estimate_p_WB = filter.estimate.p_WB;
    sample.estimate_v_WB = filter.estimate.v_WB;
    sample.estimate_sigma_m = filter.estimate.sigma_p_m;
  }
  if (nav.gps.running) {
    sample.gps_p_WB = nav.gps.estimate.p_WB;
  }
  if (snapshot.truth) {
    sample.truth_p_WB = snapshot.truth->X_WB.p;
  }
  sample.descent_rate_mps = sample.estimate_v_WB.z();
  if (!bundle.laser.empty()) {
    // The beam runs along the optical axis: the height of the skids above its spot.
    const double skid_below_m = SkidOf(sample.estimate_p_WB, R_WB).z() - snapshot.X_WC.p.z();
    sample.laser_m = bundle.laser.back().range_m * snapshot.X_WC.R(2, 2) - skid_below_m;
  }
  if (snapshot.tracker.locked) {
    sample.coherence = snapshot.tracker.coherence;
    sample.residual_sigma = nav.vision.residual_sigma;
  }
  if (snapshot.applied && !snapshot.applied->selection.sites.empty()) {
    sample.best_site = snapshot.applied->selection.sites.front().letter;
    sample.best_safe_distance_m = snapshot.applied->selection.sites.front().safe_distance_m;
  }
  if (snapshot.mission.armed) {
    AddSiteFigures(sample, snapshot, R_WB);
  }
  return sample;
}

}  // namespace palace
