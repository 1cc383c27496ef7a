#include "engine/flight/flight_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palace {
namespace {

constexpr double kSlowestSink_mps = 0.1;
constexpr double kArrived_m = 0.05;
constexpr double kStep_s = 0.1;
constexpr double kLongest_s = 3600;
constexpr double kLastWait_s = 0.5;  // at least so long, while the vehicle still waits
constexpr double kAhead_s = 60;
constexpr int kStepsShown = 5;  ///< one planned height each half second

/// Nearest point to p of the segment from a to b.
Eigen::Vector3d NearestOnSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& p) {
  const Eigen::Vector3d along = b - a;
  const double share = along.dot(p - a) / std::max(along.squaredNorm(), 1e-12);
  return a + std::clamp(share, 0.0, 1.0) * along;
}

}  // namespace

double DescentSpeeds::SinkRateAt(double skid_height_m) const {
  const double to_go_m = std::max(skid_height_m - slope_end_m, 0.0);
  const double braking_mps = std::max(kSlowestSink_mps, std::sqrt(2 * acceleration_mps2 * to_go_m));
  const double slow_to_go_m = std::max(skid_height_m - slow_height_m, 0.0);
  return std::min({sink_mps, braking_mps,
                   std::hypot(slow_sink_mps, std::sqrt(2 * acceleration_mps2 * slow_to_go_m))});
}

Eigen::Matrix3d FlightPath::LevelRotation() const { return RotationFromEuler({0, 0, heading_rad}); }

Eigen::Vector3d FlightPath::BodyPerMetre() const {
  const double back = std::cos(slope_rad) / std::sin(slope_rad);
  return {-back * std::cos(heading_rad), -back * std::sin(heading_rad), -1.0};
}

Eigen::Vector3d FlightPath::BodyAt(double skid_height_m) const {
  const double camera_height_m = skid_height_m + skid_centre_B.z() - p_BC.z();
  return p_WS + camera_height_m * BodyPerMetre() - LevelRotation() * p_BC;
}

Eigen::Vector3d FlightPath::BodyAboveSite(double skid_height_m) const {
  return p_WS - skid_height_m * Eigen::Vector3d::UnitZ() - LevelRotation() * skid_centre_B;
}

double FlightPath::SkidHeight(const Eigen::Vector3d& p_WB) const {
  return p_WS.z() - (p_WB.z() + skid_centre_B.z());
}

Eigen::Vector3d FlightPath::Start(const Eigen::Vector3d& p_WB) const {
  return BodyAt(std::max(SkidHeight(p_WB), kSettleHeight_m));
}

PathPoint FlightPath::Nearest(const Eigen::Vector3d& p_WB) const {
  const double high_m = std::max(SkidHeight(p_WB), kSettleHeight_m) + kSettleHeight_m;
  const Eigen::Vector3d corners[] = {BodyAt(high_m), BodyAt(kSettleHeight_m),
                                     BodyAboveSite(kSettleHeight_m), BodyAboveSite(0)};
  PathPoint nearest{PathLeg::kSlope, corners[0], high_m};
  for (const PathLeg leg : {PathLeg::kSlope, PathLeg::kLevel, PathLeg::kSink}) {
    const auto i = static_cast<std::size_t>(leg);
    const Eigen::Vector3d candidate = NearestOnSegment(corners[i], corners[i + 1], p_WB);
    if ((candidate - p_WB).norm() < (nearest.p_WB - p_WB).norm()) {
      nearest = {leg, candidate, SkidHeight(candidate)};
    }
  }
  return nearest;
}

FlightPath PathOf(const ApproachPlan& plan, const Eigen::Vector3d& p_WS,
                  const PathVehicle& vehicle) {
  return {.p_WS = p_WS,
          .heading_rad = plan.heading_rad,
          .slope_rad = plan.glide_slope_rad,
          .p_BC = vehicle.p_BC,
          .skid_centre_B = vehicle.skid_centre_B,
          .speeds = {.sink_mps = plan.descent_rate_mps, .settle_s = vehicle.settle_s}};
}

FlightPath PathOf(const Approval& approval, const PathVehicle& vehicle) {
  FlightPath path = PathOf({.heading_rad = approval.approach_heading_rad,
                            .glide_slope_rad = approval.glide_slope_rad,
                            .descent_rate_mps = approval.descent_rate_mps,
                            .why = {}},
                           approval.p_WS, vehicle);
  path.speeds.slope_end_m = std::max(path.speeds.slope_end_m, approval.stop_height_m);
  return path;
}

double StraightHeading(const Eigen::Vector3d& p_W_skid, const Eigen::Vector3d& p_WS) {
  const Eigen::Vector3d way = p_WS - p_W_skid;
  return std::atan2(way.y(), way.x());
}

