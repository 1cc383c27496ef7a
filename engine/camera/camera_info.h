// What a camera model is, in words and units.
#pragma once

#include <string>

#include "engine/camera/camera_model.h"

namespace palace {

/// Lines for a person: family, size, focal lengths, centre, angle of rows and columns, field of
/// view, distortion at the corners, place and axis. What needs a size says so where there is none.
std::string CameraInfoText(const CameraModel& model);

}  // namespace palace
