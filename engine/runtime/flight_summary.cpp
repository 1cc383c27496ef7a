#include "engine/runtime/flight_summary.h"

#include <algorithm>
#include <cmath>

#include "engine/core/text.h"

namespace palace {

void SeriesStats::Add(double value) {
  if (!std::isfinite(value)) {
    return;
  }
  ++count;
  mean += (value - mean) / count;
  max = std::max(max, value);
}

void FlightSummarizer::Add(const EngineSnapshot& snapshot) {
  if (snapshot.sequence == last_sequence_) {
    return;
  }
  last_sequence_ = snapshot.sequence;
  if (!start_ || *start_ == Timestamp{}) {  // zero: a live source has heard nothing yet
    start_ = snapshot.time;
  }
  // The clock of a vehicle that restarts begins anew.
  if (!FollowsRecord(snapshot.session->role) && snapshot.time < newest_) {
    before_s_ += SecondsBetween(*start_, newest_);
    start_ = snapshot.time;
  }
  newest_ = snapshot.time;
  summary_.duration_s = before_s_ + SecondsBetween(*start_, snapshot.time);
  const MissionStatus& mission = snapshot.flight->mission;
  summary_.final_state = mission.state;
  summary_.lander_radius_m = snapshot.session->settings.slad.lander.radius_m();
  const bool flying = mission.state != MissionState::kLanded;
  summary_.looks += looking_ && mission.state == MissionState::kSearch ? 1 : 0;
  looking_ = IsFlying(mission.state) && mission.IsLook();
  if (mission.approval && mission.armed && !mission.IsLook()) {
    summary_.site = mission.armed;
    summary_.site_confirmed = !mission.approval->provisional;
    summary_.approved_at = mission.approval->approved_at;
    if (scene_) {
      const Eigen::Vector3d& p = summary_.site->p_WS;
      summary_.site_obstacle_distance_m = ObstacleDistance(*scene_, p.x(), p.y());
    }
  }
  if (snapshot.sensors->truth && flying) {
    const Eigen::Vector3d& truth = snapshot.sensors->truth->X_WB.p;
    const NavigationStatus& nav = snapshot.flight->navigation;
    if (nav.gps.running) {
      summary_.gps_error_m.Add((nav.gps.estimate.p_WB - truth).norm());
    }
    if (nav.OnVision() && nav.vision.running) {
      summary_.estimate_error_m.Add((nav.vision.estimate.p_WB - truth).norm());
    }
    if (nav.InForce().running) {
      summary_.approach_error_m.Add((nav.InForce().estimate.p_WB - truth).norm());
    }
  }
  if (!flying && summary_.site && !summary_.estimated_miss_m) {
    summary_.estimated_miss_m = mission.touchdown_miss_m;
    summary_.touchdown_sink_mps = mission.touchdown_sink_mps;
    summary_.nav_error_m = snapshot.session->settings.slad.lander.nav_error_m;
  }
  if (!flying && snapshot.sensors->truth && summary_.site && !summary_.touchdown_miss_m) {
    const Eigen::Vector3d skid =
        snapshot.sensors->truth->X_WB * snapshot.session->settings.slad.lander.skid_centre_B();
    summary_.touchdown_miss_m = (skid - summary_.site->p_WS).head<2>().norm();
  }
}

std::vector<std::string> SummaryLines(const FlightSummary& s) {
  std::vector<std::string> lines;
  lines.push_back(std::string("Final state: ") + MissionStateName(s.final_state));
  lines.push_back(WithNumbers("Flight time: %.1f s", s.duration_s));
  if (s.looks > 0) {
    lines.push_back(WithNumbers("Closer looks: %.0f", s.looks));
  }
  if (s.site) {
    lines.push_back(std::string("Site ") + s.site->letter +
                    WithNumbers(": %.2f m north, %.2f m east, safe distance %.2f m",
                                s.site->p_WS.x(), s.site->p_WS.y(), s.site->safe_distance_m));
  }
  if (s.site_obstacle_distance_m) {
    lines.push_back(
        WithNumbers("Nearest thing that truly stands there, however low: %.2f m from the site "
                    "(lander radius %.2f m)",
                    *s.site_obstacle_distance_m, s.lander_radius_m));
  }
  if (s.touchdown_miss_m) {
    lines.push_back(
        WithNumbers("Touchdown: %.3f m from the approved site (true)", *s.touchdown_miss_m));
  }
  if (s.estimated_miss_m) {
    lines.push_back(WithNumbers(
        "Touchdown by the estimate: %.2f m from the approved site; %.2f m was allowed for",
        *s.estimated_miss_m, s.nav_error_m));
  }
  if (s.touchdown_sink_mps) {
    lines.push_back(
        WithNumbers("Touchdown sink rate by the estimate: %.2f m/s", *s.touchdown_sink_mps));
  }
  if (s.estimate_error_m.count > 0) {
    lines.push_back(
        WithNumbers("Vision estimate against truth: mean %.3f m, max %.3f m over %.0f frames",
                    s.estimate_error_m.mean, s.estimate_error_m.max, s.estimate_error_m.count));
  }
  if (s.gps_error_m.count > 0) {
    lines.push_back(
        WithNumbers("GPS estimate against truth: mean %.3f m, max %.3f m over %.0f frames",
                    s.gps_error_m.mean, s.gps_error_m.max, s.gps_error_m.count));
  }
  return lines;
}

}  // namespace palace
