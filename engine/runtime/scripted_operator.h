// ScriptedOperator: a careful operator without a screen, for experiments and tests. Works on
// simulated vehicles only, as every script does (DESIGN.md 8).
#pragma once

#include <vector>

#include "engine/model/snapshot.h"

namespace palace {

/// Waits for a proposal, looks at it, arms the best site, approves when all guards pass.
class ScriptedOperator {
 public:
  std::vector<EngineCommand> Decide(const EngineSnapshot& snapshot);
  /// Landed, and looked at it for a second.
  bool finished() const { return finished_; }

 private:
  std::optional<Timestamp> seen_since_;
  MissionState last_ = MissionState::kNoLive;
  bool finished_ = false;
};

}  // namespace palace
