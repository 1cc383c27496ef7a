#include "engine/runtime/flight_history.h"

#include <cmath>

#include "engine/model/mission/wave_off_offer.h"

namespace palace {
namespace {

constexpr std::size_t kMaxSamples = 6000;  // ten minutes at 10 Hz

double Horizontal(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return (from - to).head<2>().norm();
}

Eigen::Vector3d SkidOf(const EngineSnapshot& snapshot, const Eigen::Vector3d& p_WB,
                       const Eigen::Matrix3d& R_WB) {
  return p_WB + R_WB * snapshot.session->settings.slad.lander.skid_centre_B();
}

/// Nothing of the vehicle's own motion was heard for so long. A session without a vehicle, whose
/// channels never spoke, is not silent.
bool IsVehicleSilent(const std::vector<ChannelHealth>& channels) {
  double newest_s = NAN;
  for (const ChannelId id :
       {ChannelId::kVehiclePose, ChannelId::kImu, ChannelId::kGps, ChannelId::kVehicleStatus}) {
    const ChannelHealth* channel = FindChannel(channels, id);
    const bool heard = channel != nullptr && channel->state != ChannelHealth::State::kNever;
    newest_s = heard ? std::fmin(newest_s, channel->age_s) : newest_s;
  }
  return newest_s > kLinkSilent_s;
}

/// The beam runs along the optical axis of the left camera. By attitude and rig alone: it goes on
/// where no picture comes and no position is known.
double SkidsOverSpot(const EngineSnapshot& snapshot, const Eigen::Matrix3d& R_WB,
                     const LaserRange& laser) {
  const RigidTransform X_BC = snapshot.sensors->rig->X_BC();
  const Eigen::Vector3d spot_B = X_BC * Eigen::Vector3d(0, 0, laser.range_m);
  return (R_WB * (spot_B - snapshot.session->settings.slad.lander.skid_centre_B())).z();
}

void AddSiteFigures(HistorySample& sample, const EngineSnapshot& snapshot,
                    const Eigen::Matrix3d& R_WB) {
  const MissionStatus& mission = snapshot.flight->mission;
  const LandingSite& site = *mission.armed;
  const Eigen::Vector3d by_gps = SkidOf(snapshot, sample.gps_p_WB, R_WB);
  sample.gps_height_m = site.p_WS.z() - by_gps.z();
  sample.from_site_gps_m = Horizontal(by_gps, site.p_WS);
  if (snapshot.sensors->truth) {
    const Eigen::Vector3d in_truth =
        SkidOf(snapshot, sample.truth_p_WB, snapshot.sensors->truth->X_WB.R);
    sample.truth_height_m = site.p_WS.z() - in_truth.z();
    sample.from_site_truth_m = Horizontal(in_truth, site.p_WS);
  }
  const LimitRow* centre = FindLimit(mission.limits, LimitId::kFromCentre);
  sample.centre_limited = centre != nullptr && centre->enforced_by != EnforcedBy::kNobody;
  sample.plan_height_m = mission.path.plan_height_m;
  sample.glide_deviation_m = mission.path.off_path_m;
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
  sample.state = snapshot.flight->mission.state;
  sample.rebuilding = snapshot.terrain->maps_to_rebuild > 0;
  const NavigationStatus& nav = snapshot.flight->navigation;
  const FilterStatus& filter = nav.InForce();
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();
  if (snapshot.sensors->pose) {
    R_WB = snapshot.sensors->pose->X_WB.R;
    sample.estimate_p_WB = snapshot.sensors->pose->X_WB.p;
    sample.estimate_v_WB = snapshot.sensors->pose->v_WB;
  }
  const bool silent = IsVehicleSilent(snapshot.sensors->channels);
  if (silent || (filter.running && filter.IsUnknown())) {
    sample.estimate_p_WB = sample.estimate_v_WB = Eigen::Vector3d::Constant(NAN);
    if (filter.running) {
      sample.estimate_sigma_m = filter.estimate.sigma_p_m;  // goes on growing
      sample.descent_rate_sigma_mps = filter.estimate.sigma_v_mps.z();
    }
  } else if (filter.running) {
    sample.estimate_p_WB = filter.estimate.p_WB;
    sample.estimate_v_WB = filter.estimate.v_WB;
    sample.estimate_sigma_m = filter.estimate.sigma_p_m;
    sample.descent_rate_sigma_mps = filter.estimate.sigma_v_mps.z();
  }
  if (nav.gps.running && !silent && !nav.gps.IsUnknown()) {
    sample.gps_p_WB = nav.gps.estimate.p_WB;
  }
  if (snapshot.sensors->truth) {
    sample.truth_p_WB = snapshot.sensors->truth->X_WB.p;
  }
  sample.descent_rate_mps = sample.estimate_v_WB.z();
  if (!bundle.laser.empty() && snapshot.sensors->rig && snapshot.sensors->pose) {
    sample.laser_m = SkidsOverSpot(snapshot, R_WB, bundle.laser.back());
    sample.laser_time = bundle.laser.back().time;
  }
  if (snapshot.flight->tracker.locked) {
    sample.coherence = snapshot.flight->tracker.coherence;
    sample.residual_sigma = nav.vision.residual_sigma;
  }
  const TerrainDecision* map = snapshot.terrain->applied.get();
  const LandingSite* best =
      map != nullptr ? snapshot.flight->mission.BestStanding(map->selection.sites) : nullptr;
  if (best != nullptr) {
    sample.best_site = best->letter;
    sample.best_safe_distance_m = best->safe_distance_m;
  }
  sample.p_WS = snapshot.flight->mission.site_p_WS;
  sample.height_above_site_m = snapshot.flight->mission.height_above_site_m;
  sample.from_site_m = snapshot.flight->mission.distance_to_site_m;
  if (snapshot.flight->mission.armed) {
    AddSiteFigures(sample, snapshot, R_WB);
  }
  if (silent) {
    sample.height_above_site_m = sample.from_site_m = sample.glide_deviation_m = NAN;
  }
  return sample;
}

}  // namespace palace
