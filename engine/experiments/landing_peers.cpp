#include "engine/experiments/landing_peers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <opencv2/core.hpp>

#include "engine/camera/pinhole.h"
#include "engine/core/check.h"
#include "engine/core/units.h"
#include "engine/experiments/raster_peers.h"
#include "engine/slad/hazards/safe_distance.h"

namespace palace {
namespace {

using Refused = Grid<std::uint8_t>;
using Place = std::optional<Eigen::Vector2d>;

struct Offset {
  int row, col;
};

std::vector<Offset> Disc(double radius_cells) {
  std::vector<Offset> disc;
  const int reach = static_cast<int>(radius_cells);
  for (int r = -reach; r <= reach; ++r) {
    for (int c = -reach; c <= reach; ++c) {
      if (std::hypot(r, c) <= radius_cells) {
        disc.push_back({r, c});
      }
    }
  }
  return disc;
}

/// refused(cell) for every cell, rows shared among threads.
template <typename Rule>
Refused Ask(const GridGeometry& g, Rule rule) {
  Refused refused(g.rows, g.cols, 1);
  cv::parallel_for_(cv::Range(0, g.rows), [&](const cv::Range& rows) {
    for (int r = rows.start; r < rows.end; ++r) {
      for (int c = 0; c < g.cols; ++c) {
        refused.at(r, c) = rule(Cell{r, c}) ? 1 : 0;
      }
    }
  });
  return refused;
}

Place FarthestFrom(const Refused& refused, const GridGeometry& g, double least_m) {
  const GridF distance_m = SafeDistance(refused, g.cell_m);
  const auto best = std::max_element(distance_m.cells().begin(), distance_m.cells().end());
  if (best == distance_m.cells().end() || !(*best > 0 && static_cast<double>(*best) >= least_m)) {
    return std::nullopt;
  }
  const int at = static_cast<int>(best - distance_m.cells().begin());
  return Eigen::Vector2d(g.NorthOfRow(at / g.cols), g.EastOfCol(at % g.cols));
}

Place ByRaster(const GridF& height_m, const GridGeometry& g, const SladSettings& settings) {
  const GridF slope_rad = PlainSlopeRad(height_m, g.cell_m), rough_m = PlainRoughnessM(height_m);
  const float most_rad = static_cast<float>(Rad(settings.limits.max_slope_deg)),
              most_m = static_cast<float>(settings.limits.max_deviation_m);
  // What is unknown is not at most the limit.
  const auto refuses = [&](Cell cell) {
    return !(slope_rad.at(cell) <= most_rad && rough_m.at(cell) <= most_m);
  };
  return FarthestFrom(Ask(g, refuses), g, settings.lander.clear_radius_m());
}

constexpr double kAuterionSlope_deg = 9, kAuterionDeviation_m = 0.18, kAuterionSigma_m = 0.055;

Place ByAuterion(const GridF& height_m, const GridGeometry& g, const SladSettings& settings) {
  const std::vector<Offset> disc = Disc(settings.lander.radius_m() / g.cell_m);
  double squares = 0;  // about the middle of a disc planes are fitted axis by axis
  for (const Offset& offset : disc) {
    squares += offset.row * offset.row;
  }
  const auto refuses = [&](Cell cell) {
    double sum = 0, by_row = 0, by_col = 0;
    for (const Offset& offset : disc) {
      const Cell at{cell.row + offset.row, cell.col + offset.col};
      if (!g.Contains(at) || std::isnan(height_m.at(at))) {
        return true;
      }
      const double z = static_cast<double>(height_m.at(at));
      sum += z;
      by_row += offset.row * z;
      by_col += offset.col * z;
    }
    const double n = static_cast<double>(disc.size());
    const double down_rows = squares > 0 ? by_row / squares : 0,
                 along_cols = squares > 0 ? by_col / squares : 0;
    double most_m = 0, residuals_m2 = 0;
    for (const Offset& offset : disc) {
      const double z =
          static_cast<double>(height_m.at(cell.row + offset.row, cell.col + offset.col));
      const double off_m = z - sum / n - down_rows * offset.row - along_cols * offset.col;
      most_m = std::max(most_m, std::abs(off_m));
      residuals_m2 += off_m * off_m;
    }
    const double slope_rad = std::atan(std::hypot(down_rows, along_cols) / g.cell_m);
    return slope_rad > Rad(kAuterionSlope_deg) || most_m > kAuterionDeviation_m ||
           std::sqrt(residuals_m2 / n) > kAuterionSigma_m;
  };
  return FarthestFrom(Ask(g, refuses), g, settings.lander.nav_error_m);
}

constexpr double kPad_m = 0.3, kAlhatSigma_m = 0.05 / 3;
constexpr int kHeadings = 8;  // of a quarter turn

/// The lander at one heading, in cells.
struct Stance {
  std::array<Offset, 4> pads;
  std::vector<Offset> between;
};

std::vector<Stance> StancesOf(const Lander& lander, double cell_m) {
  const double out = (lander.radius_m() - kPad_m / 2) / cell_m;
  std::vector<Stance> stances;
  for (int h = 0; h < kHeadings; ++h) {
    const double turn = std::numbers::pi / 2 * h / kHeadings;
    const double ahead_row = std::cos(turn), ahead_col = std::sin(turn);
    Stance stance;
    for (int k = 0; k < 4; ++k) {
      const double at = turn + std::numbers::pi / 2 * k;
      stance.pads[static_cast<std::size_t>(k)] = {
          static_cast<int>(std::lround(out * std::cos(at))),
          static_cast<int>(std::lround(out * std::sin(at)))};
    }
    for (const Offset& offset : Disc(out)) {
      const double ahead = ahead_row * offset.row + ahead_col * offset.col,
                   aside = ahead_row * offset.col - ahead_col * offset.row;
      if (std::abs(ahead) + std::abs(aside) <= out) {
        stance.between.push_back(offset);
      }
    }
    stances.push_back(std::move(stance));
  }
  return stances;
}

/// The highest point under a pad; NaN where any of it is unknown.
GridF UnderPads(const GridF& height_m, const GridGeometry& g) {
  const std::vector<Offset> pad = Disc(kPad_m / 2 / g.cell_m);
  GridF highest(g.rows, g.cols, kUnknownValue);
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      float most = -HUGE_VALF;
      for (const Offset& offset : pad) {
        const Cell at{r + offset.row, c + offset.col};
        const float z = g.Contains(at) ? height_m.at(at) : kUnknownValue;
        most = std::isnan(z) ? z : std::isnan(most) ? most : std::max(most, z);
      }
      highest.at(r, c) = most;
    }
  }
  return highest;
}

