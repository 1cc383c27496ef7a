// Analytic worlds: ground whose slope, heights and obstacles are known in closed form.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "engine/core/frames.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/model/elevation_map.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"
#include "engine/model/site_standing.h"

namespace palace::testing {

/// Height above the origin at (north, east), metres; NaN where nothing is measured.
using Height = std::function<double(double north_m, double east_m)>;

inline Height Flat(double height_m = 0) {
  return [=](double, double) { return height_m; };
}
/// Ground that rises by slope_rad towards azimuth_rad (0 north, pi/2 east).
inline Height Slope(double slope_rad, double azimuth_rad) {
  return [=](double n, double e) {
    return std::tan(slope_rad) * (n * std::cos(azimuth_rad) + e * std::sin(azimuth_rad));
  };
}
/// A box (or, with negative height, a pit) on other ground, centred at (n0, e0).
inline Height WithBox(Height ground, double n0, double e0, double side_m, double height_m) {
  return [=](double n, double e) {
    const bool inside = std::abs(n - n0) <= side_m / 2 && std::abs(e - e0) <= side_m / 2;
    return ground(n, e) + (inside ? height_m : 0.0);
  };
}

/// Map sampled at cell centres, centred on the origin. sigma_m: noise added and declared.
inline ElevationMap MakeMap(int rows, int cols, double cell_m, const Height& height,
                            double sigma_m = 0, std::uint64_t seed = 1) {
  const GridGeometry geometry{rows, cols, cell_m, -rows * cell_m / 2, -cols * cell_m / 2};
  ElevationMap map{{},
                   geometry,
                   GridF(rows, cols, kUnknownValue),
                   GridF(rows, cols, kUnknownValue),
                   Grid<std::uint16_t>(rows, cols, 0),
                   Grid<CellState>(rows, cols, CellState::kUnknown)};
  RandomStream random(seed, "map noise");
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      const double z = height(geometry.NorthOfRow(r), geometry.EastOfCol(c));
      const double noise = sigma_m * random.Normal();
      if (!std::isnan(z)) {
        map.height_m.at(r, c) = static_cast<float>(z + noise);
        map.variance_m2.at(r, c) = static_cast<float>(std::max(1e-6, sigma_m * sigma_m));
        map.frame_count.at(r, c) = kFramesToConfirm;
        map.state.at(r, c) = CellState::kMeasured;
      }
    }
  }
  return map;
}

/// Every place shows `shown_m` with that sigma, all of it noise, where a thing would show `share`
/// of its height.
inline NarrowFigures ThatShow(const GridGeometry& map, double shown_m, double sigma_m,
                              double share = 0.3) {
  const auto layer = [&](double value) {
    return GridF(NarrowFigures::kPerCell * map.rows, NarrowFigures::kPerCell * map.cols,
                 static_cast<float>(value));
  };
  return {layer(shown_m), layer(sigma_m), layer(sigma_m), layer(share), 0.675};
}

/// Left camera 640x480, 45 degrees, looking north and down by `tilt_down_rad` from `height_m`.
inline PinholeCamera ThesisCamera() {
  const double f = 320 / std::tan(Rad(45) / 2);
  return {640, 480, f, f, 319.5, 239.5};
}
inline RigidTransform CameraPose(double height_m, double tilt_down_rad, double north_m = 0,
                                 EulerAngles error = {}) {
  return {RotationFromEuler(error) * CameraRotationFromTilt(-tilt_down_rad),
          Eigen::Vector3d(north_m, 0, -height_m)};
}

/// Range map of a world seen from X_WC, by marching each ray; disparity noise sigma_d_px (1 m
/// baseline), declared as such. Every `step`-th pixel both ways is measured.
inline RangeMap SeeWorld(const Height& height, const RigidTransform& X_WC, double sigma_d_px,
                         std::uint64_t seed, int step = 2) {
  const PinholeCamera camera = ThesisCamera();
  const ImageF unknown(camera.width, camera.height, std::numeric_limits<float>::quiet_NaN());
  RangeMap range{{}, camera, unknown, unknown, unknown, unknown, 1, ViewPose{X_WC}};
  RandomStream random(seed, "disparity noise");
  for (int y = 0; y < camera.height; y += step) {
    for (int x = 0; x < camera.width; x += step) {
      const Eigen::Vector3d ray_W = X_WC.R * Eigen::Vector3d((x - camera.cx_px) / camera.fx_px,
                                                             (y - camera.cy_px) / camera.fy_px, 1);
      const auto above = [&](double depth) {
        const Eigen::Vector3d p = X_WC.p + depth * ray_W;
        return -p.z() - height(p.x(), p.y());
      };
      double depth = 1;
      while (depth < 60 && above(depth) > 0) {
        depth += std::max(0.03, 0.7 * (above(depth) - 2.0));
      }
      if (depth >= 60) {
        continue;
      }
      const double disparity = camera.fx_px / depth + sigma_d_px * random.Normal();
      range.disparity_px.at(x, y) = static_cast<float>(disparity);
      range.disparity_sigma_px.at(x, y) = static_cast<float>(sigma_d_px);
      range.depth_m.at(x, y) = static_cast<float>(camera.fx_px / disparity);
      range.depth_sigma_m.at(x, y) =
          static_cast<float>(camera.fx_px / disparity / disparity * sigma_d_px);
    }
  }
  return range;
}

