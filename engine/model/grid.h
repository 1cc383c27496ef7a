// Map grids. Rows run north to south, columns west to east: cell (0,0) is the north-west corner.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "engine/core/check.h"

namespace palace {

struct Cell {
  int row = 0;
  int col = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Where a grid lies in W. X is north and runs along rows, Y is east and runs along columns.
struct GridGeometry {
  int rows = 0;
  int cols = 0;
  double cell_m = 0;       ///< side of a square cell
  double north_min_m = 0;  ///< southern edge of the last row
  double east_min_m = 0;   ///< western edge of column 0

  friend bool operator==(const GridGeometry&, const GridGeometry&) = default;

  double north_max_m() const { return north_min_m + rows * cell_m; }
  double east_max_m() const { return east_min_m + cols * cell_m; }
  double NorthOfRow(double row) const { return north_min_m + (rows - 0.5 - row) * cell_m; }
  double EastOfCol(double col) const { return east_min_m + (col + 0.5) * cell_m; }
  bool Contains(Cell c) const { return c.row >= 0 && c.col >= 0 && c.row < rows && c.col < cols; }
  /// The cell that holds the point, or nothing outside the grid.
  std::optional<Cell> CellFromPoint(double north_m, double east_m) const {
    const double row = std::floor((north_max_m() - north_m) / cell_m);
    const double col = std::floor((east_m - east_min_m) / cell_m);
    if (!(row >= 0 && col >= 0 && row < rows && col < cols)) {
      return std::nullopt;
    }
    return Cell{static_cast<int>(row), static_cast<int>(col)};
  }
};

/// One layer of a map, row-major. Unknown is NaN in float layers.
template <typename T>
class Grid {
 public:
  Grid() = default;
  Grid(int rows, int cols, T fill = T{}) : rows_(rows), cols_(cols) {
    PALACE_CHECK(rows >= 0 && cols >= 0, rows, cols);
    cells_.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols), fill);
  }
  int rows() const { return rows_; }
  int cols() const { return cols_; }
  bool empty() const { return cells_.empty(); }
  T& at(int row, int col) { return cells_[Offset(row, col)]; }
  const T& at(int row, int col) const { return cells_[Offset(row, col)]; }
  T& at(Cell c) { return at(c.row, c.col); }
  const T& at(Cell c) const { return at(c.row, c.col); }
  T* row(int r) { return cells_.data() + Offset(r, 0); }
  const T* row(int r) const { return cells_.data() + Offset(r, 0); }
  const std::vector<T>& cells() const { return cells_; }
  std::vector<T>& cells() { return cells_; }

 private:
  std::size_t Offset(int row, int col) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
           static_cast<std::size_t>(col);
  }
  int rows_ = 0;
  int cols_ = 0;
  std::vector<T> cells_;
};

using GridF = Grid<float>;
inline constexpr float kUnknownValue = std::numeric_limits<float>::quiet_NaN();

/// A layer of `from` as it lies in `to`, `fill` where it does not reach. Both have the same cells,
/// whole cells apart; of cells of another size nothing is kept, nor of an empty layer.
template <typename T>
Grid<T> MovedTo(const GridGeometry& to, const GridGeometry& from, const Grid<T>& layer,
                T fill = T{}) {
  Grid<T> moved(to.rows, to.cols, fill);
  if (layer.empty() || from.cell_m != to.cell_m) {
    return moved;
  }
  const int down =
      static_cast<int>(std::lround((from.north_max_m() - to.north_max_m()) / to.cell_m));
  const int right = static_cast<int>(std::lround((to.east_min_m - from.east_min_m) / to.cell_m));
  for (int r = std::max(0, -down); r < std::min(to.rows, from.rows - down); ++r) {
    for (int c = std::max(0, -right); c < std::min(to.cols, from.cols - right); ++c) {
      moved.at(r, c) = layer.at(r + down, c + right);
    }
  }
  return moved;
}

}  // namespace palace
