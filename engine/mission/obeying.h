// What a command does: one operator() each. For this folder only.
//
//   site_commands.cpp   which site is selected, refused, approved, looked at, and from which side
//   commands.cpp        ways, the area, hold and wave-off, alarms, who commands
#pragma once

#include <string>
#include <string_view>

#include "engine/mission/transitions.h"

namespace palace {

/// Records why it is not done, and returns that.
Status Refuse(MissionTurn& turn, Timestamp now, std::string_view what, std::string why);
/// "a script" or "the operator".
const char* WhoAsks(CommandOrigin origin);

struct Obeying {
  MissionTurn& turn;
  CommandOrigin origin;
  Timestamp now;

  Status operator()(const SelectSite& action) const;
  Status operator()(const DisarmSite&) const;
  Status operator()(const ApproveSite& action) const;
  Status operator()(const LookAtSite& action) const;
  Status operator()(const TurnApproach& action) const;
  Status operator()(const RefuseSite& action) const;
  Status operator()(const HoldHere&) const;
  Status operator()(const WaveOff&) const;
  Status operator()(const AcknowledgeWaveOff&) const;
  Status operator()(const AcknowledgeAlarm& action) const;
  Status operator()(const AddBookmark& action) const;
  Status operator()(const AskForCommand& action) const;
  Status operator()(const ReleaseCommand&) const;
  Status operator()(const CommandLost& action) const;
  Status operator()(const FlyTo& there) const;
  Status operator()(const SetFlyArea& action) const;
  Status operator()(const ClearFlyArea&) const;
  /// Why the armed site may not be flown to by what was on the screen then; empty when it may.
  std::string WhyNotCommit(std::uint64_t site_id, std::uint64_t snapshot_sequence) const;
  Status Commit(double stop_height_m) const;
  // Limits are kept elsewhere.
  Status operator()(const SetSetting&) const { return Ok(); }
  Status operator()(const ApplySettings&) const { return Ok(); }
  Status operator()(const DiscardSettings&) const { return Ok(); }
};

}  // namespace palace
