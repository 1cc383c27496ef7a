// Mission: the safety state machine. It decides what may be approved, and when a descent must stop.
//
//   NO_LIVE -> SEARCH <-> PROPOSED <-> ARMED -> APPROVED -> DESCENDING -> LANDED
//   ARMED, PROPOSED -> SEARCH            when the operator refuses the site, until another has won
//   ARMED, APPROVED -> PROPOSED          when the site, a hash, the boot or the clock changes
//   DESCENDING -> HOLD -> PROPOSED       when the site is lost, vision is lost, or by the operator
//   any -> ABORTING -> SEARCH            by wave-off; the vehicle confirms and a person
//   acknowledges
//
// Everything stale, missing or not finite can only disable (I3). Once per bundle: Apply the
// commands, then Update, then TakeMessages. Heights are metres above the site, skid centre.
// Source: reference/reliability.md section 3 (guards G1-G15, invariants I1-I22), DESIGN.md 8.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/result.h"
#include "engine/flight/flight_path.h"
#include "engine/mission/alarms.h"
#include "engine/mission/guards.h"
#include "engine/mission/input_watch.h"
#include "engine/mission/site_watch.h"
#include "engine/model/command.h"
#include "engine/model/snapshot.h"
#include "engine/trust/approval.h"

namespace palace {

struct MissionOptions {
  std::uint64_t session_id = 1;  ///< random per start; from the seed in lockstep simulation
  ApprovalSigner signer = ApprovalSigner::FromSeed(1);
  bool allow_script_approvals = true;  ///< still only on simulated vehicles (DESIGN.md 8)
};

/// Everything the state machine may look at, for one bundle.
struct MissionInputs {
  Timestamp now;
  SourceKind source_kind = SourceKind::kNone;
  bool can_transmit = false;
  bool recorder_ok = false;
  bool simulated_vehicle = false;  ///< built-in simulator, or a session labelled simulated
  const FrameBundle& bundle;
  const std::vector<ChannelHealth>& channels;
  const TerrainDecision* applied = nullptr;  ///< newest map, may be null
  bool new_map = false;                      ///< `applied` was made from this bundle
  const NavigationStatus& navigation;
  const TrackerStatus& tracker;
  StereoQuality stereo{};                  ///< of the newest range map
  RangeAgreement range_agreement{};        ///< stereo against laser
  std::optional<LandingSite> rechecked;    ///< the armed site evaluated on the newest map
  std::optional<NearestHazard> nearest;    ///< to it on that map, when it is no hazard itself
  std::optional<LandingSite> alternative;  ///< the alternative kept for it, evaluated likewise
  const Settings& settings;
  std::uint64_t settings_hash = 0;
  std::uint64_t calibration_hash = 0;
  /// Of the newest snapshot published; this pass publishes the next number.
  std::uint64_t snapshot_sequence = 0;
  Eigen::Vector3d p_WB_estimate = Eigen::Vector3d::Constant(NAN);
  Eigen::Vector3d skid_centre_W = Eigen::Vector3d::Constant(NAN);  ///< by the estimate in force
  std::string_view source_damage{};                                ///< SourceStatus::damage
};

class Mission {
 public:
  explicit Mission(MissionOptions options);

  /// Refuses with the reason (I22), which is also in the events. Settings commands are not its
  /// business: they succeed and change nothing here.
  Status Apply(const EngineCommand& command, Timestamp now);
  void Update(const MissionInputs& inputs);

  const MissionStatus& status() const { return status_; }
  const std::vector<Event>& events() const { return events_; }
  /// Messages for the vehicle since the last call, oldest first. Always empty in replay.
  std::vector<VehicleMessage> TakeMessages();

  bool WantsTracking() const;   ///< ARMED to HOLD
  bool VisionAllowed() const;   ///< the vehicle accepted the approval
  bool SettingsFrozen() const;  ///< ARMED and later: moved limits preview only
  /// The best other site that shares no ground with the armed one, kept as long as it holds.
  const std::optional<LandingSite>& alternative() const { return alternative_; }
  /// Settings were applied while armed or approved (I13).
  void DropApproval(std::string_view why);
  void AddEvent(Timestamp time, EventKind kind, std::string text);

 private:
  /// What of the last Update the commands need: copies, so that nothing dangles.
  struct Facts {
    bool valid = false;
    Timestamp now;
    SourceKind source_kind = SourceKind::kNone;
    bool simulated_vehicle = false;
    std::vector<LandingSite> sites;
    std::uint64_t map_hash = 0;
    std::uint64_t settings_hash = 0;
    std::uint64_t terrain_settings_hash = 0;
    std::uint64_t calibration_hash = 0;
    MissionSettings limits;
    double commit_height_m = 3;
    Eigen::Vector3d skid_centre_W = Eigen::Vector3d::Constant(NAN);
    // By the estimate in force; yaw by the vehicle's own attitude.
    Eigen::Vector3d p_WB = Eigen::Vector3d::Constant(NAN);
    Eigen::Vector3d v_WB = Eigen::Vector3d::Constant(NAN);
    double yaw_rad = NAN;
    Eigen::Vector3d p_BC = Eigen::Vector3d::Zero();  ///< of the newest rig
    GuardInputs guards;                              ///< what does not age: health, link, recorder
  };
  /// What an armed site is bound to.
  struct ArmedFacts {
    std::uint64_t map_hash = 0, settings_hash = 0, terrain_settings_hash = 0;
    std::uint64_t calibration_hash = 0, boot_id = 0;
    std::optional<std::uint64_t> first_sequence;  ///< first snapshot that showed it armed
    Timestamp shown_since;
    bool confirmed = false;
  };
  /// The best site's run of wins.
  struct Winner {
    std::uint64_t id = 0;
    int maps = 0;
    int missing = 0;
    Timestamp since;
  };

