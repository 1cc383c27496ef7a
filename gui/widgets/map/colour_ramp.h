// Colour ramps of the maps, for colour bars. Stops are even; the pictures themselves use 256 steps.
#pragma once

#include <vector>

#include <imgui.h>

#include "gui/widgets/draw.h"

namespace palace {

enum class Ramp { kElevation, kSlope, kRoughness, kCost, kSafeDistance };

/// Even stops of viridis, cividis, magma, inferno and the safe-distance blues (dark = far).
const std::vector<ImU32>& RampStops(Ramp ramp);
/// Horizontal bar from 0 (left) to 1 (right).
void DrawRampBar(ImDrawList* dl, const Rect& rect, Ramp ramp);

}  // namespace palace