Place ByAlhat(const GridF& height_m, const GridGeometry& g, const SladSettings& settings) {
  const std::vector<Stance> stances = StancesOf(settings.lander, g.cell_m);
  const GridF under_pads = UnderPads(height_m, g);
  const double rough_m = settings.limits.max_deviation_m;
  const double steepest = std::tan(Rad(settings.limits.max_slope_deg));
  const auto stands = [&](Cell cell, const Stance& stance, std::size_t free) {
    // Opposite pads are as far out as each other: the plane through three of them.
    const auto pad = [&](std::size_t k) {
      const Offset& offset = stance.pads[(free + k) % 4];
      const Cell at{cell.row + offset.row, cell.col + offset.col};
      return g.Contains(at) ? static_cast<double>(under_pads.at(at)) : std::nan("");
    };
    const double left = pad(1), opposite = pad(2), right = pad(3), middle = (left + right) / 2;
    if (std::isnan(pad(0) + left + opposite + right)) {
      return false;
    }
    if (pad(0) > 2 * middle - opposite) {
      return true;  // it would not rest on these three
    }
    const Offset &a = stance.pads[(free + 2) % 4], &b = stance.pads[(free + 1) % 4];
    const double squared = a.row * a.row + a.col * a.col;
    const double along_a = (opposite - middle) / squared, along_b = (left - middle) / squared;
    const double by_row = along_a * a.row + along_b * b.row,
                 by_col = along_a * a.col + along_b * b.col;
    const double tangent = std::hypot(by_row, by_col) / g.cell_m;
    if (tangent > steepest) {
      return false;
    }
    const double upright = 1 / std::hypot(1, tangent);
    for (const Offset& offset : stance.between) {
      const double z =
          static_cast<double>(height_m.at(cell.row + offset.row, cell.col + offset.col));
      const double rise_m = upright * (z - middle - by_row * offset.row - by_col * offset.col);
      const double sigma_m = upright * kAlhatSigma_m;
      const double safe = 0.5 * std::erfc((rise_m - rough_m) / (sigma_m * std::numbers::sqrt2));
      if (!(safe >= settings.limits.min_safe_probability)) {
        return false;
      }
    }
    return true;
  };
  const auto refuses = [&](Cell cell) {
    for (const Stance& stance : stances) {
      for (std::size_t free = 0; free < 4; ++free) {
        if (!stands(cell, stance, free)) {
          return true;
        }
      }
    }
    return false;
  };
  return FarthestFrom(Ask(g, refuses), g, settings.lander.nav_error_m);
}

constexpr double kPx4Cell_m = 0.25, kPx4Sigma_m = 0.2, kPx4Step_m = 0.1, kPx4Keeps = 0.9,
                 kPx4Decides = 0.4;
constexpr int kPx4Points = 100, kPx4Smooth = 5, kPx4Good = 70, kPx4Stepped = 70, kPx4Patch = 6;

/// Of the points of one frame, or filtered over frames; only the count is of one frame.
struct PointCells {
  Grid<int> count;
  Grid<double> mean_m, variance_m2;
};

