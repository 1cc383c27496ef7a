// What a bundle brings to the mission before any state looks at it: a jump in time, facts, the best
// site's run of wins, the vehicle's answers.
#pragma once

#include "engine/mission/transitions.h"

namespace palace {

/// Ages across a jump mean nothing: forgets every arrival, waits for three new samples (I18), and
/// stops what was under way. A record or a folder starts anew.
void FollowJump(MissionTurn& turn, const MissionInputs& inputs);
/// Before a command: what the session is to the mission, before the first step too. What was lost
/// since the last step forbids at once; what came back allows only when a step has shown it (I3).
void HearSession(MissionFacts& facts, const MissionInputs::Session& session);
/// After the watch of the inputs.
void RememberEnergy(MissionMemory& memory, const MissionInputs& inputs);
void RememberFacts(MissionMemory& memory, const MissionInputs& inputs);
void FollowWinner(MissionMemory& memory, const MissionInputs& inputs);
/// Events of who commands, and of messages to the vehicle that others sent.
void FollowAuthority(MissionTurn& turn, const MissionInputs& in);
void FollowAnswers(MissionTurn& turn, const MissionInputs& inputs);
/// A vehicle that flies an approval which ended is held again (I14).
void StopDeadApproval(MissionTurn& turn, const MissionInputs& inputs);

}  // namespace palace
