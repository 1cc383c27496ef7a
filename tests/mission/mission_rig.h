// A mission with a small vehicle at the other end: ten steps a second, everything settable.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/mission/guards.h"
#include "engine/mission/mission.h"

namespace palace {

/// Obeys as DESIGN.md 7 asks of a vehicle: each approval once and in time, answers, aligns,
/// descends, sinks. To another hover it takes 2 s, however far it is. Seals are the link's business
/// (tests/trust).
struct SmallVehicle {
  std::uint64_t accepted_id = 0;  ///< newest approval taken; ids rise
  std::uint64_t boot_id = 77;
  VehicleMode mode = VehicleMode::kHover;
  std::uint64_t approval_id = 0;
  double stop_height_m = 0;  ///< of the approval that it flies
  double height_m = 20;
  double wind_mps = 0;
  double energy = 1, energy_per_s = 0;  ///< share left, and how fast it falls
  double wind_from_rad = 0;
  double climb_mps = 2;  ///< of a wave-off
  double mode_for_s = 0;
  bool answers = true;
  bool refuses = false;
  bool refuses_holds = false;
  bool hears_aborts = true;  ///< false: it flies on, and somebody answers in its place
  std::vector<CommandAck> acks;
  std::optional<GoRequest> goes_to, arrived;

  void Set(VehicleMode next) {
    mode = next;
    mode_for_s = 0;
  }
  void Take(const VehicleMessage& message, Timestamp now) {
    if (const auto* approval = std::get_if<Approval>(&message)) {
      std::string why = refuses ? "Fuel low" : "";
      if (why.empty() && approval->id != accepted_id) {
        why = WhyRefused(*approval, now);
        if (why.empty()) {
          approval_id = accepted_id = approval->id;
          stop_height_m = approval->stop_height_m;
          Set(VehicleMode::kAlign);
        }
      }
      Answer(approval->id, why, now);
    } else if (const auto* hold = std::get_if<HoldRequest>(&message)) {
      if (refuses_holds) {
        return Answer(hold->command_id, "Of another session", now);
      }
      if (mode != VehicleMode::kHover && mode != VehicleMode::kAbort &&
          mode != VehicleMode::kLanded) {
        Set(VehicleMode::kHold);
      }
      approval_id = 0;
      Answer(hold->command_id, "", now);
    } else if (const auto* go = std::get_if<GoRequest>(&message)) {
      if (!refuses) {
        goes_to = *go;
        Set(VehicleMode::kGo);
      }
      Answer(go->command_id, refuses ? "Fuel low" : "", now);
    } else if (const auto* abort = std::get_if<AbortRequest>(&message)) {
      if (hears_aborts && mode != VehicleMode::kAbort) {
        Set(VehicleMode::kAbort);
      }
      approval_id = hears_aborts ? 0 : approval_id;
      Answer(abort->command_id, "", now);
    }
  }
  void Fly(double dt_s) {
    mode_for_s += dt_s;
    if (mode == VehicleMode::kAlign && mode_for_s > 1) {
      Set(VehicleMode::kDescend);
    } else if (mode == VehicleMode::kDescend) {
      height_m -= 2 * dt_s;
      if (stop_height_m > 0 && height_m <= stop_height_m) {
        approval_id = 0;
        Set(VehicleMode::kHover);
      } else if (height_m <= 2) {
        Set(VehicleMode::kSink);
      }
    } else if (mode == VehicleMode::kSink) {
      height_m = std::max(0.0, height_m - dt_s);
      if (height_m == 0) {
        Set(VehicleMode::kLanded);
      }
    } else if (mode == VehicleMode::kGo && mode_for_s > 2) {
      arrived = goes_to;
      Set(VehicleMode::kHover);
    } else if (mode == VehicleMode::kAbort) {
      height_m += climb_mps * dt_s;
      if (mode_for_s > 3) {
        Set(VehicleMode::kHover);
      }
    }
  }

