// Contour of the safe area in a verdict picture.
#pragma once

#include <vector>

#include <imgui.h>

#include "engine/model/image.h"

namespace palace {

/// Lines between safe (1) and not safe (0, 2) pixels by marching squares, joined into chains, in
/// pixel coordinates (pixel centres are whole). Unknown pixels connected to the picture's rim are
/// the end of the map, not a hazard: no line is drawn along them.
/// Lorensen & Cline 1987 in two dimensions; the ambiguous saddles keep safe pixels apart.
std::vector<std::vector<ImVec2>> SafeContours(const ImageU8& verdict);

}  // namespace palace