/// Ground no two places of which are alike: a random slope, waves, rocks, holes nothing was
/// measured in, and declared noise that differs from cell to cell.
inline ElevationMap RandomGround(int rows, int cols, double cell_m, std::uint64_t seed) {
  RandomStream random(seed, "random ground");
  const Height slope = Slope(Rad(random.Uniform(0, 6)), random.Uniform(0, 6.28));
  const double north_rad = random.Uniform(0, 6.28), east_rad = random.Uniform(0, 6.28);
  Height world = [=](double n, double e) {
    return slope(n, e) + 0.02 * std::sin(n / 0.9 + north_rad) + 0.03 * std::sin(e / 1.3 + east_rad);
  };
  const double half_m = std::min(rows, cols) * cell_m / 2;
  for (int rock = 0; rock < 3; ++rock) {
    world = WithBox(world, random.Uniform(-half_m, half_m), random.Uniform(-half_m, half_m),
                    random.Uniform(0.2, 1.0), random.Uniform(-0.6, 0.9));
  }
  ElevationMap map = MakeMap(rows, cols, cell_m, world, random.Uniform(0.002, 0.02), seed);
  for (std::size_t i = 0; i < map.state.cells().size(); ++i) {
    map.variance_m2.cells()[i] *= static_cast<float>(random.Uniform(0.8, 1.3));
    if (random.Uniform() < 0.001) {
      map.state.cells()[i] = CellState::kUnknown;
      map.height_m.cells()[i] = map.variance_m2.cells()[i] = kUnknownValue;
      map.frame_count.cells()[i] = 0;
    }
  }
  return map;
}

/// One of the eight ways to lay a map about the origin of W: mirrored east to west or not, then
/// turned clockwise by quarters.
struct Turn {
  int quarters = 0;
  bool mirrored = false;

  Eigen::Vector3d operator()(Eigen::Vector3d p_W) const {
    p_W.y() = mirrored ? -p_W.y() : p_W.y();
    for (int k = 0; k < quarters; ++k) {
      p_W = {-p_W.y(), p_W.x(), p_W.z()};
    }
    return p_W;
  }
  Cell operator()(Cell cell, int rows, int cols) const {
    cell.col = mirrored ? cols - 1 - cell.col : cell.col;
    for (int k = 0; k < quarters; ++k) {
      cell = {cell.col, rows - 1 - cell.row};
      std::swap(rows, cols);
    }
    return cell;
  }
  template <typename T>
  Grid<T> operator()(const Grid<T>& grid) const {
    Grid<T> turned =
        quarters % 2 == 0 ? Grid<T>(grid.rows(), grid.cols()) : Grid<T>(grid.cols(), grid.rows());
    for (int r = 0; r < grid.rows(); ++r) {
      for (int c = 0; c < grid.cols(); ++c) {
        turned.at((*this)(Cell{r, c}, grid.rows(), grid.cols())) = grid.at(r, c);
      }
    }
    return turned;
  }
  /// Of a map whose middle is the origin.
  ElevationMap operator()(const ElevationMap& map) const {
    ElevationMap turned{map.time,
                        map.geometry,
                        (*this)(map.height_m),
                        (*this)(map.variance_m2),
                        (*this)(map.frame_count),
                        (*this)(map.state)};
    turned.measured_m = (*this)(map.measured_m);
    GridGeometry& g = turned.geometry;
    g.rows = turned.height_m.rows();
    g.cols = turned.height_m.cols();
    g.north_min_m = -g.rows * g.cell_m / 2;
    g.east_min_m = -g.cols * g.cell_m / 2;
    return turned;
  }
};

inline SladSettings WithMode(SladMode mode) {
  SladSettings settings;
  settings.mode = mode;
  return settings;
}

}  // namespace palace::testing
