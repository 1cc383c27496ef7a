// A full, plausible EngineSnapshot for panel tests, in any mission state. Nothing in it is NaN that
// a flight would know; all values are fixed, so golden texts stay.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/model/snapshot.h"
#include "tests/support/fake_terrain.h"

namespace palace::fake {

inline constexpr std::int64_t kNow_us = 1'700'000'000'000'000;

inline PinholeCamera Camera() { return {640, 480, 1222, 1222, 319.5, 239.5}; }

inline LandingSite Site(std::uint64_t id, char letter, double north_m, double east_m,
                        double safe_distance_m, const char* reason) {
  LandingSite site;
  site.id = id;
  site.letter = letter;
  site.map_time = {kNow_us - 100'000};
  site.p_WS = {north_m, east_m, -Height(north_m, east_m)};
  site.cell = *Geometry().CellFromPoint(north_m, east_m);
  site.slope_rad = {Rad(2.1 - 0.2 * static_cast<double>(id)), Rad(0.3)};
  site.roughness_m = {0.055 - 0.005 * static_cast<double>(id), 0.018};
  site.step_m = {0.074, 0.018};
  site.height_m = {Height(north_m, east_m), 0.018};
  site.safe_distance_m = safe_distance_m;
  site.clear_radius_m = 2.3;
  site.clearance_m = safe_distance_m - 2.3;
  site.cost = 0.68;
  site.safe_probability = 0.998;
  site.touchdown = {0.998, Rad(40), 1.0, Rad(130)};
  site.frames_fused = 10;
  site.confirmed = letter != 'D';
  site.distance_m = std::hypot(north_m, east_m);
  site.reason = reason;
  return site;
}

inline std::shared_ptr<const TerrainDecision> Decision(const RigidTransform& X_WC,
                                                       const SladSettings& settings,
                                                       std::uint64_t hash) {
  auto decision = std::make_shared<TerrainDecision>();
  decision->map_time = {kNow_us - 100'000};
  decision->elevation = Elevation(decision->map_time);
  decision->hazards = Hazards(*decision->elevation, Rad(settings.limits.max_slope_deg),
                              settings.limits.max_deviation_m);
  decision->settings = settings;
  decision->settings_hash = hash;
  decision->map_hash = 0x51aa00 + hash;
  decision->verdict = Verdict(*decision->hazards, Camera(), X_WC);
  decision->selection.sites = {
      Site(1, 'A', 3.0, 5.1, 4.8, "Widest: 0.6 m more clear than B"),
      Site(2, 'B', 3.8, -5.7, 4.2, "0.6 m less clear than A; half in shadow"),
      Site(3, 'C', 2.2, 1.5, 3.0, "1.8 m less clear than A; kerb 3.0 m north"),
      Site(4, 'D', -0.2, 7.0, 2.8, "1.9 m less clear than A; height noise 8.4 cm")};
  return decision;
}

inline std::vector<ChannelHealth> Channels() {
  using State = ChannelHealth::State;
  const auto one = [](ChannelId id, double age_s, double rate_hz) {
    return ChannelHealth{id, State::kFresh, age_s, rate_hz, rate_hz, 2520, 0, ""};
  };
  std::vector<ChannelHealth> channels = {one(ChannelId::kCameraLeft, 0.024, 10),
                                         one(ChannelId::kCameraRight, 0.026, 10),
                                         one(ChannelId::kVehiclePose, 0.011, 50),
                                         one(ChannelId::kImu, 0.004, 200),
                                         one(ChannelId::kGps, 0.1, 5),
                                         one(ChannelId::kLaserRange, 0.038, 20),
                                         one(ChannelId::kVehicleStatus, 0.4, 1),
                                         one(ChannelId::kPositionEstimate, 0.026, 10)};
  channels[4].state = State::kLate;
  channels[4].note = "± 2.6 m";
  return channels;
}

inline std::vector<GuardResult> Guards() {
  const char* names[] = {"Site armed",          "Both cameras fresh", "Map fresh",
                         "Pose fresh",          "Site confirmed",     "Settings unchanged",
                         "Vehicle in hover",    "Link in both ways",  "Estimate healthy",
                         "No warning standing", "Wind inside limit"};
  std::vector<GuardResult> guards;
  for (int i = 0; i < 11; ++i) {
    guards.push_back({static_cast<GuardId>(i), names[i], true, ""});
  }
  return guards;
}

inline std::vector<HistorySample> History(bool descending) {
  std::vector<HistorySample> history;
  for (int i = -400; i <= 0; ++i) {
    HistorySample h;
    const double t = 0.1 * i;
    h.time = {kNow_us + i * 100'000};
    h.state = descending ? MissionState::kDescending : MissionState::kArmed;
    const double fall = descending ? std::max(0.0, t + 28) * 0.6 : 0.0;
    const double wave = SmoothNoise(i * 0.2, 3);
    h.p_WS = Eigen::Vector3d::Zero();
    h.height_above_site_m = 38.2 - fall + 0.05 * wave;
    h.gps_height_m = h.height_above_site_m + 0.6;
    h.truth_height_m = h.height_above_site_m;
    h.plan_height_m = 38.2 - fall;
    h.laser_m = h.height_above_site_m + 0.04 * wave;
    h.laser_time = h.time;
    h.from_site_m = 0.08 + 0.1 * wave;
    h.from_site_gps_m = 1.3 + SmoothNoise(i * 0.1, 9);
    h.from_site_truth_m = 0.1;
    h.descent_rate_mps = fall > 0 ? 0.58 + 0.05 * wave : 0.02 * wave;
    h.coherence = 0.9 + 0.06 * wave - (i > -160 && i < -130 ? 0.2 : 0.0);
    h.residual_sigma = std::abs(3.0 * (SmoothNoise(i * 0.5, 5) - 0.5));
    h.glide_deviation_m = 0.1 + 0.2 * std::abs(wave);
    h.estimate_p_WB = {0.0, 0.0, -h.height_above_site_m};
    h.estimate_v_WB = {0, 0, h.descent_rate_mps};
    h.estimate_sigma_m = {0.03, 0.03, 0.05};
    h.descent_rate_sigma_mps = 0.02;
    h.gps_p_WB = {1.1, 1.3, -h.height_above_site_m - 1.5};
    h.truth_p_WB = h.estimate_p_WB;
    h.best_site = 'A';
    h.best_safe_distance_m = 4.8;
    history.push_back(h);
  }
  return history;
}

/// What the mission would say of the flight: nothing is over its limit.
inline std::vector<LimitRow> Limits(const EngineSnapshot& snap) {
  const MissionState state = snap.flight->mission.state;
  const EnforcedBy by =
      state == MissionState::kDescending ? EnforcedBy::kAlarm : EnforcedBy::kNobody;
  const bool over = state == MissionState::kAborting || state == MissionState::kLanded;
  const EnforcedBy before_and_in = over                            ? EnforcedBy::kNobody
                                   : state <= MissionState::kArmed ? EnforcedBy::kGuard
                                                                   : EnforcedBy::kAlarm;
  std::vector<LimitRow> rows = {{.id = LimitId::kOffPath,
                                 .label = "Off the path",
                                 .value = 0.14,
                                 .three_sigma = 0.13,
                                 .limit = 1.2,
                                 .unit = "m",
                                 .decimals = 2,
                                 .enforced_by = by},
                                {.id = LimitId::kDescentRate,
                                 .label = "Descent rate",
                                 .value = 0.58,
                                 .three_sigma = 0.02,
                                 .limit = 1.5,
                                 .unit = "m/s",
                                 .decimals = 2,
                                 .enforced_by = by},
                                {.id = LimitId::kCoherence,
                                 .label = "Coherence",
                                 .value = 0.94,
                                 .limit = 0.7,
                                 .is_least = true,
                                 .decimals = 2,
                                 .enforced_by = before_and_in},
                                {.id = LimitId::kResidual,
                                 .label = "Residual",
                                 .value = 0.4,
                                 .limit = 2.15,
                                 .unit = "σ",
                                 .enforced_by = over ? EnforcedBy::kNobody : EnforcedBy::kAlarm},
                                {.id = LimitId::kWind,
                                 .label = "Wind",
                                 .value = 2.1,
                                 .limit = 8,
                                 .unit = "m/s",
                                 .enforced_by = before_and_in},
                                {.id = LimitId::kOffWind,
                                 .label = "Approach off wind",
                                 .value = Rad(60),
                                 .limit = Rad(60),
                                 .unit = "°",
                                 .shown_per_unit = kDegPerRad,
                                 .decimals = 0},
                                {.id = LimitId::kRowError,
                                 .label = "Row error",
                                 .value = 0.22,
                                 .limit = 0.5,
                                 .unit = "px",
                                 .decimals = 2,
                                 .enforced_by = EnforcedBy::kGuard},
                                {.id = LimitId::kExposure,
                                 .label = "Brighter over darker picture",
                                 .value = 1,
                                 .limit = 2,
                                 .decimals = 2,
                                 .enforced_by = EnforcedBy::kAlarm},
                                {.id = LimitId::kRangeScale,
                                 .label = "Range against the laser",
                                 .value = 0.004,
                                 .limit = 0.02,
                                 .unit = "%",
                                 .shown_per_unit = 100,
                                 .enforced_by = EnforcedBy::kAlarm}};
  if (snap.flight->mission.armed) {
    for (LimitRow row : SiteLimits(*snap.flight->mission.armed, snap.session->settings.slad)) {
      row.enforced_by = over ? EnforcedBy::kNobody : row.enforced_by;
      rows.push_back(Judged(row));
    }
  }
  return rows;
}

inline std::vector<Event> Events() {
  return {{{kNow_us - 42'000'000}, EventKind::kState, "Search"},
          {{kNow_us - 21'000'000}, EventKind::kSite, "Site A found, 4.8 m clear"},
          {{kNow_us - 20'000'000}, EventKind::kState, "Proposed"},
          {{kNow_us - 3'200'000}, EventKind::kDecision, "Operator armed site A"},
          {{kNow_us - 900'000}, EventKind::kAlarm, "GPS horizontal error 2.6 m, limit 2.0 m"}};
}

inline void FillMission(EngineSnapshot& snap, MissionState state) {
  MissionStatus& m = snap.flight.Edit().mission;
  const bool armed = state >= MissionState::kArmed;
  const bool descending = state == MissionState::kDescending || state == MissionState::kHold ||
                          state == MissionState::kAborting || state == MissionState::kLanded;
  m.state = state;
  m.may_select = MaySelect(snap.session->role);
  m.since = {kNow_us - 3'200'000};
  m.guards = Guards();
  if (armed) {
    m.armed = snap.terrain->applied->selection.sites.front();
    m.armed_limits = SiteLimits(*m.armed, snap.session->settings.slad);
    m.armed_at = {kNow_us - 3'200'000};
    m.approach = ApproachPlan{Rad(40), Rad(45), 1.0};
    m.arm_expires = Timestamp{kNow_us + 26'000'000};
    m.can_approve = state == MissionState::kArmed;
  } else {
    m.cannot_approve_reason = "Select a site first";
  }
  if (state >= MissionState::kApproved) {
    Approval approval;
    approval.id = 7;
    approval.site_id = 1;
    approval.approved_at = {kNow_us - 55'000'000};
    approval.expires_at = {kNow_us - 25'000'000};
    m.approval = approval;
    m.approved_by = "the operator";
    m.approval_phase = MissionStatus::ApprovalPhase::kAccepted;
    m.approval_answer_s = 0.3;
  }
  m.height_above_site_m = descending ? 21.4 : 38.2;
  m.distance_to_site_m = descending ? 0.12 : 5.9;
  m.time_to_touchdown_s = descending ? 41 : 72;
  m.confirm_height_m = 6;
  if (state == MissionState::kDescending) {
    for (int i = 0; i <= 82; ++i) {
      m.path.ahead.push_back({0.5 * i, 21.4 * (1 - i / 82.0)});
    }
  }
  if (descending) {
    m.rechecks = {{{kNow_us - 28'000'000}, 38, 4.8, true, ""},
                  {{kNow_us - 19'000'000}, 33, 4.6, true, ""},
                  {{kNow_us - 9'000'000}, 28, 4.3, true, ""},
                  {{kNow_us - 800'000}, 24, 4.1, true, ""}};
    m.rechecks.back().alternative = snap.terrain->applied->selection.sites[1];
    m.alarms = {{AlarmId::kSiteDegraded,
                 AlarmLevel::kAdvisory,
                 "Site A confirmed again at 24 m. Clear radius 4.1 m.",
                 {kNow_us - 800'000}}};
  } else {
    m.alarms = {
        {AlarmId::kGpsError,
         AlarmLevel::kCaution,
         "GPS horizontal error 2.6 m, limit 2.0 m. Landing on vision, not GPS.",
         {kNow_us - 900'000}},
        {AlarmId::kExposure, AlarmLevel::kAdvisory, "Site B lies half in shadow.", {kNow_us}},
        {AlarmId::kHeightMismatch, AlarmLevel::kAdvisory, "Wind from 240\u00b0.", {kNow_us}}};
  }
}

inline void FillTracker(TrackerStatus& t) {
  t.time = {kNow_us};
  t.locked = true;
  t.mode = "Plane";
  t.coherence = 0.94;
  t.site_pixel = {482, 143};
  t.site_in_picture = true;
  t.window_centre = t.site_pixel;
  t.window_side_px = 140;
  t.features = {{{158, 160}, true}, {{128, 320}, true}, {{266, 340}, true}, {{565, 260}, false}};
  t.inliers = 3;
  t.keyframes = 2;
  t.anchor_height_m = 38;
  const auto patch = [](std::uint8_t grey) {
    return std::make_shared<const ImageU8>(64, 64, grey);
  };
  t.anchor_patch = patch(150);
  t.current_patch = patch(148);
  t.difference_patch = patch(128);
}

/// The plane in force, a template that a shadow took, four features of which one drifts.
inline TrackerSetStatus Trackers(const Eigen::Vector2d& site) {
  using Kind = TrackerMember::Kind;
  TrackerSetStatus set;
  set.time = {kNow_us - 24'000};
  const auto add = [&](Kind kind, const char* name, Eigen::Vector2d pixel, double coherence,
                       double off_px, double weight) {
    TrackerMember member;
    member.kind = kind;
    member.name = name;
    member.state = FollowState::kFollowed;
    member.pixel = pixel;
    member.site_pixel = site + Eigen::Vector2d(0.8 * off_px, 0.6 * off_px);
    member.coherence = member.own_score = coherence;
    member.disagreement_px = off_px;
    member.weight = weight;
    member.sigma_px = 0.4;
    member.anchors = 1;
    set.members.push_back(member);
  };
  add(Kind::kPlane, "Plane", site, 0.94, 0.3, 0.28);
  add(Kind::kTemplate, "Template", site, 0, NAN, 0);
  add(Kind::kFeature, "Feature 1", {158, 160}, 0.91, 0.6, 0.26);
  add(Kind::kFeature, "Feature 2", {128, 320}, 0.88, 0.4, 0.24);
  add(Kind::kFeature, "Feature 4", {266, 340}, 0.83, 0.9, 0.22);
  add(Kind::kFeature, "Feature 12", {565, 260}, 0.79, 12.4, 0);
  set.members[0].in_force = true;
  TrackerMember& lost = set.members[1];
  lost.state = FollowState::kLost;
  lost.why_lost = "coherence 0.42, limit 0.70";
  lost.lost_s = 1.2;
  lost.pictures_lost = 12;
  lost.sigma_px = 6.5;
  lost.site_pixel = site + Eigen::Vector2d(3, -2);
  lost.window_centre = lost.site_pixel;
  lost.window_side_px = 140;
  set.members[5].drifts = true;
  set.consensus = {true, "", site + Eigen::Vector2d(0.2, 0.1), 0.22, 4, 0.7};
  set.disagreement = "Feature 12 12 px off the others, limit 5 px";
  return set;
}

inline EngineSnapshot Snapshot(MissionState state = MissionState::kArmed,
                               SourceKind kind = SourceKind::kLive) {
  const bool descending = state >= MissionState::kDescending;
  EngineSnapshot snap;
  snap.sequence = 2520;
  snap.time = {kNow_us};
  snap.session.Edit().source = {
      kind,         "udpm://239.255.76.67:7667", false, false, 1, 1, {kNow_us - 252'000'000}, 252,
      std::nullopt, kind == SourceKind::kReplay, 2520,  0};
  if (kind == SourceKind::kReplay) {
    snap.session.Edit().source.name = "2026-05-04_1432.log";
    snap.session.Edit().source.duration_s = 338;
    snap.session.Edit().source.frame_count = 3380;
  }
  snap.session.Edit().role = RoleOf(kind, false);
  const bool frozen = kind != SourceKind::kReplay && state >= MissionState::kArmed;
  snap.session.Edit().limits_apply = !frozen ? LimitsApply::kAtOnce
                                     : state == MissionState::kDescending
                                         ? LimitsApply::kNotNow
                                         : LimitsApply::kWhenApplied;
  snap.session.Edit().apply_drops =
      frozen && (state == MissionState::kArmed || state == MissionState::kApproved);
  snap.session.Edit().can_transmit = kind != SourceKind::kReplay;
  snap.session.Edit().recording = kind != SourceKind::kReplay;
  snap.session.Edit().recording_path = "logs/flight.log";
  snap.session.Edit().record.minutes_left = 212;
  snap.sensors.Edit().channels = Channels();
  StereoRig rig;
  rig.left.pinhole = rig.right.pinhole = Camera();
  rig.tilt_rad = Rad(-90);
  snap.sensors.Edit().rig = std::make_shared<const StereoRig>(rig);
  VehiclePose pose;
  pose.time = {kNow_us - 11'000};
  pose.X_WB.p = {0, 0, descending ? -22.0 : -38.5};
  pose.X_WB.R = RotationFromEuler({0, 0, 0});
  pose.v_WB = {0.1, 0, descending ? 0.6 : 0};
  snap.sensors.Edit().pose = pose;
  snap.sensors.Edit().X_WC = pose.X_WB * rig.X_BC();
  const ImageU8 picture = Picture(Camera(), snap.sensors->X_WC);
  snap.sensors.Edit().left_rectified = std::make_shared<const ImageU8>(picture);
  snap.sensors.Edit().right_rectified = snap.sensors->left_rectified;
  snap.sensors.Edit().frame =
      std::make_shared<const StereoFrame>(StereoFrame{{kNow_us - 24'000}, picture, picture});
  snap.terrain.Edit().stereo_quality.coverage = 0.93;
  snap.terrain.Edit().stereo_quality.row_error_px = 0.22;
  snap.terrain.Edit().stereo_quality.median_sigma_px = 0.12;
  snap.terrain.Edit().stereo_quality.median_depth_m = 38.2;
  snap.terrain.Edit().stereo_quality.row_shift_px = -0.08;
  snap.terrain.Edit().stereo_quality.row_spread_px = 0.31;
  snap.terrain.Edit().range_agreement = {1.004, 0.0011, 40};
  auto range = std::make_shared<RangeMap>();
  range->camera = Camera();
  range->time = {kNow_us - 100'000};
  snap.terrain.Edit().range = range;
  snap.session.Edit().settings_hash = snap.session.Edit().preview_hash = 0x4f2a9c;
  snap.terrain.Edit().applied =
      Decision(snap.sensors->X_WC, snap.session->settings.slad, snap.session->settings_hash);
  FillMission(snap, state);
  FillTracker(snap.flight.Edit().tracker);
  snap.flight.Edit().trackers = Trackers(snap.flight->tracker.site_pixel);
  snap.flight.Edit().navigation.gps.running = snap.flight.Edit().navigation.vision.running = true;
  PositionEstimate& estimate = snap.flight.Edit().navigation.vision.estimate;
  estimate = {{kNow_us - 26'000}, EstimateSource::kVision, true, 7, pose.X_WB.p, pose.v_WB,
              {0.03, 0.03, 0.05}, {0.01, 0.01, 0.007}};
  snap.flight.Edit().navigation.vision.residual_sigma = 0.4;
  snap.flight.Edit().navigation.gps.estimate = estimate;
  snap.flight.Edit().navigation.gps.estimate.source = EstimateSource::kGps;
  snap.flight.Edit().navigation.gps.estimate.sigma_p_m = {0.87, 0.87, 1.4};
  snap.flight.Edit().navigation.handover = NavigationStatus::Handover::kVision;
  VehicleStatus vehicle;
  vehicle.time = {kNow_us - 400'000};
  vehicle.boot_id = 7;
  vehicle.mode = descending ? VehicleMode::kDescend : VehicleMode::kHover;
  vehicle.flies_on_vision = descending;
  vehicle.wind_speed_mps = 2.1;
  vehicle.wind_from_rad = Rad(240);
  vehicle.battery_or_fuel = 0.74;
  vehicle.simulated = kind == SourceKind::kSimulation;
  snap.sensors.Edit().vehicle = vehicle;
  snap.sensors.Edit().laser = LaserRange{{kNow_us - 38'000}, descending ? 21.7 : 38.2};
  snap.flight.Edit().mission.limits = Limits(snap);
  snap.session.Edit().events = std::make_shared<const std::vector<Event>>(Events());
  snap.flight.Edit().history =
      std::make_shared<const std::vector<HistorySample>>(History(descending));
  snap.session.Edit().timings = {
      {"rectify", 1.2}, {"disparity", 28.0}, {"slad", 4.1}, {"tracking", 1.9}};
  snap.decision_hash = 0xfeed;
  return snap;
}

}  // namespace palace::fake
