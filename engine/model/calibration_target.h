// The flat target that cameras are calibrated with: a grid of dots or a chessboard.
//
//   p_T(column, row) = (column, row, 0) pitch      index = row columns + column
//
// Frame T: x along the columns, y along the rows, z into the board as a viewer sees it, origin at
// the first point. A point is a dot's centre, or an inner corner of the chessboard.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Dense>

namespace palace {

enum class TargetKind { kDots, kChessboard };

struct GridPlace {
  int column = 0;
  int row = 0;
  friend bool operator==(const GridPlace&, const GridPlace&) = default;
};

struct CalibrationTarget {
  TargetKind kind = TargetKind::kDots;
  int columns = 0;  ///< dots or inner corners along x
  int rows = 0;
  double pitch_m = 0;            ///< from point to point, both ways
  double dot_diameter_m = 0;     ///< dots only
  double mark_diameter_m = 0;    ///< of the larger dots that tell which way round; 0 without marks
  std::vector<GridPlace> marks;  ///< which dots are larger; no turn of the board repeats them

  int point_count() const { return columns * rows; }
  Eigen::Vector3d p_TQ(int index) const {
    return {pitch_m * (index % columns), pitch_m * (index / columns), 0};
  }
  /// 0 on a chessboard, whose points have no size.
  double DotDiameter_m(int index) const {
    for (const GridPlace& mark : marks) {
      if (mark.row * columns + mark.column == index) {
        return mark_diameter_m;
      }
    }
    return kind == TargetKind::kDots ? dot_diameter_m : 0;
  }
};

}  // namespace palace
