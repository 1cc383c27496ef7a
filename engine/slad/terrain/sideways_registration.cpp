#include "engine/slad/terrain/sideways_registration.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/check.h"
#include "engine/slad/side_by_side.h"
#include "engine/slad/terrain/shift_correlations.h"

namespace palace {
namespace {

constexpr int kPerCell = 3;          // mosaic cells along a map cell
constexpr int kLocal_cells = 4;      // half width of the local mean
constexpr double kFarthest_m = 0.4;  // how far is looked
constexpr double kLeastCorrelation = 0.3;
constexpr int kLeastCommon_cells = 1500;

GridGeometry Finer(const GridGeometry& map) {
  return {map.rows * kPerCell, map.cols * kPerCell, map.cell_m / kPerCell, map.north_min_m,
          map.east_min_m};
}

/// Mean grey of the pixels with a range, per cell; NaN where none falls.
GridF GreyFromAbove(const RangeMap& range, const ImageU8& left, const GridGeometry& g) {
  const RigidTransform& X_WC = range.pose->X_WC;
  const PinholeCamera& camera = range.camera;
  const Eigen::Vector3d step_W = X_WC.R.col(0) / camera.fx_px;
  constexpr Cell kNone{-1, -1};
  Image<Cell> cell_of(left.width(), left.height(), kNone);
  ForEach(left.height(), [&](int y) {
    const Eigen::Vector3d row_W = X_WC.R * Eigen::Vector3d(-camera.cx_px / camera.fx_px,
                                                           (y - camera.cy_px) / camera.fy_px, 1);
    for (int x = 0; x < left.width(); ++x) {
      const auto z = static_cast<double>(range.depth_m.at(x, y));
      if (z > 0 && std::isfinite(z)) {
        const Eigen::Vector3d p_W = X_WC.p + z * (row_W + x * step_W);
        cell_of.at(x, y) = g.CellFromPoint(p_W.x(), p_W.y()).value_or(kNone);
      }
    }
  });
  GridF sum(g.rows, g.cols, 0.0F), count(g.rows, g.cols, 0.0F);
  for (std::size_t i = 0; i < cell_of.pixels().size(); ++i) {
    const Cell& cell = cell_of.pixels()[i];
    if (cell.row >= 0) {
      sum.at(cell) += static_cast<float>(left.pixels()[i]);
      count.at(cell) += 1;
    }
  }
  for (std::size_t i = 0; i < sum.cells().size(); ++i) {
    float& grey = sum.cells()[i];
    grey = count.cells()[i] > 0 ? grey / count.cells()[i] : kUnknownValue;
  }
  return sum;
}

/// Sums over squares of half width kLocal_cells, by way of running sums.
GridF SquareSums(const GridF& values) {
  const int rows = values.rows(), cols = values.cols();
  GridF along(rows, cols, 0.0F), sums(rows, cols, 0.0F);
  for (int r = 0; r < rows; ++r) {
    double run = 0;
    for (int c = -kLocal_cells; c < cols; ++c) {
      run += c + kLocal_cells < cols ? static_cast<double>(values.at(r, c + kLocal_cells)) : 0.0;
      run -=
          c - kLocal_cells - 1 >= 0 ? static_cast<double>(values.at(r, c - kLocal_cells - 1)) : 0.0;
      if (c >= 0) {
        along.at(r, c) = static_cast<float>(run);
      }
    }
  }
  std::vector<double> run(static_cast<std::size_t>(cols), 0.0);
  const auto add_row = [&](int r, double times) {
    for (int c = 0; r >= 0 && r < rows && c < cols; ++c) {
      run[static_cast<std::size_t>(c)] += times * static_cast<double>(along.at(r, c));
    }
  };
  for (int r = -kLocal_cells; r < rows; ++r) {
    add_row(r + kLocal_cells, 1);
    add_row(r - kLocal_cells - 1, -1);
    for (int c = 0; r >= 0 && c < cols; ++c) {
      sums.at(r, c) = static_cast<float>(run[static_cast<std::size_t>(c)]);
    }
  }
  return sums;
}

GreyDetail DetailOf(const GridF& grey) {
  GreyDetail detail{grey, GridF(grey.rows(), grey.cols(), 0.0F)};
  for (std::size_t i = 0; i < grey.cells().size(); ++i) {
    const bool known = !std::isnan(grey.cells()[i]);
    detail.known.cells()[i] = known ? 1.0F : 0.0F;
    detail.off.cells()[i] = known ? grey.cells()[i] : 0.0F;
  }
  const GridF sums = SquareSums(detail.off), counts = SquareSums(detail.known);
  for (std::size_t i = 0; i < grey.cells().size(); ++i) {
    float& off = detail.off.cells()[i];
    off = detail.known.cells()[i] > 0 ? off - sums.cells()[i] / counts.cells()[i] : 0.0F;
  }
  return detail;
}

/// Two by two cells as one, known where any is.
GreyDetail Coarser(const GreyDetail& fine) {
  const int rows = fine.off.rows() / 2, cols = fine.off.cols() / 2;
  GreyDetail coarse{GridF(rows, cols, 0.0F), GridF(rows, cols, 0.0F)};
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      float sum = 0, count = 0;
      for (const auto& [dr, dc] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) {
        sum += fine.off.at(2 * r + dr, 2 * c + dc);
        count += fine.known.at(2 * r + dr, 2 * c + dc);
      }
      coarse.off.at(r, c) = count > 0 ? sum / count : 0.0F;
      coarse.known.at(r, c) = count > 0 ? 1.0F : 0.0F;
    }
  }
  return coarse;
}

