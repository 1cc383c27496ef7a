#include "engine/calibration/target_detection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "engine/calibration/chessboard_corners.h"
#include "engine/calibration/dot_finder.h"
#include "engine/calibration/dot_lattice.h"
#include "engine/calibration/grid_dots.h"
#include "engine/core/median.h"
#include "engine/core/text.h"

namespace palace {
namespace {

constexpr double kMostPixels = 1e8;
constexpr int kLeastSide_px = 16;
constexpr std::array<int, 5> kWindowsPerSide = {16, 8, 32, 4, 64};  // the usual first
constexpr int kLeastWindow_px = 9;
constexpr double kClutterRow = 0.5;  // a row outside the target this full belongs to a larger board

/// The target's place on a lattice: index = (i - i0) + (j - j0) columns after `quarters` turns.
struct Placement {
  int quarters = 0;
  int i0 = 0;
  int j0 = 0;
};

std::string GridText(int columns, int rows) {
  return std::to_string(columns) + " x " + std::to_string(rows);
}

int CountInside(const DotLattice& lattice, const CalibrationTarget& target, int i0, int j0) {
  return static_cast<int>(std::count_if(lattice.begin(), lattice.end(), [&](const auto& entry) {
    return OnGrid(target, entry.first.first - i0, entry.first.second - j0);
  }));
}

/// True when a column or row outside the target's window is full enough to be one of a board.
bool LargerThan(const DotLattice& lattice, const CalibrationTarget& target, int i0, int j0) {
  std::map<int, int> columns, rows;
  for (const auto& [place, dot] : lattice) {
    const int c = place.first - i0, r = place.second - j0;
    if ((c < 0 || c >= target.columns) && r >= 0 && r < target.rows) {
      ++columns[c];
    }
    if ((r < 0 || r >= target.rows) && c >= 0 && c < target.columns) {
      ++rows[r];
    }
  }
  const auto full = [](const std::map<int, int>& counts, int length) {
    return std::any_of(counts.begin(), counts.end(),
                       [&](const auto& entry) { return entry.second > kClutterRow * length; });
  };
  return full(columns, target.rows) || full(rows, target.columns);
}

/// Without marks the extent places the target: the one window of its size that holds the most.
Result<Placement> PlaceByExtent(const DotLattice& lattice, const CalibrationTarget& target) {
  const LatticeExtent seen = ExtentOf(lattice);
  const Error mismatch = InvalidError(
      "found " +
      GridText(std::max(seen.columns(), seen.rows()), std::min(seen.columns(), seen.rows())) +
      " dots, the target has " + GridText(target.columns, target.rows) +
      "; the board must be whole in the picture, and TARGET.toml must describe it");
  std::optional<Placement> best;
  int most = 0, second = 0;
  for (const int quarters : {0, 1}) {
    if (quarters == 1 && target.columns == target.rows) {
      break;
    }
    const DotLattice turned = TurnLattice(lattice, quarters);
    const LatticeExtent extent = ExtentOf(turned);
    for (int i0 = extent.i_min; i0 + target.columns - 1 <= extent.i_max; ++i0) {
      for (int j0 = extent.j_min; j0 + target.rows - 1 <= extent.j_max; ++j0) {
        const int count = CountInside(turned, target, i0, j0);
        if (count > most) {
          second = most;
          most = count;
          best = Placement{quarters, i0, j0};
        } else {
          second = std::max(second, count);
        }
      }
    }
  }
  if (!best || 4 * most < target.point_count()) {
    return mismatch;
  }
  if (LargerThan(TurnLattice(lattice, best->quarters), target, best->i0, best->j0)) {
    return mismatch;
  }
  if (second == most) {
    return InvalidError("the grid's place is ambiguous: " + GridText(seen.columns(), seen.rows()) +
                        " dots with gaps; show every border row and column, or use a target with "
                        "orientation marks");
  }
  return *best;
}

/// Marks are larger than the dots round them.
std::vector<std::pair<int, int>> LargeDots(const DotLattice& lattice, const std::vector<Dot>& dots,
                                           double least_ratio) {
  std::vector<std::pair<int, int>> large;
  for (const auto& [place, dot] : lattice) {
    std::vector<double> around;
    for (int i = -2; i <= 2; ++i) {
      for (int j = -2; j <= 2; ++j) {
        const auto found = lattice.find({place.first + i, place.second + j});
        if ((i != 0 || j != 0) && found != lattice.end()) {
          around.push_back(dots[found->second].area_px);
        }
      }
    }
    if (around.size() < 4) {
      continue;
    }
    if (dots[dot].area_px > least_ratio * UpperMedian(around)) {
      large.push_back(place);
    }
  }
  return large;
}

/// With marks: the one turn and shift that lays the target's marks on the large dots.
Result<Placement> PlaceByMarks(const DotLattice& lattice, const std::vector<Dot>& dots,
                               const CalibrationTarget& target) {
  const double least_ratio = target.mark_diameter_m / target.dot_diameter_m;  // of areas: half way
  std::optional<Placement> best;
  int fits = 0;
  std::size_t large_count = 0;
  for (int quarters = 0; quarters < 4; ++quarters) {
    const DotLattice turned = TurnLattice(lattice, quarters);
    const auto large = LargeDots(turned, dots, least_ratio);
    large_count = large.size();
    for (const auto& [i, j] : large) {
      const int i0 = i - target.marks[0].column, j0 = j - target.marks[0].row;
      const bool all =
          std::all_of(target.marks.begin(), target.marks.end(), [&](const GridPlace& mark) {
            return std::find(large.begin(), large.end(),
                             std::pair(i0 + mark.column, j0 + mark.row)) != large.end();
          });
      const int outside = static_cast<int>(lattice.size()) - CountInside(turned, target, i0, j0);
      if (all && 5 * outside <= static_cast<int>(lattice.size())) {
        best = Placement{quarters, i0, j0};
        ++fits;
      }
    }
  }
  if (fits != 1) {
    return InvalidError(
        "the orientation marks were " + std::string(fits == 0 ? "not found" : "found twice") +
        " among " + std::to_string(lattice.size()) + " dots (" + std::to_string(large_count) +
        " large ones, the target has " + std::to_string(target.marks.size()) +
        "); is the board covered or the picture mirrored, and does TARGET.toml describe it?");
  }
  if (LargerThan(TurnLattice(lattice, best->quarters), target, best->i0, best->j0)) {
    const LatticeExtent seen = ExtentOf(lattice);
    return InvalidError("found " + GridText(seen.columns(), seen.rows()) +
                        " dots, the target has " + GridText(target.columns, target.rows) +
                        "; TARGET.toml must describe the board");
  }
  return *best;
}

/// Direction of the target's x axis in the picture.
Eigen::Vector2d AxisInPicture(const CalibrationTarget& target, const TargetObservation& seen) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (const TargetPoint& point : seen) {
    const Eigen::Vector3d row(1, point.index % target.columns, point.index / target.columns);
    normal += row * row.transpose();
    right += row * point.pixel.transpose();
  }
  const Eigen::Matrix<double, 3, 2> plane = normal.ldlt().solve(right);
  return plane.row(1).transpose().normalized();
}

/// Renumbers a board turned by `quarters`; quarter turns need a square board.
TargetObservation Turned(const CalibrationTarget& target, const TargetObservation& seen,
                         int quarters) {
  TargetObservation turned = seen;
  for (TargetPoint& point : turned) {
    int column = point.index % target.columns, row = point.index / target.columns;
    for (int q = 0; q < quarters; ++q) {
      const int next = row;
      row = target.columns - 1 - column;
      column = next;
    }
    if (quarters == 2) {
      column = target.columns - 1 - point.index % target.columns;
      row = target.rows - 1 - point.index / target.columns;
    }
    point.index = row * target.columns + column;
  }
  return turned;
}

/// Of the turns that look alike, the one whose x axis is nearest to `direction`.
TargetObservation NearestTurn(const CalibrationTarget& target, const TargetObservation& seen,
                              const Eigen::Vector2d& direction) {
  TargetObservation best = seen;
  double most = AxisInPicture(target, seen).dot(direction);
  for (int quarters = 1; quarters < 4; ++quarters) {
    if (quarters != 2 && target.columns != target.rows) {
      continue;
    }
    TargetObservation turned = Turned(target, seen, quarters);
    const double along = AxisInPicture(target, turned).dot(direction);
    if (along > most + 1e-9) {
      most = along;
      best = std::move(turned);
    }
  }
  return best;
}

Result<TargetObservation> DetectChessboard(const ImageU8& picture,
                                           const CalibrationTarget& target) {
  const auto corners = FindChessboardCorners(picture, target.columns, target.rows);
  if (!corners) {
    return corners.error();
  }
  TargetObservation seen;
  for (std::size_t k = 0; k < corners->size(); ++k) {
    seen.push_back({static_cast<int>(k), (*corners)[k]});
  }
  return NearestTurn(target, seen, Eigen::Vector2d::UnitX());
}

/// A grid among the picture's dots. The largest over several sizes of window.
struct FoundGrid {
  std::vector<Dot> dots;
  DotLattice lattice;
};

/// With `keep_rough` also dots that RefineDot cannot measure count, at their pixel centres.
FoundGrid FindGrid(const ImageU8& picture, const CalibrationTarget& target, bool keep_rough) {
  FoundGrid best;
  for (const int per_side : kWindowsPerSide) {
    const int window_px = std::max(picture.width(), picture.height()) / per_side;
    if (window_px < kLeastWindow_px) {
      continue;
    }
    std::vector<Dot> found = FindDots(picture, window_px);
    std::erase_if(found, [&](Dot& dot) { return !RefineDot(picture, dot) && !keep_rough; });
    DotLattice grown = FindLattice(found);
    if (grown.size() > best.lattice.size()) {
      best = {std::move(found), std::move(grown)};
    }
    if (static_cast<int>(best.lattice.size()) >= target.point_count()) {
      break;
    }
  }
  return best;
}

Result<TargetObservation> PlaceGrid(const ImageU8& picture, const CalibrationTarget& target,
                                    const FoundGrid& grid) {
  if (grid.lattice.empty()) {
    return InvalidError("no grid of dots found, the target has " +
                        GridText(target.columns, target.rows) + " dark dots on a bright board");
  }
  const auto placement = target.marks.empty() ? PlaceByExtent(grid.lattice, target)
                                              : PlaceByMarks(grid.lattice, grid.dots, target);
  if (!placement) {
    return placement.error();
  }
  TargetObservation seen;
  std::map<int, double> areas_px;
  for (const auto& [place, dot] : TurnLattice(grid.lattice, placement->quarters)) {
    const int column = place.first - placement->i0, row = place.second - placement->j0;
    if (OnGrid(target, column, row)) {
      seen.push_back({row * target.columns + column, grid.dots[dot].centre});
      areas_px[seen.back().index] = grid.dots[dot].area_px;
    }
  }
  if (const Status size = CheckDotSize(target, seen, areas_px); !size) {
    return size.error();
  }
  seen = RefineOnGrid(picture, target, seen);
  return target.marks.empty() ? NearestTurn(target, seen, Eigen::Vector2d::UnitX()) : seen;
}

Result<TargetObservation> DetectDots(const ImageU8& picture, const CalibrationTarget& target) {
  auto seen = PlaceGrid(picture, target, FindGrid(picture, target, /*keep_rough=*/false));
  if (seen) {
    return seen;
  }
  // Dots near the board's edge may lack a bright ring on a first look; specks of noise lack it too,
  // so they are let in only when the grid is not whole without.
  auto with_rough = PlaceGrid(picture, target, FindGrid(picture, target, /*keep_rough=*/true));
  return with_rough ? with_rough : seen;
}

}  // namespace

Result<TargetObservation> DetectTarget(const ImageU8& picture, const CalibrationTarget& target) {
  if (picture.width() < kLeastSide_px || picture.height() < kLeastSide_px ||
      static_cast<double>(picture.width()) * picture.height() > kMostPixels) {
    return InvalidError("the picture is " + SizeText(picture.width(), picture.height()) +
                        "; sides from 16 px and at most 100 megapixels are searched");
  }
  return target.kind == TargetKind::kDots ? DetectDots(picture, target)
                                          : DetectChessboard(picture, target);
}

void MatchTurn(const CalibrationTarget& target, const TargetObservation& left,
               TargetObservation& right) {
  if (target.marks.empty() && !left.empty() && !right.empty()) {
    right = NearestTurn(target, right, AxisInPicture(target, left));
  }
}

}  // namespace palace
