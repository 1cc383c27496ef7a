// MissionInputs: everything the state machine may look at in one step, in five groups.
//
// References hold for the length of one step only; what a later command needs is copied.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Dense>

#include "engine/model/cell_explanation.h"
#include "engine/model/landing_site.h"
#include "engine/model/mission/losses.h"
#include "engine/model/mission/session_role.h"
#include "engine/model/recording.h"
#include "engine/model/snapshot.h"

namespace palace {

/// What this station is, for as long as it runs.
struct MissionOptions {
  std::uint64_t session_id = 1;        ///< random per start; from the seed in lockstep simulation
  bool allow_script_approvals = true;  ///< still only on simulated vehicles (DESIGN.md 8)
  /// Numbers given in this session before this mission began: an engine that was started again
  /// inherits no approval, and repeats no number (I9, I17).
  std::uint64_t approvals_before = 0;
  std::uint64_t requests_before = 0;
  std::uint64_t events_before = 0;
};

struct MissionInputs {
  struct Session {
    Timestamp now;
    SessionRole role = SessionRole::kNone;
    /// WhyNoVehicle of the source: why nothing can be commanded; empty with a vehicle.
    const char* why_no_vehicle = "";
    bool can_transmit = false;
    bool recorder_ok = false;
    RecordState record{};              ///< how recording stands
    std::string_view engine_stop{};    ///< what stopped the engine a moment ago
    std::string_view source_damage{};  ///< SourceStatus::damage
    Losses losses{};                   ///< at the doors, since the session began
    AuthorityStatus authority{};       ///< whether this station commands the vehicle
    /// Of the newest snapshot published; this pass publishes the next number.
    std::uint64_t snapshot_sequence = 0;
  };
  struct Vehicle {
    const FrameBundle& bundle;
    const std::vector<ChannelHealth>& channels;
    bool simulated = false;  ///< built-in simulator, or a session labelled simulated
  };
  struct Terrain {
    const TerrainDecision* decision = nullptr;  ///< of record; may be null
    bool new_map = false;                       ///< `decision` was made from this bundle
    bool forgotten = false;                     ///< all maps before this bundle are void
    std::optional<LandingSite> rechecked{};     ///< the armed site evaluated on the newest map
    std::optional<NearestHazard> nearest{};     ///< to it there, when it is no hazard itself
    std::optional<LandingSite> alternative{};   ///< the alternative kept for it, likewise
  };
  struct Navigation {
    const NavigationStatus& navigation;
    const TrackerStatus& tracker;
    std::string_view why_not_trusted{};  ///< TrackerConsensus; empty with no trackers
    StereoQuality stereo{};              ///< of the newest range map
    bool new_stereo = false;             ///< which was made from this bundle
    RangeAgreement range_agreement{};    ///< stereo against laser
    Eigen::Vector3d p_WB_estimate = Eigen::Vector3d::Constant(NAN);
    Eigen::Vector3d skid_centre_W = Eigen::Vector3d::Constant(NAN);  ///< by the estimate in force
  };
  struct Limits {
    const Settings& settings;
    std::uint64_t settings_hash = 0;
    std::uint64_t calibration_hash = 0;
  };

  Session session;
  Vehicle vehicle;
  Terrain terrain;
  Navigation navigation;
  Limits limits;
};

}  // namespace palace