  // mission.cpp, mission_steps.cpp
  void Enter(MissionState state, std::string why, Timestamp now);
  void ForgetSite();
  void Kill(std::string_view why);
  void Drop(std::string why, Timestamp now);
  void Hold(std::string why, Timestamp now);
  void Abort(std::string why, Timestamp now);
  void Send(VehicleMessage message);
  void Repeat(Timestamp now);
  void FollowJump(const MissionInputs& inputs);
  void RestartReplay(Timestamp now);
  void RememberFacts(const MissionInputs& inputs);
  void FollowWinner(const MissionInputs& inputs);
  void FollowSite(const MissionInputs& inputs);
  void FollowAlternative(const MissionInputs& inputs);
  void RecordRecheck(const MissionInputs& inputs);
  void FollowAcks(const MissionInputs& inputs);
  void FollowDeadApproval(const MissionInputs& inputs);
  bool IsApproval(std::uint64_t id, std::uint64_t own) const;
  bool OwnApproval(std::uint64_t id) const;
  void Step(const MissionInputs& inputs);
  void StepSearching(const MissionInputs& inputs);
  void StepArmed(const MissionInputs& inputs);
  void StepApproved(const MissionInputs& inputs);
  void StepDescending(const MissionInputs& inputs);
  void StepHold(const MissionInputs& inputs);
  void StepAborting(const MissionInputs& inputs);
  std::string WhyStale(Timestamp now) const;
  std::string WhyDrop(const MissionInputs& inputs) const;
  std::string WhyHold(const MissionInputs& inputs) const;
  bool SiteLost(Timestamp now) const;
  std::string AlternativeWords() const;
  bool WinnerStands(Timestamp now) const;
  std::string WhyNoProposal(Timestamp now) const;
  bool Executing() const;
  double HeightAboveSite() const;
  std::string SiteName() const;
  bool HasLanded(const MissionInputs& inputs) const;
  void Land(const MissionInputs& inputs);
  // mission_status.cpp
  void Publish(const MissionInputs& inputs);
  void PublishGeometry(const MissionInputs& inputs);
  void PublishLimits(const MissionInputs& inputs);
  /// The armed site, else the one that leads.
  const LandingSite* SiteInQuestion() const;
  /// Freezes the way to the armed site as soon as the vehicle's place is known.
  void PlanApproach();
  ApproachPlan StraightPlan(const Eigen::Vector3d& p_WS) const;
  double KnownWind(Timestamp now) const;
  /// The approved path, else the one that would be approved.
  FlightPath PathTo(const LandingSite& site) const;
  double TimeLeft(const FlightPath& path) const;
  bool FliesPath() const;
  void PublishAlarms(const MissionInputs& inputs);
  std::vector<AlarmCondition> SensorAlarms(const MissionInputs& inputs) const;
  std::vector<AlarmCondition> MissionAlarms(const MissionInputs& inputs) const;
  double LaserMismatch(const MissionInputs& inputs) const;
  GuardInputs MakeGuardInputs(Timestamp now) const;
  // mission_commands.cpp
  Status Refuse(Timestamp now, std::string_view what, std::string why);
  std::string WhyNoCommand(const EngineCommand& command) const;
  Status Select(std::uint64_t site_id, Timestamp now);
  Status Approve(const ApproveSite& action, CommandOrigin origin, Timestamp now);
  Status Disarm(Timestamp now);
  Status RefuseProposal(std::uint64_t site_id, Timestamp now);
  Approval MakeApproval(Timestamp now);
  const LandingSite* FindSite(std::uint64_t site_id) const;

  MissionOptions options_;
  MissionStatus status_;
  std::vector<Event> events_;
  std::vector<VehicleMessage> outbox_;
  Facts facts_;
  ArmedFacts armed_;
  SiteWatch site_;
  std::optional<LandingSite> newest_;       ///< the armed site on the newest map; empty off it
  SiteVerdict told_ = SiteVerdict::kHolds;  ///< of the armed site, in the events
  std::optional<LandingSite> alternative_;
  Winner winner_;
  InputWatch watch_;
  AlarmBoard alarms_;
  std::deque<std::pair<std::uint64_t, Timestamp>> shown_;  ///< recent snapshots
  std::uint64_t counter_ = 0;                              ///< of approvals
  std::uint64_t request_counter_ = 0;                      ///< of hold and abort requests
  std::uint64_t dead_approval_id_ = 0;  ///< last approval that may never resume (I14)
  Timestamp sent_at_;                   ///< of the approval, hold or abort being repeated
  Timestamp approved_now_;              ///< station time of the approval
  std::optional<VehicleMessage> repeating_;
  std::uint64_t hold_id_ = 0, abort_id_ = 0;
  bool vehicle_ever_heard_ = false;
  bool abort_seen_ = false;  ///< the vehicle acknowledged or flies the abort
  bool wave_off_acknowledged_ = false;
  bool vision_allowed_ = false;
  std::string refusal_;  ///< the vehicle's refusal of the last approval, empty when none
  Timestamp vision_good_at_;
  Timestamp map_seen_at_;
};

}  // namespace palace
