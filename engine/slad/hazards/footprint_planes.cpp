// Robust weighted least-squares planes over the footprint around every cell, by moving sums.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/hazards/plane_fit.h"
#include "engine/slad/side_by_side.h"

namespace palace {
namespace {

constexpr double kLeastHalf_cells = 2;  // of the window: of nine cells no fit is robust
constexpr int kPasses = 3;
/// Stereo's windows share their error over about this length: farther cells err by themselves.
constexpr double kCorrelationLength_m = 0.6;
/// Sums slide down stripes of so many rows, however many threads share them.
constexpr int kStripeRows = 32;
/// Columns whose sums are kept at hand while they slide down.
constexpr int kTileColumns = 128;

/// A stripe's columns first .. end - 1.
struct Tile {
  int first_row, end_row, first, end;
};

class FootprintFit {
 public:
  /// `leave_out`: cells with this flag are no ground; null: all are.
  FootprintFit(const ElevationMap& map, double diameter_m, const Grid<std::uint8_t>* leave_out,
               FootprintPlanes& out)
      : map_(map),
        leave_out_(leave_out),
        rows_(map.geometry.rows),
        cols_(map.geometry.cols),
        tiles_across_((cols_ + kTileColumns - 1) / kTileColumns),
        out_(out),
        full_weight_(rows_, cols_ + kLaneSlack, 0.0F),
        height_m_(rows_, cols_ + kLaneSlack, 0.0F),
        variance_m2_(rows_, cols_ + kLaneSlack, 0.0F),
        plane_m_(rows_, cols_ + kLaneSlack, kUnknownValue),
        scatter_m_(rows_, cols_ + kLaneSlack, 0.0F),
        changed_(rows_, tiles_across_, 1) {
    // Half side of the square with the circle's area, in whole cells; wider than the map is the
    // whole map.
    const double side = diameter_m * std::sqrt(M_PI) / 2 / map.geometry.cell_m;
    const double widest = std::max(rows_, cols_);
    half_ = static_cast<int>(std::clamp(std::round((side - 1) / 2), kLeastHalf_cells,
                                        std::max(kLeastHalf_cells, widest)));
    double sum = 0;
    int count = 0;
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < cols_; ++c) {
        if (Counts(r, c)) {
          sum += static_cast<double>(map.height_m.at(r, c));
          ++count;
        }
      }
    }
    reference_m_ = static_cast<float>(count > 0 ? sum / count : 0);
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < cols_; ++c) {
        if (Counts(r, c)) {
          height_m_.at(r, c) = map.height_m.at(r, c) - reference_m_;
          variance_m2_.at(r, c) = map.variance_m2.at(r, c);
          full_weight_.at(r, c) = FullWeight(variance_m2_.at(r, c));
        }
      }
    }
    weight_ = full_weight_;
  }

  int tiles() const { return tiles_across_ * ((rows_ + kStripeRows - 1) / kStripeRows); }

  /// One pass over a tile; leaves heights above the reference and gradients per cell. Sums of
  /// columns slide down the stripe; along each row the window adds those sums up. Where no weight
  /// has changed since the pass before, sums and planes are the same: they stay.
  void Solve(int index) {
    const Tile tile = At(index);
    const int first_new = FirstChanged(tile) - half_;
    if (first_new >= tile.end_row) {
      return;
    }
    const int west = std::max(0, tile.first - half_), east = std::min(cols_, tile.end + half_);
    const int width = tile.end - tile.first;
    const int pitch = (width + kSolveRun - 1) / kSolveRun * kSolveRun + 2 * half_ + kLaneSlack;
    std::vector<double> columns(static_cast<std::size_t>(kMoments * pitch), 0.0);
    std::vector<double> work(static_cast<std::size_t>(kSolveRun + 2 * half_));
    double* middle = columns.data() + half_;
    std::vector<MomentRow> rows;
    const auto take = [&](int r, double sign) {
      if (r >= 0 && r < rows_) {
        rows.push_back({weight_.row(r) + west, height_m_.row(r) + west, variance_m2_.row(r) + west,
                        static_cast<double>(r - rows_ / 2), sign});
      }
    };
    for (int r = tile.first_row - half_; r < tile.first_row + half_; ++r) {
      take(r, 1);
    }
    for (int r = tile.first_row; r < tile.end_row; ++r) {
      take(r + half_, 1);
      if (r > tile.first_row) {
        take(r - half_ - 1, -1);
      }
      loops_.add_moments(rows.data(), static_cast<int>(rows.size()), west - cols_ / 2, east - west,
                         pitch, middle + west - tile.first);
      rows.clear();
      if (r >= first_new) {
        const auto at = [&](GridF& layer) { return layer.row(r) + tile.first; };
        loops_.solve_moments(
            middle, pitch, half_, tile.first - cols_ / 2, r - rows_ / 2, width, work.data(),
            {at(plane_m_), at(out_.plane.east_gradient), at(out_.plane.north_gradient),
             at(scatter_m_), at(out_.gradient_sigma), at(out_.cell_variance_m2)});
      }
    }
  }
  /// Between two passes.
  void RejectOutliers(int index) {
    const Tile tile = At(index);
    for (int r = tile.first_row; r < tile.end_row; ++r) {
      const auto at = [&](const GridF& layer) { return layer.row(r) + tile.first; };
      changed_.at(r, tile.first / kTileColumns) = loops_.reject_outliers(
          {at(full_weight_), at(height_m_), at(variance_m2_), at(plane_m_), at(scatter_m_)},
          tile.end - tile.first, weight_.row(r) + tile.first);
    }
  }
  /// After the last pass: heights and gradients in metres.
  void Finish(int index) {
    const Tile tile = At(index);
    const double cell = map_.geometry.cell_m;
    const float cell_m = static_cast<float>(cell);
    // The loops take kCorrelatedCells for granted.
    const double correlated =
        std::clamp(std::pow(kCorrelationLength_m / cell, 2), 1.0, kCorrelatedCells);
    const float sigma_scale = static_cast<float>(std::sqrt(correlated / kCorrelatedCells)) / cell_m;
    for (int r = tile.first_row; r < tile.end_row; ++r) {
      const float* measured_m = map_.height_m.row(r);
      const float* plane_m = plane_m_.row(r);
      float* height_m = out_.plane.height_m.row(r);
      float* residual_m = out_.plane.residual_m.row(r);
      float* east = out_.plane.east_gradient.row(r);
      float* south_then_north = out_.plane.north_gradient.row(r);
      float* sigma = out_.gradient_sigma.row(r);
      for (int c = tile.first; c < tile.end; ++c) {
        residual_m[c] = (measured_m[c] - reference_m_) - plane_m[c];
        height_m[c] = plane_m[c] + reference_m_;
        east[c] /= cell_m;
        south_then_north[c] /= -cell_m;
        sigma[c] *= sigma_scale;
      }
    }
  }

 private:
  Tile At(int index) const {
    const int row = index / tiles_across_ * kStripeRows, col = index % tiles_across_ * kTileColumns;
    return {row, std::min(rows_, row + kStripeRows), col, std::min(cols_, col + kTileColumns)};
  }
  bool Counts(int r, int c) const {
    return map_.state.at(r, c) == CellState::kMeasured &&
           (leave_out_ == nullptr || (leave_out_->at(r, c) & kFlagElevated) == 0);
  }
  static float FullWeight(float variance_m2) {
    constexpr float kFloor = static_cast<float>(kVarianceFloor_m2);
    return kFloor / (variance_m2 + kFloor);
  }
  /// The first row that the tile's sums reach, from its first stripe on, where a weight has
  /// changed; far below the map when none has.
  int FirstChanged(const Tile& tile) const {
    const int west = std::max(0, tile.first - half_) / kTileColumns;
    const int east = (std::min(cols_, tile.end + half_) - 1) / kTileColumns;
    const int end = std::min(rows_, tile.end_row + half_);
    for (int r = std::max(0, tile.first_row - half_); r < end; ++r) {
      const std::uint8_t* changed = changed_.row(r);
      if (std::any_of(changed + west, changed + east + 1, [](std::uint8_t c) { return c != 0; })) {
        return r;
      }
    }
    return end + half_;
  }

  const ElevationMap& map_;
  const Grid<std::uint8_t>* leave_out_;
  int rows_, cols_, tiles_across_;
  FootprintPlanes& out_;
  int half_ = 1;
  float reference_m_ = 0;
  GridF full_weight_, weight_, height_m_, variance_m2_;  ///< kLaneSlack wider; 0: no ground
  GridF plane_m_, scatter_m_;
  Grid<std::uint8_t> changed_;  ///< a weight of a row of a tile, since the pass before
  const SladLoops& loops_ = FastestSladLoops();
};