 private:
  std::string WhyRefused(const Approval& approval, Timestamp now) const {
    if (approval.vehicle_boot_id != boot_id) {
      return "Given for another start of this vehicle";
    }
    if (approval.id < accepted_id) {
      return "An older approval";
    }
    return now >= approval.expires_at ? "Expired" : "";
  }
  void Answer(std::uint64_t id, std::string why, Timestamp now) {
    if (answers) {
      acks.push_back(
          {now, id, why.empty() ? AckResult::kAccepted : AckResult::kRefused, std::move(why)});
    }
  }
};

/// This station commands.
inline AuthorityStatus Commanding() {
  AuthorityStatus authority;
  authority.standing = AuthorityStanding::kHeld;
  return authority;
}

struct MissionRig {
  explicit MissionRig(std::uint64_t session = 5) : options{session, true}, mission(options) {
    AddSite(101, 'A', {10, 2, 0});
    AddSite(102, 'B', {-6, 8, 0});
    navigation.gps.running = navigation.gps.estimate.healthy = true;
    navigation.laser.state = LaserHealth::State::kFine;
    tracker.coherence = 0.95;
    settings.mission.glide_slope_deg = 90;  // the small vehicle comes straight down
  }

  void AddSite(std::uint64_t id, char letter, const Eigen::Vector3d& p_WS) {
    LandingSite site;
    site.id = id;
    site.letter = letter;
    site.p_WS = p_WS;
    site.safe_distance_m = 4;
    site.clear_radius_m = 2.3;
    site.clearance_m = 1.7;
    site.confirmed = true;
    sites.push_back(site);
  }
  LandingSite* Site(std::uint64_t id) {
    const auto it =
        std::find_if(sites.begin(), sites.end(), [&](const auto& s) { return s.id == id; });
    return it == sites.end() ? nullptr : &*it;
  }

