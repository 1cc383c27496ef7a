#include "engine/mission/way_rules.h"

#include "engine/core/frames.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/flight/level_way.h"
#include "engine/mission/wording.h"

namespace palace {
namespace {

constexpr double kLower_m = 0.5;   // of a level way: what a hover strays
constexpr double kNoWay_m = 0.05;  // nor a turn
constexpr double kNoTurn_rad = Rad(0.5);
constexpr double kOnTheSpot_m = 0.5;

std::string WhyLeavesArea(const WayFacts& from, const Eigen::Vector3d& to_W) {
  if (from.area == nullptr) {
    return {};
  }
  const double height_m = HeightFromDown(to_W.z());
  if (height_m > from.area->ceiling_m) {
    return WithNumbers("%.0f m high, ceiling %.0f m", height_m, from.area->ceiling_m);
  }
  const Eigen::Vector2d begin = from.p_WB.head<2>(), end = to_W.head<2>();
  // Outside it may turn and climb where it hovers, to see the way in.
  const bool stays = (end - begin).norm() <= kOnTheSpot_m && !IsInside(*from.area, begin);
  return stays ? std::string() : words::WayLeavesArea(*from.area, begin, end);
}

/// Where it hovers it may turn and climb, whatever stands below it.
std::string WhatStandsThere(const WayFacts& from, const Eigen::Vector3d& to_W) {
  const Eigen::Vector2d begin = from.p_WB.head<2>(), end = to_W.head<2>();
  if (from.elevation == nullptr || (end - begin).norm() <= kOnTheSpot_m) {
    return {};
  }
  const double skids_m = HeightFromDown(to_W.z() + from.lander.skid_centre_B().z());
  const double highest_m =
      HighestBelow(*from.elevation, begin, end, from.lander.rotor_diameter_m / 2);
  if (!(highest_m > skids_m - kLeastBelowSkids_m)) {
    return {};
  }
  return std::isfinite(highest_m)
             ? WithNumbers("What stands on the way leaves %.1f m below the skids, min %.1f m",
                           skids_m - highest_m, kLeastBelowSkids_m)
             : std::string("A wire of unknown height hangs over the way");
}

}  // namespace

std::string PlaceDoubt(const NavigationStatus& navigation) {
  return navigation.gps_agreement.off ? words::GpsOff(navigation.gps_agreement) : std::string();
}

std::string WhyNotThatWay(const WayFacts& from, const FlyTo& there) {
  if (!there.p_WB.allFinite() || !std::isfinite(there.heading_rad)) {
    return "The place is not a number";
  }
  const Eigen::Vector3d way = there.p_WB - from.p_WB;
  const double far_m = way.head<2>().norm(), up_m = -way.z();
  if (far_m > kFarthestGo_m) {
    return WithNumbers("%.0f m away, limit %.0f m", far_m, kFarthestGo_m);
  }
  if (up_m > kMostClimb_m) {
    return WithNumbers("%.0f m up, limit %.0f m", up_m, kMostClimb_m);
  }
  if (up_m < -kLower_m) {
    return WithNumbers("%.1f m lower: a way down is flown to a site", -up_m);
  }
  if (far_m > kOnTheSpot_m && !from.place_doubt.empty()) {
    return from.place_doubt;
  }
  if (std::string why = WhyLeavesArea(from, there.p_WB); !why.empty()) {
    return why;
  }
  if (std::string why = WhatStandsThere(from, there.p_WB); !why.empty()) {
    return why;
  }
  const double turn_rad = WrapAngle(there.heading_rad - from.yaw_rad);
  return way.norm() < kNoWay_m && std::abs(turn_rad) < kNoTurn_rad ? "It hovers there already" : "";
}

double UnseenOfWay(const ElevationMap* map, const Eigen::Vector3d& from_W,
                   const Eigen::Vector3d& to_W) {
  return map != nullptr ? UnseenBelow(*map, from_W.head<2>(), to_W.head<2>())
                        : (to_W - from_W).head<2>().norm();
}

double UnseenOnWay(const EngineSnapshot& snapshot, const FlyTo& there) {
  const Eigen::Vector3d& p_WB = snapshot.flight->navigation.InForce().estimate.p_WB;
  const auto& decision = snapshot.terrain->applied;
  if (!p_WB.allFinite()) {
    return 0;
  }
  return UnseenOfWay(decision ? decision->elevation.get() : nullptr, p_WB, there.p_WB);
}

std::string WhyNotFlown(const EngineSnapshot& snapshot, const FlyTo& there) {
  const MissionStatus& mission = snapshot.flight->mission;
  if (!mission.why_not_go.empty()) {
    return mission.why_not_go;
  }
  // A mission that gives no reason of its own has a filter that runs: its estimate is the place.
  const Eigen::Vector3d& p_WB = snapshot.flight->navigation.InForce().estimate.p_WB;
  const auto& pose = snapshot.sensors->pose;
  if (!pose || !p_WB.allFinite()) {
    return "Where the vehicle is, is not known";
  }
  const auto& decision = snapshot.terrain->applied;
  return WhyNotThatWay(
      {p_WB, EulerFromRotation(pose->X_WB.R).yaw_rad,
       decision ? decision->elevation.get() : nullptr, mission.area ? &*mission.area : nullptr,
       snapshot.session->settings.slad.lander, PlaceDoubt(snapshot.flight->navigation)},
      there);
}

}  // namespace palace