PointCells PointsOf(const RangeMap& range, const GridGeometry& g) {
  PointCells cells{Grid<int>(g.rows, g.cols), Grid<double>(g.rows, g.cols),
                   Grid<double>(g.rows, g.cols)};
  for (int y = 0; y < range.depth_m.height(); ++y) {
    for (int x = 0; x < range.depth_m.width(); ++x) {
      const double depth_m = static_cast<double>(range.depth_m.at(x, y));
      if (!(depth_m > 0)) {
        continue;
      }
      const Eigen::Vector3d ray = RayFromPixel(range.camera, {x, y});
      const Eigen::Vector3d p_W = range.pose->X_WC * Eigen::Vector3d(ray * (depth_m / ray.z()));
      if (const auto cell = g.CellFromPoint(p_W.x(), p_W.y())) {
        const int n = ++cells.count.at(*cell);
        const double off_m = -p_W.z() - cells.mean_m.at(*cell);
        cells.mean_m.at(*cell) += off_m / n;
        cells.variance_m2.at(*cell) +=
            (off_m * (-p_W.z() - cells.mean_m.at(*cell)) - cells.variance_m2.at(*cell)) / n;
      }
    }
  }
  return cells;
}

Grid<std::uint8_t> IsLandable(const PointCells& cells, const GridGeometry& g) {
  Grid<std::uint8_t> good(g.rows, g.cols, 0), landable(g.rows, g.cols, 0);
  for (std::size_t i = 0; i < good.cells().size(); ++i) {
    good.cells()[i] = cells.count.cells()[i] >= kPx4Points &&
                      std::sqrt(cells.variance_m2.cells()[i]) <= kPx4Sigma_m;
  }
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      int are_good = 0, are_stepped = 0;
      for (int dr = -kPx4Smooth; dr <= kPx4Smooth; ++dr) {
        for (int dc = -kPx4Smooth; dc <= kPx4Smooth; ++dc) {
          const Cell near{r + dr, c + dc};
          const double near_m = g.Contains(near) ? cells.mean_m.at(near) : 0;
          are_good += g.Contains(near) ? good.at(near) : 0;
          are_stepped += std::abs(cells.mean_m.at(r, c) - near_m) > kPx4Step_m ? 1 : 0;
        }
      }
      landable.at(r, c) = are_good > kPx4Good && are_stepped <= kPx4Stepped ? 1 : 0;
    }
  }
  return landable;
}

Place ByPx4(const std::vector<FieldFrame>& frames, const GridGeometry& map) {
  const auto cells_of = [&](int count) {
    return static_cast<int>(std::ceil(count * map.cell_m / kPx4Cell_m));
  };
  const GridGeometry g{cells_of(map.rows), cells_of(map.cols), kPx4Cell_m, map.north_min_m,
                       map.east_min_m};
  PointCells kept;
  Grid<double> decides(g.rows, g.cols, 0);
  for (const FieldFrame& frame : frames) {
    PointCells now = PointsOf(*frame.input.view.range, g);
    for (std::size_t i = 0; !kept.count.empty() && i < now.count.cells().size(); ++i) {
      const auto filter = [&](Grid<double>& value, const Grid<double>& before) {
        value.cells()[i] = kPx4Keeps * before.cells()[i] + (1 - kPx4Keeps) * value.cells()[i];
      };
      filter(now.mean_m, kept.mean_m);
      filter(now.variance_m2, kept.variance_m2);
    }
    const Grid<std::uint8_t> landable = IsLandable(now, g);
    for (std::size_t i = 0; i < landable.cells().size(); ++i) {
      decides.cells()[i] = kPx4Keeps * decides.cells()[i] + (1 - kPx4Keeps) * landable.cells()[i];
    }
    kept = std::move(now);
  }
  const std::vector<Offset> patch = Disc(kPx4Patch + 0.499);
  const auto is_good = [&](Cell middle) {
    return std::all_of(patch.begin(), patch.end(), [&](const Offset& offset) {
      const Cell at{middle.row + offset.row, middle.col + offset.col};
      return g.Contains(at) && decides.at(at) > kPx4Decides;
    });
  };
  Place nearest;
  double nearest_cells = HUGE_VAL;
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      const double away = std::hypot(r - g.rows / 2, c - g.cols / 2);
      if (away < nearest_cells && is_good({r, c})) {
        nearest_cells = away;
        nearest = Eigen::Vector2d(g.NorthOfRow(r), g.EastOfCol(c));
      }
    }
  }
  return nearest;
}

/// Heights of measured ground alone: what was filled in is unknown.
GridF MeasuredOnly(const ElevationMap& map) {
  GridF height_m = map.Measured();
  for (std::size_t i = 0; i < height_m.cells().size(); ++i) {
    if (map.state.cells()[i] != CellState::kMeasured) {
      height_m.cells()[i] = kUnknownValue;
    }
  }
  return height_m;
}

}  // namespace

std::vector<PeerPlace> PlacesOfPeers(const std::vector<FieldFrame>& frames, const ElevationMap& map,
                                     const SladSettings& settings) {
  PALACE_CHECK(!frames.empty());
  const GridF height_m = MeasuredOnly(map);
  return {{"raster", ByRaster(height_m, map.geometry, settings)},
          {"auterion", ByAuterion(height_m, map.geometry, settings)},
          {"alhat", ByAlhat(height_m, map.geometry, settings)},
          {"px4", ByPx4(frames, map.geometry)}};
}

}  // namespace palace
