// What happens on the way from one state to another: entering, dropping, holding, aborting.
#pragma once

#include <string>
#include <string_view>

#include "engine/mission/step.h"

namespace palace {

/// One call of Step or Apply while it works: the memory in its new form, and what it brings about.
struct MissionTurn {
  const MissionOptions& station;
  MissionMemory memory;
  MissionEffects effects;
};

void AddEvent(MissionTurn& turn, Timestamp time, EventKind kind, std::string text);
/// An alarm rose, or grew worse.
void AddEvent(MissionTurn& turn, Timestamp time, const Alarm& alarm);
/// Queues a message, unless the session's role forbids it.
void Send(MissionTurn& turn, VehicleMessage message);
/// Sends it now, and by Repeat until the vehicle answers it.
void SendUntilAnswered(MissionTurn& turn, VehicleMessage message, Timestamp now);
/// Sends the message that waits for its answer again, twice a second.
void Repeat(MissionTurn& turn, Timestamp now);

void Enter(MissionTurn& turn, MissionState state, std::string why, Timestamp now);
/// Nothing is armed any more.
void ForgetSite(MissionMemory& memory);
/// The approval is dead and can never resume (I14).
void Kill(MissionTurn& turn, std::string_view why);
/// Back to PROPOSED. An approval on its way is withdrawn at the vehicle too.
void Drop(MissionTurn& turn, std::string why, Timestamp now);
void Hold(MissionTurn& turn, std::string why, Timestamp now);
/// Sends a hold, until the vehicle answers it.
void AskToHold(MissionTurn& turn, std::string why, Timestamp now);
void Abort(MissionTurn& turn, std::string why, Timestamp now);

/// Session and number in one: unique among all approvals, or among all requests, of a session.
std::uint64_t ApprovalNumber(std::uint64_t session_id, std::uint64_t counter);
std::uint64_t RequestNumber(std::uint64_t session_id, std::uint64_t counter);

}  // namespace palace
