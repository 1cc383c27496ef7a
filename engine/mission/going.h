// Going: the hovering vehicle is sent to hover elsewhere, to look at other ground. On GPS; nothing
// is approved to land.
//
//   sent -> accepted -> flown -> over         ends where it hovers there, or by what stops it
//
// What was selected is not any more. Asked of every way: nothing is flown, the vehicle hovers and
// was heard, it stays in the area that was drawn, it goes no
// lower (a way down is flown to a site), no farther than kFarthestGo_m and no higher than
// kMostClimb_m at once, and the newest map knows nothing that reaches within kLeastBelowSkids_m of
// its skids on the level part. Ground that was not seen refuses nothing: it is told.
#pragma once

#include <string>

#include "engine/flight/level_way.h"
#include "engine/mission/mission_inputs.h"
#include "engine/mission/transitions.h"
#include "engine/model/command.h"

namespace palace {

inline constexpr double kFarthestGo_m = 60;
inline constexpr double kMostClimb_m = 30;
inline constexpr double kLeastBelowSkids_m = 3;

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
