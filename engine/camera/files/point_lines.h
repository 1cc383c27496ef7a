// Lists of points and pixels through a camera, as text.
#pragma once

#include <istream>
#include <string>

#include "engine/camera/camera_model.h"
#include "engine/core/result.h"

namespace palace {

/// Lines `X,Y,Z` to lines `x,y` with 17 digits, or `invalid` where the model has no pixel. Numbers
/// may be separated by commas, semicolons or blanks. Blank lines, '#' comments and one header line
/// are left out. A line that is not three finite numbers ends it with an error naming `name` and
/// line.
Result<std::string> ProjectPoints(const CameraModel& model, std::istream& in,
                                  const std::string& name);
/// Lines `x,y` to lines `ox,oy,oz,rx,ry,rz` (ray origin and unit direction) or `invalid`.
Result<std::string> BackProjectPixels(const CameraModel& model, std::istream& in,
                                      const std::string& name);

}  // namespace palace
