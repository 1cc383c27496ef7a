// Thesis mode written once more, from its definitions and for nothing but plainness: Table 4.4 in,
// every output, double precision, no tricks. The engine's fast version must equal it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/units.h"
#include "engine/model/elevation_map.h"
#include "engine/model/settings/settings.h"

namespace palace::testing::thesis {

/// A plane around a cell: height above the cell's own reference, rise per sample spacing.
struct ReferencePlane {
  double height = 0, east = 0, south = 0;
};

inline constexpr double kFloatDoubt_m = 2e-6;
inline constexpr double kLeastThreshold_m = 1e-3;

struct Sample {
  double x, y, z;
};

inline double Residual(const Sample& s, const Eigen::Vector3d& plane) {
  return std::abs(s.z - plane[0] - plane[1] * s.x - plane[2] * s.y);
}

inline std::vector<Sample> SamplesAround(const GridF& z, int row, int col, int stride,
                                         double reference) {
  std::vector<Sample> samples;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int r = row + dy * stride, c = col + dx * stride;
      if (r >= 0 && c >= 0 && r < z.rows() && c < z.cols() && !std::isnan(z.at(r, c))) {
        samples.push_back({double(dx), double(dy), double(z.at(r, c)) - reference});
      }
    }
  }
  return samples;
}

struct Candidate {
  double median;
  Eigen::Vector3d plane;
};

inline std::vector<Candidate> PlanesOfTriples(const std::vector<Sample>& samples) {
  std::vector<Candidate> candidates;
  const std::size_t n = samples.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        Eigen::Matrix3d a;
        a << 1, samples[i].x, samples[i].y, 1, samples[j].x, samples[j].y, 1, samples[k].x,
            samples[k].y;
        if (std::abs(a.determinant()) < 0.5) {
          continue;
        }
        const Eigen::Vector3d plane =
            a.inverse() * Eigen::Vector3d(samples[i].z, samples[j].z, samples[k].z);
        std::vector<double> residuals;
        for (const Sample& s : samples) {
          residuals.push_back(Residual(s, plane));
        }
        std::sort(residuals.begin(), residuals.end());
        candidates.push_back({residuals[n / 2], plane});
      }
    }
  }
  return candidates;
}

inline void Refit(const std::vector<Sample>& samples, const Eigen::Vector3d& start,
                  double threshold, std::vector<ReferencePlane>& out) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Sample& s : samples) {
    if (Residual(s, start) < threshold) {
      const Eigen::Vector3d basis(1, s.x, s.y);
      normal += basis * basis.transpose();
      right += s.z * basis;
    }
  }
  if (std::abs(normal.determinant()) > 0.5) {
    const Eigen::Vector3d x = normal.inverse() * right;
    out.push_back({x[0], x[1], x[2]});
  }
}

/// Least median of squares over all 84 triples of the 3x3 samples, inliers, least squares; with
/// fewer than six samples least squares alone. Heights are above `reference_m`.
/// The first plane is the answer. Further ones are equally good as far as floats can tell: their
/// triple's median, or a sample's distance from the inlier threshold, differs by less than 2 um.
/// Empty when no plane is spanned.
inline std::vector<ReferencePlane> ReferencePlanes(const GridF& height_m, int row, int col,
                                                   int stride, double reference_m) {
  const std::vector<Sample> samples = SamplesAround(height_m, row, col, stride, reference_m);
  const std::size_t n = samples.size();
  std::vector<ReferencePlane> planes;
  if (n < 6) {
    Refit(samples, Eigen::Vector3d::Zero(), HUGE_VAL, planes);
    return planes;
  }
  std::vector<Candidate> candidates = PlanesOfTriples(samples);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.median < b.median; });
  const double factor = 2.5 * 1.4826 * (1 + 5.0 / (double(n) - 3));
  for (const Candidate& candidate : candidates) {
    if (candidate.median > candidates.front().median + kFloatDoubt_m) {
      break;
    }
    const double threshold = std::max(kLeastThreshold_m, factor * candidate.median);
    const double doubt = factor * kFloatDoubt_m;
    Refit(samples, candidate.plane, threshold, planes);
    const bool doubtful = std::any_of(samples.begin(), samples.end(), [&](const Sample& s) {
      return std::abs(Residual(s, candidate.plane) - threshold) < doubt;
    });
    if (doubtful) {
      Refit(samples, candidate.plane, threshold - doubt, planes);
      Refit(samples, candidate.plane, threshold + doubt, planes);
    }
  }
  return planes;
}

/// Samples in the plane fit lie a rock apart, but never more than a third of the map.
inline int ReferenceStride(const GridGeometry& geometry, const SladSettings& settings) {
  const int most = std::max(1, std::min(geometry.rows, geometry.cols) / 3);
  return std::clamp(int(settings.lander.max_rock_size_m / geometry.cell_m), 1, most);
}

/// Angle of the plane's normal to the up vector by acos(n . u), radians (errata E21).
inline double ReferenceSlope(const ReferencePlane& plane, double spacing_m,
                             const SladSettings& settings) {
  // Up-positive height over (north, east): the normal in north-east-down.
  const double north_gradient = -plane.south / spacing_m, east_gradient = plane.east / spacing_m;
  const Eigen::Vector3d normal = Eigen::Vector3d(-north_gradient, -east_gradient, -1).normalized();
  return std::acos(std::clamp(normal.dot(settings.lander.up_W()), -1.0, 1.0));
}

