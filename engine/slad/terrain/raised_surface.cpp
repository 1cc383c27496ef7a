#include "engine/slad/terrain/raised_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/side_by_side.h"

namespace palace {
namespace {

constexpr float kLeastRise_m = 0.3F;
constexpr float kRisePerRadius = 0.2F;
constexpr float kWalkableSlope = 0.3F;
constexpr float kSigmas = 3;
constexpr double kOpeningCell_m = 0.3;
constexpr std::array kRadii_m = {0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 11.0, 15.0, 20.0};
constexpr double kRimReach_m = 0.3;
constexpr double kLeastDropShare = 0.6;
constexpr double kLeastSeenShare = 0.4;

constexpr int kColumnsTogether = 64;
constexpr float kHigh = std::numeric_limits<float>::infinity();

/// Largest over the square of half width `half`; negative infinities do not count. Along the rows,
/// then down the columns: runs of 2, 4, 8 .. cells, then two overlapping runs that fill the window.
void SquareMaximum(int half, GridF& cells) {
  const SladLoops& loops = FastestSladLoops();
  const int rows = cells.rows(), cols = cells.cols(), width = 2 * half + 1;
  GridF tall(rows + 2 * half, cols, -kHigh);
  ForEach(rows, [&](int r) {
    std::vector<float> line(static_cast<std::size_t>(cols + 2 * half), -kHigh);
    std::vector<float> work(line.size());
    std::copy_n(cells.row(r), cols, line.data() + half);
    loops.window_maximum(line.data() + half, half, cols, work.data(), tall.row(r + half));
  });
  ForEach((cols + kColumnsTogether - 1) / kColumnsTogether, [&](int stripe) {
    const int first = stripe * kColumnsTogether, count = std::min(kColumnsTogether, cols - first);
    const auto merge = [&](const float* from, float* into) {
      for (int c = first; c < first + count; ++c) {
        into[c] = into[c] > from[c] ? into[c] : from[c];
      }
    };
    int run = 1;
    for (; 2 * run <= width; run *= 2) {
      for (int k = 0; k < rows + 2 * half - 2 * run + 1; ++k) {
        merge(tall.row(k + run), tall.row(k));
      }
    }
    for (int r = 0; r < rows; ++r) {
      std::copy_n(tall.row(r) + first, count, cells.row(r) + first);
      merge(tall.row(r + width - run), cells.row(r));
    }
  });
}

/// Opening: least, then largest of the least. Infinite heights are unknown and stay so.
void Open(int half, GridF& surface) {
  const GridF before = surface;
  for (float& height : surface.cells()) {
    height = -height;
  }
  SquareMaximum(half, surface);
  for (float& depth : surface.cells()) {
    depth = depth == -kHigh ? -kHigh : -depth;
  }
  SquareMaximum(half, surface);
  for (std::size_t i = 0; i < before.cells().size(); ++i) {
    surface.cells()[i] = before.cells()[i] == kHigh ? kHigh : surface.cells()[i];
  }
}

/// The map in cells of at least kOpeningCell_m.
struct CoarseMap {
  int block = 1;
  double cell_m = 0;
  GridF surface;  ///< highest of its cells; infinite where nothing is measured
  GridF noise_m;
};

CoarseMap Coarsened(const ElevationMap& map) {
  const int rows = map.geometry.rows, cols = map.geometry.cols;
  CoarseMap coarse;
  // A map of tiny cells is not coarser than its own size.
  const double wanted = std::floor(kOpeningCell_m / map.geometry.cell_m + 1e-6);
  coarse.block = static_cast<int>(std::clamp(wanted, 1.0, double(std::max(rows, cols))));
  coarse.cell_m = coarse.block * map.geometry.cell_m;
  const int coarse_rows = (rows + coarse.block - 1) / coarse.block;
  const int coarse_cols = (cols + coarse.block - 1) / coarse.block;
  coarse.surface = GridF(coarse_rows, coarse_cols, -kHigh);
  coarse.noise_m = GridF(coarse_rows, coarse_cols, 0);
  ForEach(coarse_rows, [&](int coarse_row) {
    float* highest_m = coarse.surface.row(coarse_row);
    float* noise_m = coarse.noise_m.row(coarse_row);  // the variance first
    const int end = std::min(rows, (coarse_row + 1) * coarse.block);
    for (int r = coarse_row * coarse.block; r < end; ++r) {
      const float* height_m = map.Measured().row(r);
      const float* variance_m2 = map.variance_m2.row(r);
      const CellState* state = map.state.row(r);
      for (int at = 0, c = 0; at < coarse_cols; ++at) {
        const int last = std::min(cols, c + coarse.block);
        for (; c < last; ++c) {
          // The highest, so that a surface that ends inside a coarse cell loses its whole height in
          // one opening. Infinite heights are not known.
          const bool higher = state[c] == CellState::kMeasured && height_m[c] > highest_m[at] &&
                              height_m[c] < kHigh;
          highest_m[at] = higher ? height_m[c] : highest_m[at];
          noise_m[at] = higher ? variance_m2[c] : noise_m[at];
        }
      }
    }
    for (int at = 0; at < coarse_cols; ++at) {
      const bool known = highest_m[at] > -kHigh;
      noise_m[at] = known ? kSigmas * std::sqrt(noise_m[at]) : 0;
      highest_m[at] = known ? highest_m[at] : kHigh;
    }
  });
  return coarse;
}

/// Between the highest and the lowest known cell: no opening can lower a cell by more.
float Relief(const GridF& surface) {
  float lowest = kHigh, highest = -kHigh;
  for (const float height : surface.cells()) {
    lowest = std::min(lowest, height);
    highest = height == kHigh ? highest : std::max(highest, height);
  }
  return highest - lowest;
}

/// Height under each candidate, infinite where there is none.
GridF GroundUnderCandidates(CoarseMap& coarse) {
  GridF ground(coarse.surface.rows(), coarse.surface.cols(), kHigh);
  const int widest = std::max(ground.rows(), ground.cols());
  int last = 0;
  for (const double radius_m : kRadii_m) {
    const double wanted = std::max(1.0, std::round(radius_m / coarse.cell_m));
    const int half = static_cast<int>(std::min<double>(wanted, widest));
    if (half == last) {
      continue;
    }
    last = half;
    const float rise_m =
        std::max(kLeastRise_m, static_cast<float>(kRisePerRadius * half * coarse.cell_m));
    if (!(Relief(coarse.surface) > rise_m)) {
      break;  // wider openings ask for more
    }
    const GridF before = coarse.surface;
    Open(half, coarse.surface);
    for (std::size_t i = 0; i < ground.cells().size(); ++i) {
      const float low = coarse.surface.cells()[i];
      const bool lost = before.cells()[i] - low > rise_m + coarse.noise_m.cells()[i];
      ground.cells()[i] = lost && ground.cells()[i] == kHigh ? low : ground.cells()[i];
    }
  }
  return ground;
}

/// Cells of the map that stand above the ground under their candidate.
Grid<std::uint8_t> Candidates(const ElevationMap& map, const CoarseMap& coarse,
                              const GridF& ground) {
  Grid<std::uint8_t> candidates(map.geometry.rows, map.geometry.cols, 0);
  ForEach(candidates.rows(), [&](int r) {
    const float* low_m = ground.row(r / coarse.block);
    const float* height_m = map.Measured().row(r);
    const CellState* state = map.state.row(r);
    std::uint8_t* candidate = candidates.row(r);
    for (int at = 0, c = 0; at < ground.cols(); ++at) {
      const int last = std::min(candidates.cols(), c + coarse.block);
      for (; c < last; ++c) {
        const bool above = height_m[c] - low_m[at] > kLeastRise_m;
        candidate[c] = above && state[c] == CellState::kMeasured ? 1 : 0;
      }
    }
  });
  return candidates;
}

/// What stands around one surface, in pairs of a cell inside and one outside.
struct Rim {
  int drops = 0;
  int walkable = 0;
  int beyond_map = 0;
  bool Raised() const {
    const int known = drops + walkable;
    return drops > 0 && drops >= kLeastDropShare * known &&
           known >= kLeastSeenShare * (known + beyond_map);
  }
};

/// Walks one surface after the other and keeps those with a drop around.
class RimWalk {
 public:
  RimWalk(const ElevationMap& map, Grid<std::uint8_t> candidates)
      : map_(map),
        left_(std::move(candidates)),
        inside_(left_),
        reach_(std::max(1, static_cast<int>(std::min(kRimReach_m / map.geometry.cell_m + 1e-6,
                                                     double(kMostReach))))) {}

