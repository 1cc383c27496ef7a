// ScriptedOperator: a careful operator without a screen, for experiments and tests. Works on
// simulated vehicles only, as every script does (DESIGN.md 8).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "engine/core/frames.h"
#include "engine/model/snapshot.h"

namespace palace {

/// Waits for a proposal, looks at it, arms the best site, approves when all guards pass.
///
/// One that looks again, at most so many times: where a descent was stopped below 10 m above its
/// site, or nothing could be approved for a while, it waves off, and goes on from the hover. It
/// then takes the best site in view that failed it least, deselects what stays blocked, and
/// acknowledges warnings that are over.
///
/// One that searches, where nothing could be approved for a while, flies the look that the mission
/// proposes, else deselects what stays blocked.
///
/// One that looks closer flies down to look before it approves, once at each site, wherever a look
/// is offered; where nothing could be approved after it, one that looks again does.
class ScriptedOperator {
 public:
  explicit ScriptedOperator(int looks_again = 0, bool looks_closer = false, bool searches = false)
      : looks_again_(looks_again),
        insists_(looks_again > 0),
        looks_closer_(looks_closer),
        searches_(searches) {}

  std::vector<EngineCommand> Decide(const EngineSnapshot& snapshot);
  /// Landed, and looked at it for a second.
  bool finished() const { return finished_; }

 private:
  std::vector<EngineCommand> Insist(const EngineSnapshot& snapshot, double in_state_s);
  std::vector<EngineCommand> Search(const EngineSnapshot& snapshot);
  const LandingSite* Choice(const EngineSnapshot& snapshot) const;

  int looks_again_;
  bool insists_;
  bool looks_closer_;
  bool searches_;
  std::optional<Timestamp> nothing_since_;  ///< could be approved
  std::set<std::uint64_t> looked_at_;
  std::optional<Timestamp> seen_since_;
  MissionState last_ = MissionState::kNoLive;
  std::optional<Timestamp> flown_at_;  ///< an approval stood last, since the last wave-off
  std::uint64_t flown_site_ = 0;       ///< the site of it, until it was counted
  bool flew_to_look_ = false;          ///< and it was no landing
  bool low_ = false;                   ///< it was stopped near the ground, and has not climbed
  std::map<std::uint64_t, int> failures_;
  bool finished_ = false;
};

}  // namespace palace
