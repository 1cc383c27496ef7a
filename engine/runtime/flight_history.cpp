#include "engine/runtime/flight_history.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"

namespace palace {
namespace {

constexpr std::size_t kMaxSamples = 6000;  // ten minutes at 10 Hz

double Horizontal(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return (from - to).head<2>().norm();
}

Eigen::Vector3d SkidOf(const Eigen::Vector3d& p_WB, const Eigen::Matrix3d& R_WB) {
  return p_WB + R_WB * SkidCentreBody();
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
  if (snapshot.mission.state == MissionState::kDescending) {
    // Signed distance of the camera off the line of sight, measured across it, up-positive.
    const double slope = Rad(snapshot.settings.mission.glide_slope_deg);
    const Eigen::Vector3d d = snapshot.X_WC.p - site.p_WS;
    sample.glide_deviation_m = -d.z() * std::cos(slope) - d.head<2>().norm() * std::sin(slope);
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
    sample.laser_m = bundle.laser.back().range_m;
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