double TimeToAlign(const FlightPath& path, const Eigen::Vector3d& p_WB, double yaw_rad) {
  const double way_s = TravelTime((path.Start(p_WB) - p_WB).norm(), path.speeds.align);
  const double turn_s =
      std::abs(WrapAngle(path.heading_rad - yaw_rad)) / path.speeds.turn_rate_rad_s;
  // Not std::max alone: of an unknown number it returns the other.
  const double longer_s = way_s + std::max(turn_s - way_s, 0.0);
  return longer_s + path.speeds.hand_over_s;
}

TimedDescent::TimedDescent(const FlightPath& path, const Eigen::Vector3d& p_WB,
                           const Eigen::Vector3d& v_WB, const std::optional<LegFlown>& flown)
    : path_(path) {
  const PathPoint start = path.Nearest(p_WB);
  leg_ = flown ? flown->leg : start.leg;
  skid_height_m_ = leg_ == start.leg ? start.skid_height_m : path.SkidHeight(p_WB);
  sink_mps_ = std::max(0.0, v_WB.z());
  if (flown && leg_ == PathLeg::kLevel) {
    // By the clock since it began, up to the last moment of the wait: in gusts it takes longer.
    sink_mps_ = path.speeds.SinkRateAt(kSettleHeight_m);
    StartLevel(path.BodyAt(kSettleHeight_m), -sink_mps_ * path.BodyPerMetre());
    for (double t_s = 0; t_s < flown->for_s && settled_s_ < path.speeds.settle_s - kLastWait_s;
         t_s += kStep_s) {
      Step(kStep_s);
    }
    return;
  }
  StartLevel(leg_ == PathLeg::kLevel ? start.p_WB : path.BodyAt(kSettleHeight_m), v_WB);
}

void TimedDescent::StartLevel(const Eigen::Vector3d& from_W, const Eigen::Vector3d& v_WB) {
  if (leg_ == PathLeg::kLevel) {
    skid_height_m_ = kSettleHeight_m;
  }
  level_.p_W = from_W;
  level_.v_W = {v_WB.x(), v_WB.y(), 0};
}

void TimedDescent::Sink(double wanted_mps, double dt_s) {
  sink_mps_ = Slew(sink_mps_, wanted_mps, path_.speeds.acceleration_mps2 * dt_s);
  skid_height_m_ -= sink_mps_ * dt_s;
}

void TimedDescent::Step(double dt_s) {
  const DescentSpeeds& speeds = path_.speeds;
  if (leg_ == PathLeg::kSlope) {
    Sink(speeds.SinkRateAt(skid_height_m_), dt_s);
    if (skid_height_m_ <= kSettleHeight_m && !path_.IsLook()) {
      leg_ = PathLeg::kLevel;
      skid_height_m_ = kSettleHeight_m;
      level_.v_W = -sink_mps_ * path_.BodyPerMetre();
      level_.v_W.z() = 0;
    }
  } else if (leg_ == PathLeg::kLevel) {
    const Eigen::Vector3d above_site = path_.BodyAboveSite(kSettleHeight_m);
    level_.MoveTowards(above_site, speeds.level, dt_s);
    settled_s_ += (level_.p_W - above_site).norm() < kArrived_m ? dt_s : 0;
    if (settled_s_ >= speeds.settle_s) {
      leg_ = PathLeg::kSink;
      sink_mps_ = 0;
    }
  } else if (!over()) {
    Sink(speeds.touch_mps, dt_s);
  }
}

double TimeToTouchdown(const FlightPath& path, const Eigen::Vector3d& p_WB,
                       const Eigen::Vector3d& v_WB, const std::optional<LegFlown>& flown) {
  if (!p_WB.allFinite() || !v_WB.allFinite() || !path.p_WS.allFinite() ||
      !std::isfinite(path.heading_rad) || !std::isfinite(path.slope_rad)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  TimedDescent descent(path, p_WB, v_WB, flown);
  for (int step = 0; step * kStep_s < kLongest_s; ++step) {
    if (descent.over()) {
      return step * kStep_s;
    }
    descent.Step(kStep_s);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

PathProgress ProgressOn(const FlightPath& path, const Eigen::Vector3d& p_WB,
                        const Eigen::Vector3d& v_WB, const std::optional<LegFlown>& flown) {
  const PathPoint planned = path.Nearest(p_WB);
  PathProgress progress{planned.skid_height_m, (p_WB - planned.p_WB).norm(), {}};
  TimedDescent descent(path, p_WB, v_WB, flown);
  for (int step = 0; step * kStep_s <= kAhead_s && !descent.over(); ++step) {
    if (step % kStepsShown == 0) {
      progress.ahead.push_back({step * kStep_s, descent.skid_height_m()});
    }
    descent.Step(kStep_s);
  }
  return progress;
}

}  // namespace palace