  Grid<std::uint8_t> Run() {
    Grid<std::uint8_t> flags(left_.rows(), left_.cols(), kFlagNone);
    for (int r = 0; r < left_.rows(); ++r) {
      for (int c = 0; c < left_.cols(); ++c) {
        if (left_.at(r, c) != 0 && FloodFill({r, c}).Raised()) {
          for (const Cell& cell : surface_) {
            flags.at(cell) = kFlagElevated;
          }
        }
      }
    }
    return flags;
  }

 private:
  static constexpr int kMostReach = 8;

  /// Leaves the cells of the surface that holds `first` in surface_.
  Rim FloodFill(Cell first) {
    Rim rim;
    surface_.assign(1, first);
    left_.at(first) = 0;
    for (std::size_t next = 0; next < surface_.size(); ++next) {
      const Cell cell = surface_[next];
      bool on_rim = false;
      for (int k = 0; k < 9; ++k) {
        const Cell near{cell.row + k / 3 - 1, cell.col + k % 3 - 1};
        const bool here = map_.geometry.Contains(near);
        on_rim = on_rim || !here || inside_.at(near) == 0;
        if (here && left_.at(near) != 0) {
          left_.at(near) = 0;
          surface_.push_back(near);
        }
      }
      if (on_rim) {
        LookAround(cell, rim);
      }
    }
    return rim;
  }

  void LookAround(Cell cell, Rim& rim) const {
    const float cell_m = static_cast<float>(map_.geometry.cell_m);
    for (int dr = -reach_; dr <= reach_; ++dr) {
      for (int dc = -reach_; dc <= reach_; ++dc) {
        const Cell near{cell.row + dr, cell.col + dc};
        if (!map_.geometry.Contains(near)) {
          ++rim.beyond_map;
          continue;
        }
        if (inside_.at(near) != 0 || map_.state.at(near) != CellState::kMeasured) {
          continue;
        }
        const float distance_m = cell_m * std::sqrt(static_cast<float>(dr * dr + dc * dc));
        const float rise_m = map_.Measured().at(cell) - map_.Measured().at(near) -
                             std::max(kLeastRise_m, kWalkableSlope * distance_m);
        rim.drops += rise_m > 0 ? 1 : 0;
        rim.walkable += rise_m <= 0 ? 1 : 0;
      }
    }
  }

  const ElevationMap& map_;
  Grid<std::uint8_t> left_;
  const Grid<std::uint8_t> inside_;
  const int reach_;
  std::vector<Cell> surface_;
};

}  // namespace

Grid<std::uint8_t> FindRaisedSurfaces(const ElevationMap& map) {
  if (map.height_m.empty()) {
    return {};
  }
  CoarseMap coarse = Coarsened(map);
  const GridF ground = GroundUnderCandidates(coarse);
  return RimWalk(map, Candidates(map, coarse, ground)).Run();
}

}  // namespace palace
