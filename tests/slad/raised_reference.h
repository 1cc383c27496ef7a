// Raised surfaces by the rule of raised_surface.h asked cell by cell: no moving windows, no
// threads.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/model/elevation_map.h"

namespace palace::testing {

class PlainRaised {
 public:
  explicit PlainRaised(const ElevationMap& map) : map_(map), g_(map.geometry) {}

  Grid<std::uint8_t> Run() {
    Coarsen();
    FindGround();
    inside_ = Grid<std::uint8_t>(g_.rows, g_.cols, 0);
    for (int r = 0; r < g_.rows; ++r) {
      for (int c = 0; c < g_.cols; ++c) {
        const float low = ground_.at(r / block_, c / block_);
        inside_.at(r, c) = IsMeasured({r, c}) && Height({r, c}) - low > 0.3F ? 1 : 0;
      }
    }
    Grid<std::uint8_t> flags(g_.rows, g_.cols, kFlagNone), left = inside_;
    for (int r = 0; r < g_.rows; ++r) {
      for (int c = 0; c < g_.cols; ++c) {
        if (left.at(r, c) != 0) {
          const std::vector<Cell> surface = Fill({r, c}, left);
          for (const Cell& cell : surface) {
            flags.at(cell) = IsRaised(surface) ? kFlagElevated : kFlagNone;
          }
        }
      }
    }
    return flags;
  }

 private:
  bool IsMeasured(Cell cell) const { return map_.state.at(cell) == CellState::kMeasured; }
  float Height(Cell cell) const { return map_.Measured().at(cell); }

  void Coarsen() {
    block_ = int(
        std::clamp(std::floor(0.3 / g_.cell_m + 1e-6), 1.0, double(std::max(g_.rows, g_.cols))));
    const int rows = (g_.rows + block_ - 1) / block_, cols = (g_.cols + block_ - 1) / block_;
    surface_ = GridF(rows, cols, HUGE_VALF);
    noise_m_ = GridF(rows, cols, 0.0F);
    for (int r = 0; r < g_.rows; ++r) {
      for (int c = 0; c < g_.cols; ++c) {
        float& highest = surface_.at(r / block_, c / block_);
        if (IsMeasured({r, c}) && std::isfinite(Height({r, c})) &&
            (highest == HUGE_VALF || Height({r, c}) > highest)) {
          highest = Height({r, c});
          noise_m_.at(r / block_, c / block_) = 3.0F * std::sqrt(map_.variance_m2.at(r, c));
        }
      }
    }
  }
  /// Of the square around each cell the least (sign -1) or largest (1); infinite ones do not count.
  static GridF Extreme(const GridF& from, int half, float sign) {
    GridF most(from.rows(), from.cols(), -HUGE_VALF);
    for (int r = 0; r < from.rows(); ++r) {
      for (int c = 0; c < from.cols(); ++c) {
        for (int rr = std::max(0, r - half); rr <= std::min(from.rows() - 1, r + half); ++rr) {
          for (int cc = std::max(0, c - half); cc <= std::min(from.cols() - 1, c + half); ++cc) {
            if (std::isfinite(from.at(rr, cc))) {
              most.at(r, c) = std::max(most.at(r, c), sign * from.at(rr, cc));
            }
          }
        }
        most.at(r, c) *= sign;
      }
    }
    return most;
  }
  void FindGround() {
    ground_ = GridF(surface_.rows(), surface_.cols(), HUGE_VALF);
    const double cell_m = block_ * g_.cell_m;
    int last = 0;
    for (const double radius_m : {0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 11.0, 15.0, 20.0}) {
      const int half = int(std::min<double>(std::max(1.0, std::round(radius_m / cell_m)),
                                            std::max(surface_.rows(), surface_.cols())));
      if (half == last) {
        continue;
      }
      last = half;
      const float rise_m = std::max(0.3F, float(0.2F * float(half) * cell_m));
      const GridF opened = Extreme(Extreme(surface_, half, -1), half, 1);
      for (std::size_t i = 0; i < surface_.cells().size(); ++i) {
        const float before = surface_.cells()[i];
        if (before == HUGE_VALF) {
          continue;
        }
        const float low = opened.cells()[i];
        float& ground = ground_.cells()[i];
        if (before - low > rise_m + noise_m_.cells()[i] && ground == HUGE_VALF) {
          ground = low;
        }
        surface_.cells()[i] = low;
      }
    }
  }
  std::vector<Cell> Fill(Cell first, Grid<std::uint8_t>& left) const {
    std::vector<Cell> surface{first};
    left.at(first) = 0;
    for (std::size_t next = 0; next < surface.size(); ++next) {
      for (int k = 0; k < 9; ++k) {
        const Cell near{surface[next].row + k / 3 - 1, surface[next].col + k % 3 - 1};
        if (g_.Contains(near) && left.at(near) != 0) {
          left.at(near) = 0;
          surface.push_back(near);
        }
      }
    }
    return surface;
  }
  bool IsRaised(const std::vector<Cell>& surface) const {
    const int reach = std::max(1, int(std::min(0.3 / g_.cell_m + 1e-6, 8.0)));
    int drops = 0, walkable = 0, beyond_map = 0;
    for (const Cell& cell : surface) {
      bool on_rim = false;
      for (int k = 0; k < 9; ++k) {
        const Cell near{cell.row + k / 3 - 1, cell.col + k % 3 - 1};
        on_rim = on_rim || !g_.Contains(near) || inside_.at(near) == 0;
      }
      for (int dr = -reach; on_rim && dr <= reach; ++dr) {
        for (int dc = -reach; dc <= reach; ++dc) {
          const Cell near{cell.row + dr, cell.col + dc};
          if (!g_.Contains(near)) {
            ++beyond_map;
          } else if (inside_.at(near) == 0 && IsMeasured(near)) {
            const float distance_m = float(g_.cell_m) * std::sqrt(float(dr * dr + dc * dc));
            const float rise_m = Height(cell) - Height(near) - std::max(0.3F, 0.3F * distance_m);
            drops += rise_m > 0 ? 1 : 0;
            walkable += rise_m <= 0 ? 1 : 0;
          }
        }
      }
    }
    const int known = drops + walkable;
    return drops > 0 && drops >= 0.6 * known && known >= 0.4 * (known + beyond_map);
  }

  const ElevationMap& map_;
  const GridGeometry& g_;
  int block_ = 1;
  GridF surface_, noise_m_, ground_;
  Grid<std::uint8_t> inside_;
};

}  // namespace palace::testing
