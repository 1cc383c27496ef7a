// The pictures that `evaluate position-estimate` looks at: the vehicle's own, and their middle rows
// in the height of the thesis's.
#pragma once

#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/image.h"
#include "engine/model/range_map.h"

namespace palace {

/// One camera's picture with its ranges.
struct MeasuredPicture {
  ImageU8 left;
  PinholeCamera camera;
  RangeMap range;
};

/// Heights that are looked at, the camera's own first, then the thesis's 240 unless that is it.
/// Error: a camera of fewer rows.
Result<std::vector<int>> PictureHeights(const PinholeCamera& camera);
/// "640x240".
std::string PictureSizeText(int width, int height);

/// The middle rows, at most as many as there are, and the camera that would have taken them alone.
PinholeCamera MiddleRows(const PinholeCamera& camera, int rows);
MeasuredPicture MiddleRows(const MeasuredPicture& picture, int rows);

}  // namespace palace
