// How large the chessboard is on which some inner corners were found: a search for 8 x 6 corners
// also succeeds on a part of a 9 x 6 board, and then counts from another corner in every picture.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/model/image.h"

namespace palace {

struct ChessboardExtent {
  int columns = 0;  ///< inner corners, the found ones included
  int rows = 0;
};

/// The found grid (columns x rows pixels, row by row) and what goes on beyond its four sides. The
/// squares next to the outermost corners always exist; those after them are squares only when more
/// corners follow, and otherwise the board's plain margin. They are looked up through the
/// homography of the nearest corners and count as squares when their greys alternate by more than
/// half the contrast of the squares inside; they may be cut to half a square. A side with fewer
/// than four such places inside the picture is taken as the board's end.
ChessboardExtent ExtentOfChessboard(const ImageU8& picture,
                                    const std::vector<Eigen::Vector2d>& corners, int columns,
                                    int rows);

}  // namespace palace