  /// One tenth of a second: what the vehicle got, what it sends, one Update.
  void Step() {
    Wait();
    mission.Update(Inputs());
  }
  /// All of that but the Update.
  void Wait() {
    now = AddSeconds(now, 0.1);
    ++sequence;
    for (VehicleMessage& message : mission.TakeMessages()) {
      sent.push_back(message);
      if (link_up) {
        vehicle.Take(message, VehicleNow());
      }
    }
    vehicle.energy -= 0.1 * vehicle.energy_per_s;
    vehicle.Fly(0.1);
    if (const auto arrived = std::exchange(vehicle.arrived, std::nullopt)) {
      north_m = arrived->p_WB.x();
      east_m = arrived->p_WB.y();
      vehicle.height_m = -arrived->p_WB.z();
      yaw_rad = arrived->heading_rad;
    }
    Sense();
    decision.selection.sites = sites;
    decision.map_hash = 1000 + (maps_up ? sequence : 0);
    decision.map_time = now;
    tracker.locked = mission.WantsTracking() && tracker_locks;
  }
  MissionInputs::Session Session() const {
    return {.now = now,
            .role = RoleOf(source, false),
            .why_no_vehicle = WhyNoVehicle(source),
            .can_transmit = can_transmit,
            .recorder_ok = recorder_ok,
            .authority = authority,
            .snapshot_sequence = sequence - 1};
  }
  /// What this tenth of a second brought.
  MissionInputs Inputs() {
    MissionInputs in{.session = Session(),
                     .vehicle = {.bundle = bundle, .channels = channels, .simulated = simulated},
                     .terrain = {.decision = &decision,
                                 .new_map = maps_up && cameras_up,
                                 .forgotten = std::exchange(forgotten, false)},
                     .navigation = {.navigation = navigation,
                                    .tracker = tracker,
                                    .why_not_trusted = why_not_trusted,
                                    .stereo = stereo,
                                    .new_stereo = cameras_up,
                                    .p_WB_estimate = p_WB(),
                                    .skid_centre_W = p_WB()},
                     .limits = {.settings = settings,
                                .settings_hash = settings_hash,
                                .calibration_hash = calibration_hash}};
    if (mission.status().armed) {
      if (const LandingSite* site = Site(mission.status().armed->id)) {
        in.terrain.rechecked = *site;
        in.terrain.rechecked->slope_rad.value = site_slope_rad;
        in.terrain.rechecked->age_s = std::max(site->age_s, ground_age_s);
      }
    }
    if (mission.alternative()) {
      if (const LandingSite* site = Site(mission.alternative()->id)) {
        in.terrain.alternative = *site;
      }
    }
    return in;
  }
  void Run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 10 + 0.5); ++i) {
      Step();
    }
  }
  /// Steps until the state is reached; false after `limit_s`.
  bool RunUntil(MissionState state, double limit_s = 60) {
    for (int i = 0; i < static_cast<int>(limit_s * 10); ++i) {
      if (mission.status().state == state) {
        return true;
      }
      Step();
    }
    return mission.status().state == state;
  }
  Status Do(CommandAction action, CommandOrigin origin = CommandOrigin::kOperator) {
    return mission.Apply({origin, std::move(action)}, Session());
  }
  /// Arms site A and waits until it may be approved.
  void Arm(std::uint64_t id = 101) {
    ASSERT_TRUE(RunUntil(MissionState::kProposed));
    ASSERT_TRUE(Do(SelectSite{id}).ok());
    Run(1.5);
  }
  Status ApproveNow(CommandOrigin origin = CommandOrigin::kOperator) {
    const auto& armed = mission.status().armed;
    return Do(ApproveSite{armed ? armed->id : 101, sequence}, origin);
  }
  Timestamp VehicleNow() const { return {now.us + clock_offset_us}; }
  Eigen::Vector3d p_WB() const { return {north_m, east_m, -vehicle.height_m}; }
  MissionState state() const { return mission.status().state; }
  template <typename T>
  int SentCount() const {
    return static_cast<int>(std::count_if(sent.begin(), sent.end(), [](const auto& message) {
      return std::holds_alternative<T>(message);
    }));
  }

  void Sense() {
    bundle = {};
    bundle.sequence = sequence;
    bundle.time = now;
    bundle.discontinuity = std::exchange(jumped, false);
    bundle.arrival = arrival;
    bundle.rig = camera_rig;
    if (arrival.clock) {
      arrival.clock->stepped_s = arrival.clock->stalled_s = 0;  // told once
    }
    if (cameras_up && stereo_up) {
      bundle.stereo =
          std::make_shared<StereoFrame>(StereoFrame{now, ImageU8(2, 2, 7), ImageU8(2, 2, 7)});
    }
    if (pose_up) {
      VehiclePose pose;
      pose.time = now;
      pose.X_WB.R = RotationFromEuler({0, 0, yaw_rad});
      pose.v_WB.z() = vehicle.mode == VehicleMode::kAbort ? -vehicle.climb_mps : 0;
      bundle.poses.push_back(pose);
    }
    if (link_up) {
      VehicleStatus status;
      status.time = VehicleNow();
      status.boot_id = vehicle.boot_id;
      status.mode = vehicle.mode;
      status.on_ground = vehicle.mode == VehicleMode::kLanded;
      status.approval_id = vehicle.approval_id;
      status.battery_or_fuel = vehicle.energy;
      status.wind_speed_mps = vehicle.wind_mps;
      status.wind_from_rad = vehicle.wind_from_rad;
      bundle.status = status;
      bundle.acks = std::exchange(vehicle.acks, {});
    }
  }

  MissionOptions options;
  Mission mission;
  SmallVehicle vehicle;
  FrameBundle bundle;  ///< of the newest Wait
  Timestamp now{1'000'000'000};
  std::uint64_t sequence = 0;
  std::int64_t clock_offset_us = 0;
  double east_m = 2;  ///< where the vehicle is
  double north_m = 9.5;
  double yaw_rad = 0;
  bool forgotten = false;                       ///< the maps before the next bundle are void
  bool jumped = false;                          ///< the next bundle follows a jump in time
  std::shared_ptr<const StereoRig> camera_rig;  ///< told with every bundle
  SourceKind source = SourceKind::kSimulation;
  AuthorityStatus authority = Commanding();
  bool can_transmit = true, recorder_ok = true, simulated = true;
  bool cameras_up = true, pose_up = true, link_up = true, maps_up = true, tracker_locks = true;
  Settings settings;
  std::uint64_t settings_hash = 31, calibration_hash = 41;
  std::vector<LandingSite> sites;
  double site_slope_rad = 0;  ///< of the armed site as re-checked
  TerrainDecision decision;
  NavigationStatus navigation;
  TrackerStatus tracker;
  std::string why_not_trusted;  ///< of all trackers together
  StereoQuality stereo;
  ArrivalNotes arrival;     ///< of the next bundles
  bool stereo_up = true;    ///< pictures come in pairs
  double ground_age_s = 0;  ///< of the site, at each map
  /// As the station's own watch tells them: nothing wrong.
  std::vector<ChannelHealth> channels = {
      {ChannelId::kCameraLeft, ChannelHealth::State::kFresh, 0, 10, 10, 1, 0, ""},
      {ChannelId::kCameraRight, ChannelHealth::State::kFresh, 0, 10, 10, 1, 0, ""},
      {ChannelId::kVehiclePose, ChannelHealth::State::kFresh, 0, 50, 50, 1, 0, ""}};
  std::vector<VehicleMessage> sent;
};

}  // namespace palace
