// Analytic worlds: ground whose slope, heights and obstacles are known in closed form.
#pragma once

#include <cmath>
#include <functional>
#include <limits>

#include "engine/core/frames.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/model/elevation_map.h"
#include "engine/model/range_map.h"
#include "engine/model/settings.h"

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
        map.frame_count.at(r, c) = 1;
        map.state.at(r, c) = CellState::kMeasured;
      }
    }
  }
  return map;
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
  RangeMap range{{}, camera, unknown, unknown, unknown, unknown};
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

inline SladSettings WithMode(SladMode mode) {
  SladSettings settings;
  settings.mode = mode;
  return settings;
}

}  // namespace palace::testing
