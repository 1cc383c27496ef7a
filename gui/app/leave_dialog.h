// The question before the station leaves a vehicle in the air.
#pragma once

#include <string>

#include "gui/widgets/draw.h"

namespace palace {

enum class LeaveAnswer { kNone, kStay, kLeave };

/// In the middle of `body`, over everything but WAVE OFF: what the vehicle will do alone, and three
/// buttons: "leave/wave_off" comes first, "leave/stay" (also Escape), "leave/leave".
LeaveAnswer DrawLeaveDialog(const Rect& body, const std::string& what_the_vehicle_does,
                            UiFrame& ui);

}  // namespace palace