/// Vertex of the parabola through the peak and the values beside it, in cells.
double Vertex(double before, double peak, double after) {
  const double bend = before - 2 * peak + after;
  return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

}  // namespace

void SidewaysRegistration::MoveTo(const GridGeometry& fine) {
  grey_ = MovedTo(fine, geometry_, grey_, kUnknownValue);
  frames_ = MovedTo(fine, geometry_, frames_);
  geometry_ = fine;
}

void SidewaysRegistration::Follow(const Eigen::Vector2d& by_m) {
  followed_m_ += by_m;
  const double cell_m = geometry_.cell_m;
  const double north = std::trunc(followed_m_.x() / cell_m),
               east = std::trunc(followed_m_.y() / cell_m);
  if (north == 0 && east == 0) {
    return;
  }
  const GridGeometry stays = geometry_;
  geometry_.north_min_m += north * cell_m;
  geometry_.east_min_m += east * cell_m;
  followed_m_ -= cell_m * Eigen::Vector2d(north, east);
  MoveTo(stays);
}

SidewaysRegistration::Shift SidewaysRegistration::Add(const RangeMap& range, const ImageU8& left,
                                                      const GridGeometry& geometry,
                                                      int frames_fused) {
  PALACE_CHECK(range.pose.has_value() && left.width() == range.depth_m.width() &&
               left.height() == range.depth_m.height());
  const bool first = grey_.empty();
  if (const GridGeometry fine = Finer(geometry); !(fine == geometry_)) {
    MoveTo(fine);
  }
  GridF seen = GreyFromAbove(range, left, geometry_);
  Shift shift;
  CellShift whole;
  Eigen::Vector2d follow_m = Eigen::Vector2d::Zero();
  if (!first) {
    GreyDetail frame, mosaic;
    SideBySide({[&] { frame = DetailOf(seen); }, [&] { mosaic = DetailOf(grey_); }});
    const int reach = static_cast<int>(std::ceil(kFarthest_m / (2 * geometry_.cell_m)));
    const CellShift coarse =
        ShiftCorrelations(Coarser(frame), Coarser(mosaic), {}, reach, kLeastCommon_cells / 4)
            .Best(reach)
            .value_or(CellShift{});
    // A cell each way is asked, and beside it what the parabolas need.
    const ShiftCorrelations fine(frame, mosaic, {2 * coarse.rows, 2 * coarse.cols}, 2,
                                 kLeastCommon_cells);
    const std::optional<CellShift> peak = fine.Best(1);
    if (peak && fine.At(*peak) >= kLeastCorrelation) {
      const auto at = [&](int dr, int dc) { return fine.At({peak->rows + dr, peak->cols + dc}); };
      const double down = peak->rows + Vertex(at(-1, 0), at(0, 0), at(1, 0));
      const double right = peak->cols + Vertex(at(0, -1), at(0, 0), at(0, 1));
      const double left_over = 1.0 / (1 + std::max(1, frames_fused));
      const Eigen::Vector2d to_map_m =
          geometry_.cell_m * Eigen::Vector2d(-down, right) + followed_m_;
      shift.by_m = (1 - left_over) * to_map_m;
      shift.told = true;
      whole = {static_cast<int>(std::lround(down)), static_cast<int>(std::lround(right))};
      follow_m = -left_over * to_map_m;
    }
  }
  const int memory = std::max(1, frames_fused);
  for (int r = 0; r < seen.rows(); ++r) {
    for (int c = 0; c < seen.cols(); ++c) {
      const Cell to{r + whole.rows, c + whole.cols};
      const float grey = seen.at(r, c);
      if (std::isnan(grey) || !geometry_.Contains(to)) {
        continue;
      }
      std::uint16_t& frames = frames_.at(to);
      frames = static_cast<std::uint16_t>(std::min<int>(frames + 1, memory));
      float& mean = grey_.at(to);
      mean = frames == 1 ? grey : mean + (grey - mean) / static_cast<float>(frames);
    }
  }
  Follow(follow_m);
  return shift;
}

}  // namespace palace
