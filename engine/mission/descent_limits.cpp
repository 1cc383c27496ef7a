#include "engine/mission/descent_limits.h"

#include <utility>

#include "engine/core/text.h"
#include "engine/mission/alarms/alarms.h"
#include "engine/mission/geometry.h"
#include "engine/mission/limits.h"
#include "engine/model/wind.h"

namespace palace {
namespace {

/// The vehicle is to be above the site, or is on it.
bool IsOverSite(const DescentFigures& f) {
  return f.mode == VehicleMode::kSink || f.mode == VehicleMode::kLanded ||
         f.state == MissionState::kLanded;
}

LimitRow PlaceRow(const DescentFigures& f, EnforcedBy alarm_in_descent) {
  if (!IsOverSite(f)) {
    return {.id = LimitId::kOffPath,
            .label = "Off the path",
            .value = f.off_path_m,
            .three_sigma = f.horizontal_3s_m,
            .limit = DescentLimits::off_path_m,
            .unit = "m",
            .decimals = 2,
            .enforced_by = alarm_in_descent};
  }
  return {.id = LimitId::kFromCentre,
          .label = "From centre",
          .value = f.from_centre_m,
          .three_sigma = f.horizontal_3s_m,
          .limit = f.nav_error_m,
          .unit = "m",
          .decimals = 2,
          .enforced_by = alarm_in_descent};
}

DescentFigures FiguresOf(const MissionMemory& m, const std::optional<FlightPath>& path,
                         Timestamp now) {
  const NavigationStatus& navigation = m.facts.navigation;
  const PositionEstimate& estimate = navigation.InForce().estimate;
  const auto& vehicle = m.watch.vehicle();
  DescentFigures f;
  f.state = m.status.state;
  f.mode = vehicle ? vehicle->mode : VehicleMode::kUnknown;
  f.off_path_m = m.status.path.off_path_m;
  // On the ground as it was measured at touchdown: the estimate drifts on and means nothing more.
  const bool landed = m.status.state == MissionState::kLanded;
  f.from_centre_m = landed ? m.status.touchdown_miss_m.value_or(NAN) : m.status.distance_to_site_m;
  f.horizontal_3s_m = landed ? NAN : 3 * estimate.sigma_p_m.head<2>().norm();
  f.descent_rate_mps = m.facts.v_WB.z();
  f.descent_rate_3s_mps = 3 * estimate.sigma_v_mps.z();
  f.approved_rate_mps = m.status.approach ? m.status.approach->descent_rate_mps
                                          : m.facts.settings.mission.descent_rate_mps;
  f.nav_error_m = m.facts.settings.slad.lander.nav_error_m;
  f.tracked = m.facts.tracker_locked;
  f.coherence = m.facts.coherence;
  f.min_coherence = m.facts.settings.tracking.min_coherence;
  f.residual_sigma = navigation.vision.residual_sigma;
  f.max_residual_sigma = navigation.vision.max_residual_sigma;
  f.wind_mps = KnownWind(m, now);
  f.max_wind_mps = m.facts.settings.mission.max_wind_mps;
  if (path && WindHasDirection(f.wind_mps)) {
    f.off_wind_rad = std::abs(WrapAngle(path->heading_rad - vehicle->wind_from_rad));
  }
  return f;
}

/// A figure of the site as its newest map shows it: who acts on it now.
void Enforce(const MissionMemory& m, LimitRow& row) {
  const bool descends = m.status.state == MissionState::kDescending;
  if (row.enforced_by == EnforcedBy::kNobody) {
    return;
  }
  // Landed on it, or flies away from it, or so low that the last verdict stands. Air that was shown
  // once is asked for no more: on the way down it comes too near to be looked at.
  const bool air_shown = row.id == LimitId::kAirSeen && m.armed.air_shown;
  if (!WatchesSite(m) || (descends && IsCommitted(m)) || air_shown) {
    row.enforced_by = EnforcedBy::kNobody;
    row.over = false;
  } else if (IsFlying(m.status.state)) {
    row.enforced_by = EnforcedBy::kHold;
    row.lasts = WithNumbers("%.1f s, or ", SiteWatch::kLostAfter_s) +
                WithNumbers("%.0f of %.0f maps", SiteWatch::kLostMaps, SiteWatch::kMapsKept);
  }
}

/// On the ground the descent is over and what is measured of it drifts on: its figures stay as the
/// last turn in the air told them, but for where it stands. Nobody enforces them any more.
void KeepAsFlown(const std::vector<LimitRow>& before, std::vector<LimitRow>& rows) {
  for (LimitRow& row : rows) {
    const LimitRow* flown = row.id == LimitId::kFromCentre ? nullptr : FindLimit(before, row.id);
    row = flown != nullptr ? *flown : row;
    row.enforced_by = EnforcedBy::kNobody;
    row.over = false;
  }
}

}  // namespace

LimitRow WindLimit(double wind_mps, double max_wind_mps, EnforcedBy by) {
  return Judged({.id = LimitId::kWind,
                 .label = "Wind",
                 .value = wind_mps,
                 .limit = max_wind_mps,
                 .unit = "m/s",
                 .enforced_by = std::isfinite(wind_mps) ? by : EnforcedBy::kNobody});
}

std::vector<LimitRow> LimitsOfDescent(const DescentFigures& f) {
  const bool descending = f.state == MissionState::kDescending;
  const bool watched = IsFlying(f.state) || f.state == MissionState::kHold;
  const EnforcedBy in_descent = descending ? EnforcedBy::kAlarm : EnforcedBy::kNobody;
  // Waved off and on the ground no site is approved and none is watched.
  const EnforcedBy before_and_in = f.state <= MissionState::kArmed ? EnforcedBy::kGuard
                                   : watched                       ? EnforcedBy::kAlarm
                                                                   : EnforcedBy::kNobody;
  // A wave-off ends no wind: the next approval meets it.
  const EnforcedBy wind = f.state == MissionState::kAborting ? EnforcedBy::kAlarm : before_and_in;
  return {Judged(PlaceRow(f, in_descent)),
          Judged({.id = LimitId::kDescentRate,
                  .label = "Descent rate",
                  .value = f.descent_rate_mps,
                  .three_sigma = f.descent_rate_3s_mps,
                  .limit = DescentLimits::rate_share * f.approved_rate_mps,
                  .unit = "m/s",
                  .decimals = 2,
                  .enforced_by = in_descent}),
          Judged({.id = LimitId::kCoherence,
                  .label = "Coherence",
                  .value = f.tracked ? f.coherence : NAN,
                  .limit = f.min_coherence,
                  .is_least = true,
                  .decimals = 2,
                  .enforced_by = before_and_in}),
          Judged({.id = LimitId::kResidual,
                  .label = "Residual",
                  .value = f.tracked ? f.residual_sigma : NAN,
                  .limit = f.max_residual_sigma,
                  .unit = "σ",
                  .decimals = 2,
                  .enforced_by = f.tracked ? EnforcedBy::kAlarm : EnforcedBy::kNobody}),
          WindLimit(f.wind_mps, f.max_wind_mps, wind),
          Judged({.id = LimitId::kOffWind,
                  .label = "Approach off wind",
                  .value = f.off_wind_rad,
                  .limit = DescentLimits::off_wind_rad,
                  .unit = "°",
                  .shown_per_unit = kDegPerRad,
                  .decimals = 0})};
}

std::vector<LimitRow> LimitsOfCameras(const StereoQuality& stereo, const RangeAgreement& range,
                                      const PictureFaults& standing, MissionState state) {
  LimitRow scale{.id = LimitId::kRangeScale,
                 .label = "Range against the laser",
                 .value = std::abs(range.ratio - 1),
                 .three_sigma = 3 * range.sigma,
                 .limit = AlarmLimits::scale_percent / 100,
                 .unit = "%",
                 .shown_per_unit = 100,
                 .enforced_by = EnforcedBy::kAlarm};
  scale = Judged(scale);
  scale.over = scale.over && scale.value > scale.three_sigma;  // and not by chance
  // A single pair may look wrong by chance: beyond the limit once it stands, as guard and alarm
  // see.
  LimitRow rows = Judged(
      {.id = LimitId::kRowError,
       .label = "Row error",
       .value = stereo.row_error_px,
       .limit = AlarmLimits::row_error_px,
       .unit = "px",
       .decimals = 2,
       .enforced_by = state <= MissionState::kArmed ? EnforcedBy::kGuard : EnforcedBy::kAlarm});
  rows.over = rows.over && standing.rows_apart;
  return {rows,
          Judged({.id = LimitId::kExposure,
                  .label = "Brighter over darker picture",
                  .value = std::exp(std::abs(std::log(stereo.exposure_ratio))),
                  .limit = AlarmLimits::exposure,
                  .decimals = 2,
                  .enforced_by = EnforcedBy::kAlarm}),
          scale};
}

double KnownWind(const MissionMemory& m, Timestamp now) {
  const bool fresh = m.watch.LinkAge(now) <= GuardLimits::link_s;
  return fresh && m.watch.vehicle() ? m.watch.vehicle()->wind_speed_mps : NAN;
}

void PublishLimits(MissionMemory& m, const std::optional<FlightPath>& path, Timestamp now) {
  std::vector<LimitRow> limits = LimitsOfDescent(FiguresOf(m, path, now));
  const auto add = [&](const std::vector<LimitRow>& rows) {
    limits.insert(limits.end(), rows.begin(), rows.end());
  };
  if (m.status.armed && (m.newest || !m.site.evaluated())) {
    std::vector<LimitRow> site =
        SiteLimits(m.newest ? *m.newest : *m.status.armed, m.facts.settings.slad);
    for (LimitRow& row : site) {
      Enforce(m, row);
    }
    add(site);
  }
  add(LimitsOfHolds(HoldFactsAt(m, now)));
  if (m.status.state == MissionState::kLanded) {
    KeepAsFlown(m.status.limits, limits);
  }
  add(LimitsOfCameras(m.facts.stereo, m.facts.range_agreement, m.pictures.standing(),
                      m.status.state));
  m.status.limits = std::move(limits);
}

}  // namespace palace
