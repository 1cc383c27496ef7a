// Step and Apply: the safety state machine as two pure functions. The same memory and the same
// inputs give the same memory and the same effects; nothing else is read, and nothing else changes.
//
//   NO_LIVE -> SEARCH <-> PROPOSED <-> ARMED -> APPROVED -> DESCENDING -> LANDED
//   ARMED, PROPOSED -> SEARCH            when the operator refuses the site, until another has won
//   ARMED, APPROVED -> PROPOSED          when the site, a hash, the boot or the clock changes
//   DESCENDING -> HOLD -> PROPOSED       when the site is lost, vision is lost, or by the operator
//   any -> ABORTING -> SEARCH            by wave-off; the vehicle confirms and a person
//   acknowledges
//
// Everything stale, missing or not finite can only disable (I3). Once per bundle: Apply the
// commands, then Step. The order within a step: a jump in time, arrivals, facts, the winner, the
// re-check of the armed site, the vehicle's answers, the state, repeats, what is published.
// Source: reference/reliability.md section 3 (guards G1-G15, invariants I1-I22), DESIGN.md 8.
#pragma once

#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/mission/mission_inputs.h"
#include "engine/mission/mission_memory.h"
#include "engine/model/command.h"

namespace palace {

/// What a step does outside of itself, oldest first. The status is in the memory.
struct MissionEffects {
  std::vector<VehicleMessage> messages;  ///< for the vehicle; none where SessionRole forbids it
  std::vector<Event> events;
};

struct MissionStep {
  MissionMemory memory;
  MissionEffects effects;
};

struct MissionAnswer {
  MissionMemory memory;
  MissionEffects effects;
  Status status;  ///< why the command was refused (I22); the reason is among the events too
};

MissionStep Step(const MissionOptions& station, MissionMemory memory, const MissionInputs& inputs);

/// `session.now` is the time of the picture that the command was given on. Commands about settings
/// are not the mission's business: they succeed and change nothing here.
MissionAnswer Apply(const MissionOptions& station, MissionMemory memory,
                    const EngineCommand& command, const MissionInputs::Session& session);

/// An armed site, or an approval that is not flown yet: applied settings drop it (I13).
bool DropsWithSettings(const MissionStatus& status);
/// Settings were applied: what is armed or approved but not flying falls (I13).
MissionStep DropApproval(const MissionOptions& station, MissionMemory memory, std::string_view why);

}  // namespace palace
