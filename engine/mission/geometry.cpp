#include "engine/mission/geometry.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "engine/core/sun_position.h"
#include "engine/core/units.h"
#include "engine/flight/approach_heading.h"
#include "engine/mission/descent_limits.h"
#include "engine/model/find_site.h"
#include "engine/model/wind.h"
#include "engine/search/ground_looks.h"

namespace palace {
namespace {

// Nearer to where a turned approach begins, and turned so far, the site is in the middle half of
// the picture.
constexpr double kRound_m = 2;
const double kRound_rad = Rad(10);

/// The leg that the vehicle says it flies; empty where its word names none.
std::optional<LegFlown> LegOf(const MissionMemory& m) {
  const double for_s = SecondsBetween(m.flown_since, m.facts.now);
  switch (m.flown_mode) {
    case VehicleMode::kDescend:
      return LegFlown{PathLeg::kSlope, for_s};
    case VehicleMode::kSettle:
      return LegFlown{PathLeg::kLevel, for_s};
    case VehicleMode::kSink:
      return LegFlown{PathLeg::kSink, for_s};
    default:
      return std::nullopt;
  }
}

double TimeLeft(const MissionMemory& m, const FlightPath& path) {
  const MissionFacts& facts = m.facts;
  switch (m.status.state) {
    case MissionState::kLanded:
      return 0;
    case MissionState::kAborting:
    case MissionState::kHold:
      return NAN;
    case MissionState::kDescending:
      return TimeToTouchdown(path, facts.p_WB, facts.v_WB, LegOf(m));
    default:
      return TimeToAlign(path, facts.p_WB, facts.yaw_rad) +
             TimeToTouchdown(path, path.Start(facts.p_WB), Eigen::Vector3d::Zero());
  }
}

ApproachPlan PlanOn(const MissionMemory& m, const ApproachCourse& course) {
  return {course.heading_rad,
          Rad(m.facts.settings.mission.glide_slope_deg),
          m.facts.settings.mission.descent_rate_mps,
          course.side,
          {}};
}

/// Of the courses to that site, by wind, sun and what is clear.
HeadingCurve CurveFor(const MissionMemory& m, const LandingSite& site) {
  const MissionSettings& settings = m.facts.settings.mission;
  HeadingConditions conditions;
  const double straight_rad = StraightHeading(m.facts.skid_centre_W, site.p_WS);
  conditions.wanted_rad = straight_rad;
  conditions.depression_rad = Rad(settings.glide_slope_deg);
  conditions.max_tailwind_mps = settings.max_tailwind_mps;
  conditions.blocked = BlockedHeadings(OverSeenGround(m, site), straight_rad);
  const double wind_mps = KnownWind(m, m.facts.now);
  if (WindHasDirection(wind_mps)) {
    conditions.wind_mps = wind_mps;
    conditions.wind_from_rad = m.watch.vehicle()->wind_from_rad;
  }
  if (settings.sun == SunSource::kByPlace) {
    const SunDirection sun =
        SunAt(m.facts.now, Rad(settings.latitude_deg), Rad(settings.longitude_deg));
    conditions.sun_azimuth_rad = sun.azimuth_rad;
    conditions.sun_elevation_rad = sun.elevation_rad;
  }
  return ScoreHeadings(conditions);
}

ApproachPlan PlanFor(const MissionMemory& m, const LandingSite& site) {
  const double straight_rad = StraightHeading(m.facts.skid_centre_W, site.p_WS);
  const HeadingCurve curve = CurveFor(m, site);
  const ApproachCourse course = ChooseCourse(OverSeenGround(m, site), straight_rad, curve);
  ApproachPlan plan = PlanOn(m, course);
  if (plan.turned() && site.corridor_clear) {
    const HeadingScore& straight = curve.At(straight_rad);
    const HeadingScore& chosen = curve.At(course.heading_rad);
    plan.why = chosen.wind - straight.wind >= chosen.sun - straight.sun ? "into the wind"
                                                                        : "out of the sun";
  }
  return plan;
}

/// From now on the corridor is that of the plan; the maps to come judge it again.
void TakePlan(MissionMemory& m, const ApproachPlan& plan) {
  m.status.approach = plan;
  m.status.armed->corridor_clear = m.armed.straight_clear || plan.turned();
  m.status.armed_limits = SiteLimits(*m.status.armed, m.facts.site_limits);
}

/// Turning towards the start of the path is no deviation from it.
bool FliesPath(const MissionMemory& m) {
  const auto& vehicle = m.watch.vehicle();
  const VehicleMode mode = vehicle ? vehicle->mode : VehicleMode::kUnknown;
  return m.status.state == MissionState::kDescending && m.status.approval &&
         (mode == VehicleMode::kDescend || mode == VehicleMode::kSettle ||
          mode == VehicleMode::kSink);
}

/// What is to be flown from here.
std::vector<Eigen::Vector3d> WayAhead(const MissionMemory& m, const FlightPath& path) {
  const bool flies = m.status.state == MissionState::kArmed || IsFlying(m.status.state);
  if (!flies || !m.status.approach || !m.facts.p_WB.allFinite()) {
    return {};
  }
  const auto leg = LegOf(m);
  const bool past_slope = FliesPath(m) && leg && leg->leg != PathLeg::kSlope;
  if (past_slope) {
    return {m.facts.p_WB, path.p_WS};
  }
  return {m.facts.p_WB, path.Start(m.facts.p_WB),
          path.IsLook() ? path.BodyAt(path.speeds.slope_end_m) : path.p_WS};
}

}  // namespace

double HeightAboveSite(const MissionMemory& m) {
  // Down is positive in W: the skid is above the site when its z is smaller.
  return m.status.armed ? m.status.armed->p_WS.z() - m.facts.skid_centre_W.z() : NAN;
}

bool IsCommitted(const MissionMemory& m) {
  return !m.status.IsLook() && HeightAboveSite(m) < m.facts.settings.slad.fusion.commit_height_m;
}

LandingSite OverSeenGround(const MissionMemory& m, LandingSite site) {
  const double height_m = site.p_WS.z() - m.facts.skid_centre_W.z();
  if (!m.status.seen || !std::isfinite(height_m)) {
    return site;
  }
  const Lander& lander = m.facts.settings.slad.lander;
  const Eigen::Vector2d p_WS = site.p_WS.head<2>();
  // The tail still hangs over what lies behind where the slope begins.
  const double length_m =
      height_m / std::tan(Rad(m.facts.settings.mission.glide_slope_deg)) + lander.radius_m();
  for (int sector = 0; sector < kApproachSectors; ++sector) {
    const double bearing_rad = HeadingFromSector(sector) + std::numbers::pi;
    const Eigen::Vector2d from(std::cos(bearing_rad), std::sin(bearing_rad));
    const unsigned side = 1U << sector;
    if ((site.clear_approaches & side) != 0 &&
        !IsLookedAt(*m.status.seen, p_WS + site.clear_radius_m * from, p_WS + length_m * from,
                    lander.rotor_diameter_m / 2)) {
      site.clear_approaches = static_cast<std::uint8_t>(site.clear_approaches & ~side);
    }
  }
  return site;
}

void PlanApproach(MissionMemory& m) {
  if (m.status.armed && !m.status.approach && m.facts.skid_centre_W.allFinite()) {
    m.armed.straight_clear = m.status.armed->corridor_clear;
    m.armed.course_judged = true;  // by the map that it was selected on
    TakePlan(m, PlanFor(m, *m.status.armed));
  }
}

std::vector<ApproachCourse> CoursesOpen(const MissionMemory& m) {
  if (m.status.state != MissionState::kArmed || !m.status.approach ||
      !m.facts.skid_centre_W.allFinite()) {
    return {};
  }
  const LandingSite& newest = m.newest ? *m.newest : *m.status.armed;
  return ClearCourses(OverSeenGround(m, newest),
                      StraightHeading(m.facts.skid_centre_W, m.status.armed->p_WS),
                      m.armed.straight_clear);
}

void PublishHeadings(MissionMemory& m) {
  m.status.headings.reset();
  if (m.status.state == MissionState::kArmed && m.facts.skid_centre_W.allFinite()) {
    m.status.headings = CurveFor(m, m.newest ? *m.newest : *m.status.armed);
  }
}

void TurnTo(MissionMemory& m, const ApproachCourse& course) {
  TakePlan(m, PlanOn(m, course));
  m.armed.map_hash = m.facts.map_hash;
  m.armed.course_judged = false;
}

bool GoesRound(const MissionMemory& m) {
  if (m.status.state != MissionState::kApproved || !m.status.approach ||
      !m.status.approach->turned()) {
    return false;
  }
  const FlightPath path = PathTo(m, *m.status.armed);
  const double way_m = (path.Start(m.facts.p_WB) - m.facts.p_WB).norm();
  const double turn_rad = std::abs(WrapAngle(path.heading_rad - m.facts.yaw_rad));
  return !(way_m <= kRound_m && turn_rad <= kRound_rad);
}

FlightPath PathTo(const MissionMemory& m, const LandingSite& site) {
  const PathVehicle vehicle{m.facts.p_BC, m.facts.settings.slad.lander.skid_centre_B(),
                            m.facts.settings.mission.settle_s};
  if (m.status.approval) {
    return PathOf(*m.status.approval, vehicle);
  }
  return PathOf(m.status.approach ? *m.status.approach : PlanFor(m, site), site.p_WS, vehicle);
}

const LandingSite* SiteInQuestion(const MissionMemory& m) {
  const LandingSite* site =
      m.status.armed ? &*m.status.armed : FindSite(m.facts.sites, m.winner.site_id);
  return site != nullptr ? site : m.status.BestStanding(m.facts.sites);
}

std::optional<FlightPath> PublishGeometry(MissionMemory& m) {
  const LandingSite* site = SiteInQuestion(m);
  const Eigen::Vector3d& skid_W = m.facts.skid_centre_W;
  m.status.height_above_site_m = m.status.distance_to_site_m = m.status.time_to_touchdown_s = NAN;
  m.status.site_p_WS = Eigen::Vector3d::Constant(NAN);
  m.status.path = {};
  m.status.way_W.clear();
  const bool planned = m.status.approach || m.status.approval;
  if (site == nullptr || (!planned && !skid_W.allFinite())) {
    return std::nullopt;
  }
  const FlightPath path = PathTo(m, *site);
  if (!skid_W.allFinite()) {
    return path;
  }
  m.status.site_p_WS = site->p_WS;
  m.status.height_above_site_m = site->p_WS.z() - skid_W.z();
  m.status.distance_to_site_m = (site->p_WS - skid_W).head<2>().norm();
  m.status.time_to_touchdown_s = TimeLeft(m, path);
  m.status.way_W = WayAhead(m, path);
  if (FliesPath(m) && m.facts.p_WB.allFinite() && m.facts.v_WB.allFinite()) {
    m.status.path = ProgressOn(path, m.facts.p_WB, m.facts.v_WB, LegOf(m));
  }
  return path;
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
  return std::abs(HeightFromDown(p_WL.z()) - map.Measured().at(*cell));
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
  const Eigen::Vector3d skid_W = truth.back().X_WB * m.facts.settings.slad.lander.skid_centre_B();
  return (skid_W - m.status.armed->p_WS).head<2>().norm();
}

}  // namespace palace