/// Passes of the fits over one map, their tiles side by side: a map of few tiles keeps all threads
/// busy that way. The second is there where something is raised.
void Run(FootprintFit& first, FootprintFit* second) {
  const int tiles = first.tiles();
  const auto in_all = [&](void (FootprintFit::*step)(int)) {
    ForEach(second != nullptr ? 2 * tiles : tiles,
            [&](int job) { ((job < tiles ? first : *second).*step)(job % tiles); });
  };
  in_all(&FootprintFit::Solve);
  for (int pass = 1; pass < kPasses; ++pass) {
    in_all(&FootprintFit::RejectOutliers);
    in_all(&FootprintFit::Solve);
  }
  in_all(&FootprintFit::Finish);
}

FootprintPlanes UnknownPlanes(const GridGeometry& geometry) {
  const auto unknown = [&] { return GridF(geometry.rows, geometry.cols, kUnknownValue); };
  return {{unknown(), unknown(), unknown(), unknown()}, unknown(), unknown()};
}

/// Beside a raised surface the ground keeps its own plane, wherever it spans one. What is raised,
/// and where it spans none, is taken over from the planes through all cells.
void TakeWhereNoGround(const FootprintPlanes& all, const Grid<std::uint8_t>& flags,
                       FootprintPlanes& ground) {
  ForEach(flags.rows(), [&](int r) {
    const std::uint8_t* flag = flags.row(r);
    for (int c = 0; c < flags.cols(); ++c) {
      if ((flag[c] & kFlagElevated) == 0 && !std::isnan(ground.plane.height_m.at(r, c))) {
        continue;
      }
      ground.plane.height_m.at(r, c) = all.plane.height_m.at(r, c);
      ground.plane.residual_m.at(r, c) = all.plane.residual_m.at(r, c);
      ground.plane.north_gradient.at(r, c) = all.plane.north_gradient.at(r, c);
      ground.plane.east_gradient.at(r, c) = all.plane.east_gradient.at(r, c);
      ground.gradient_sigma.at(r, c) = all.gradient_sigma.at(r, c);
      ground.cell_variance_m2.at(r, c) = all.cell_variance_m2.at(r, c);
    }
  });
}

}  // namespace

FootprintPlanes FitFootprintPlanes(const ElevationMap& map, double footprint_diameter_m,
                                   const Grid<std::uint8_t>& flags) {
  if (map.height_m.empty()) {
    return {};
  }
  const bool any_raised = std::any_of(flags.cells().begin(), flags.cells().end(),
                                      [](std::uint8_t f) { return (f & kFlagElevated) != 0; });
  FootprintPlanes planes, ground;
  std::optional<FootprintFit> fit, fit_of_ground;
  SideBySide({[&] {
                planes = UnknownPlanes(map.geometry);
                fit.emplace(map, footprint_diameter_m, nullptr, planes);
              },
              [&] {
                if (any_raised) {
                  ground = UnknownPlanes(map.geometry);
                  fit_of_ground.emplace(map, footprint_diameter_m, &flags, ground);
                }
              }});
  Run(*fit, any_raised ? &*fit_of_ground : nullptr);
  if (!any_raised) {
    return planes;
  }
  TakeWhereNoGround(planes, flags, ground);
  return ground;
}

}  // namespace palace
