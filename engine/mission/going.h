// Going: the hovering vehicle is sent to hover elsewhere, to look at other ground. On GPS; nothing
// is approved to land.
//
//   sent -> accepted -> flown -> over         ends where it hovers there, or by what stops it
//
// What was selected is not any more. Asked of every way: nothing is flown, the vehicle hovers and
// was heard, and the way keeps to way_rules.h. Ground that was not seen refuses nothing: it is
// told.
#pragma once

#include <string>

#include "engine/flight/level_way.h"
#include "engine/mission/mission_inputs.h"
#include "engine/mission/transitions.h"
#include "engine/mission/way_rules.h"
#include "engine/model/command.h"

namespace palace {

/// Why the vehicle is not sent anywhere now; empty when it may be.
std::string WhyNowhere(const MissionMemory& memory, Timestamp now);
/// Why it is not sent there; empty when it is.
std::string WhyNotThere(const MissionMemory& memory, const FlyTo& there, Timestamp now);

void StartGoing(MissionTurn& turn, const FlyTo& there, const char* who, Timestamp now);
/// Stops the vehicle where it is.
void StopGoing(MissionTurn& turn, const std::string& why, Timestamp now);
/// The vehicle's answer to it, among those of a bundle.
void TakeGoAnswer(MissionTurn& turn, const CommandAck& ack, Timestamp now);
/// By what the vehicle says that it does. Once a step.
void FollowGoing(MissionTurn& turn, Timestamp now);

}  // namespace palace