/// 4.6-4.10.
inline double ReferenceCost(double slope_rad, double roughness_m, const SladSettings& settings) {
  const double slope_limit = Rad(settings.limits.max_slope_deg),
               roughness_limit = settings.limits.max_deviation_m;
  if (slope_rad > slope_limit || roughness_m > roughness_limit) {
    return 1;
  }
  return roughness_m * slope_rad / (roughness_limit * slope_limit);
}

/// Mean over the cell and those of its eight neighbours that lie on the map; unknown counts as 1.
inline double ReferenceSmoothedCost(const GridF& cost, Cell cell) {
  double sum = 0;
  int count = 0;
  for (int r = std::max(0, cell.row - 1); r <= std::min(cost.rows() - 1, cell.row + 1); ++r) {
    for (int c = std::max(0, cell.col - 1); c <= std::min(cost.cols() - 1, cell.col + 1); ++c) {
      sum += std::isnan(cost.at(r, c)) ? 1.0 : double(cost.at(r, c));
      ++count;
    }
  }
  return sum / count;
}

/// Distance to the nearest cell that is not safe, by looking at all of them; the ring of cells
/// around the map is not safe.
inline double ReferenceSafeDistance(const Grid<std::uint8_t>& safe, Cell cell, double cell_m) {
  int best = 1 << 30;
  for (int r = -1; r <= safe.rows(); ++r) {
    for (int c = -1; c <= safe.cols(); ++c) {
      const bool outside = r < 0 || c < 0 || r == safe.rows() || c == safe.cols();
      if (outside || safe.at(r, c) == 0) {
        best = std::min(best, (r - cell.row) * (r - cell.row) + (c - cell.col) * (c - cell.col));
      }
    }
  }
  return cell_m * std::sqrt(double(best));
}

/// True when the unknown cell lies in a run of at most `longest` cells, along the step, between two
/// measured ones.
inline bool InShortRun(const ElevationMap& map, Cell cell, int dr, int dc, int longest) {
  int length = 1;
  for (const int sign : {-1, 1}) {
    Cell at{cell.row + sign * dr, cell.col + sign * dc};
    while (map.geometry.Contains(at) && map.state.at(at) != CellState::kMeasured) {
      ++length;
      at = {at.row + sign * dr, at.col + sign * dc};
    }
    if (!map.geometry.Contains(at)) {
      return false;
    }
  }
  return length <= longest;
}

/// Mean of the cells of the wanted kind within `reach`, weighted by 1 / distance^power.
template <typename Wanted>
bool MeanAround(const ElevationMap& map, Cell cell, int reach, int power, Wanted wanted,
                double& mean) {
  double weight = 0, sum = 0;
  for (int dr = -reach; dr <= reach; ++dr) {
    for (int dc = -reach; dc <= reach; ++dc) {
      const Cell near{cell.row + dr, cell.col + dc};
      if ((dr != 0 || dc != 0) && map.geometry.Contains(near) && wanted(map.state.at(near))) {
        const double w = std::pow(std::hypot(dr, dc), -power);
        weight += w;
        sum += w * double(map.height_m.at(near));
      }
    }
  }
  mean = sum / weight;
  return weight > 0;
}

/// Unknown cells from which the edge of the map is reached over unknown cells, sharing sides.
inline Grid<char> OpenToTheEdge(const ElevationMap& map) {
  const int rows = map.geometry.rows, cols = map.geometry.cols;
  Grid<char> open(rows, cols, 0);
  bool changed = true;
  while (changed) {
    changed = false;
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < cols; ++c) {
        const bool edge = r == 0 || c == 0 || r == rows - 1 || c == cols - 1;
        const bool reached = edge || open.at(r - 1, c) || open.at(r + 1, c) || open.at(r, c - 1) ||
                             open.at(r, c + 1);
        if (map.state.at(r, c) == CellState::kUnknown && !open.at(r, c) && reached) {
          open.at(r, c) = 1;
          changed = true;
        }
      }
    }
  }
  return open;
}

/// Holes up to data_size_cells long, then border_size_cells rings of the rim.
inline void ReferenceFillHoles(ElevationMap& map, int data_size_cells, int border_size_cells) {
  const ElevationMap measured = map;
  const auto fill = [&](Cell cell, double mean, CellState state) {
    map.height_m.at(cell) = float(mean);
    map.state.at(cell) = state;
  };
  double mean = 0;
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      if (measured.state.at(r, c) == CellState::kUnknown &&
          (InShortRun(measured, {r, c}, 0, 1, data_size_cells) ||
           InShortRun(measured, {r, c}, 1, 0, data_size_cells)) &&
          MeanAround(
              measured, {r, c}, data_size_cells, 2,
              [](CellState s) { return s == CellState::kMeasured; }, mean)) {
        fill({r, c}, mean, CellState::kFilled);
      }
    }
  }
  const Grid<char> open = OpenToTheEdge(map);
  for (int ring = 0; ring < border_size_cells; ++ring) {
    const ElevationMap before = map;
    for (int r = 0; r < map.geometry.rows; ++r) {
      for (int c = 0; c < map.geometry.cols; ++c) {
        if (open.at(r, c) && before.state.at(r, c) == CellState::kUnknown &&
            MeanAround(
                before, {r, c}, 1, 0, [](CellState s) { return s != CellState::kUnknown; }, mean)) {
          fill({r, c}, mean, CellState::kBorder);
        }
      }
    }
  }
}

}  // namespace palace::testing::thesis
