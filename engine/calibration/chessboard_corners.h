// Inner corners of a chessboard.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/core/result.h"
#include "engine/model/image.h"

namespace palace {

/// columns x rows corners, row by row, right-handed in the picture; which end comes first is
/// arbitrary. All must be seen. Each is refined to a few hundredths of a pixel in a window that
/// holds no other corner. A part of a larger board is refused (chessboard_extent.h). An error says
/// how many corners were seen instead, where that is known. Source: OpenCV's findChessboardCorners
/// and cornerSubPix (Foerstner & Guelch 1987).
Result<std::vector<Eigen::Vector2d>> FindChessboardCorners(const ImageU8& picture, int columns,
                                                           int rows);

}  // namespace palace
