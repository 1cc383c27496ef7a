// Correlations of two grey maps, each off its local means, for whole-cell shifts. Internal to the
// SLAD room.
//
//   rho(shift) = sum f m / sqrt(sum f^2 sum m^2)
//
// over the cells known in both, f of the frame, m of the mosaic at what the frame's cell is shifted
// to. Beyond the mosaic nothing is known.
//
// Source: Lewis 1995 (normalised correlation). Deviation: means are local and taken out before.
#pragma once

#include <optional>

#include "engine/model/grid.h"

namespace palace {

/// Grey off its local mean, 0 where unknown, and where it is known (1 or 0).
struct GreyDetail {
  GridF off, known;
};

struct CellShift {
  int rows = 0, cols = 0;  ///< what is at (r, c) of the frame lies at (r + rows, c + cols)
};

/// For the shifts around one; -1 with too little in common. Rows of shifts are shared among
/// threads, whose number changes no bit.
class ShiftCorrelations {
 public:
  /// For `reach` cells each way from `middle`. Frame and mosaic are of one size.
  ShiftCorrelations(const GreyDetail& frame, const GreyDetail& mosaic, const CellShift& middle,
                    int reach, int least_common);

  double At(const CellShift& shift) const {
    return of_.at(shift.rows - middle_.rows + reach_, shift.cols - middle_.cols + reach_);
  }

  /// The first of the best in the order of rows and columns, `reach` each way from the middle;
  /// empty where none has enough in common.
  std::optional<CellShift> Best(int reach) const;

 private:
  CellShift middle_;
  int reach_;
  Grid<double> of_;
};

}  // namespace palace
