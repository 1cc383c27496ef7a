// A plausible piece of ground for panel tests: pictures and maps computed from one height field.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "engine/core/units.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"

namespace palace::fake {

inline constexpr double kCell_m = 0.2;
inline constexpr int kCells = 100;

inline GridGeometry Geometry() { return {kCells, kCells, kCell_m, -10.0, -10.0}; }

/// Hash noise in 0..1, repeatable.
inline double Noise(int x, int y) {
  std::uint32_t h =
      static_cast<std::uint32_t>(x) * 374761393u + static_cast<std::uint32_t>(y) * 668265263u;
  h = (h ^ (h >> 13)) * 1274126177u;
  return static_cast<double>((h ^ (h >> 16)) & 0xFFFFu) / 65535.0;
}
inline double SmoothNoise(double x, double y) {
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  const double fx = x - x0;
  const double fy = y - y0;
  const double top = Noise(x0, y0) * (1 - fx) + Noise(x0 + 1, y0) * fx;
  const double low = Noise(x0, y0 + 1) * (1 - fx) + Noise(x0 + 1, y0 + 1) * fx;
  return top * (1 - fy) + low * fy;
}

struct Rock {
  double north_m, east_m, radius_m, height_m;
};
inline constexpr Rock kRocks[] = {
    {-3.1, -7.6, 0.7, 0.6},  {-2.0, -2.6, 0.9, 0.8}, {-2.6, 0.9, 0.5, 0.4}, {-4.2, 3.6, 0.6, 0.5},
    {-6.0, -8.6, 1.1, 0.9},  {-7.0, 0.5, 1.6, 1.4},  {-8.3, 6.5, 1.2, 1.0}, {5.4, -1.2, 0.4, 0.3},
    {-3.6, -5.0, 0.45, 0.4}, {-9.2, -3.4, 0.9, 0.8}};

inline double Height(double north_m, double east_m) {
  double height = 0.02 * north_m + 0.1 * SmoothNoise(north_m / 3, east_m / 3);
  for (const Rock& rock : kRocks) {
    const double d = std::hypot(north_m - rock.north_m, east_m - rock.east_m) / rock.radius_m;
    height += d < 1 ? rock.height_m * std::sqrt(1 - d * d) : 0;
  }
  return height;
}

inline bool Unknown(double north_m, double east_m) {
  return north_m < -6.5 && east_m < 0.4 * north_m + 1.2 && SmoothNoise(north_m, east_m) > 0.3 &&
         east_m > -9;
}

inline std::shared_ptr<const ElevationMap> Elevation(Timestamp time) {
  ElevationMap map{time,
                   Geometry(),
                   GridF(kCells, kCells, kUnknownValue),
                   GridF(kCells, kCells, kUnknownValue),
                   Grid<std::uint16_t>(kCells, kCells, 0),
                   Grid<CellState>(kCells, kCells, CellState::kUnknown)};
  for (int r = 0; r < kCells; ++r) {
    for (int c = 0; c < kCells; ++c) {
      const double north = map.geometry.NorthOfRow(r);
      const double east = map.geometry.EastOfCol(c);
      if (!Unknown(north, east)) {
        map.height_m.at(r, c) = static_cast<float>(Height(north, east));
        map.variance_m2.at(r, c) = 0.0004f;
        map.frame_count.at(r, c) = 10;
        map.state.at(r, c) = CellState::kMeasured;
      }
    }
  }
  return std::make_shared<const ElevationMap>(std::move(map));
}

inline std::shared_ptr<const HazardMaps> Hazards(const ElevationMap& map, double max_slope_rad,
                                                 double max_roughness_m) {
  HazardMaps h;
  h.geometry = map.geometry;
  h.slope_rad = h.slope_sigma_rad = h.roughness_m = h.roughness_sigma_m = h.step_m = h.cost =
      h.safe_probability = GridF(kCells, kCells, kUnknownValue);
  h.safe_distance_m = GridF(kCells, kCells, 0);
  h.reasons = Grid<std::uint8_t>(kCells, kCells, kHazardUnknown);
  h.ground = Grid<GroundClass>(kCells, kCells);
  for (int r = 1; r + 1 < kCells; ++r) {
    for (int c = 1; c + 1 < kCells; ++c) {
      const double dn = (map.height_m.at(r - 1, c) - map.height_m.at(r + 1, c)) / (2 * kCell_m);
      const double de = (map.height_m.at(r, c + 1) - map.height_m.at(r, c - 1)) / (2 * kCell_m);
      const double slope = std::atan(std::hypot(dn, de));
      if (!std::isfinite(slope)) {
        continue;
      }
      const double rough = 0.02 + 0.25 * std::abs(std::hypot(dn, de)) * kCell_m * 2;
      h.slope_rad.at(r, c) = static_cast<float>(slope);
      h.roughness_m.at(r, c) = static_cast<float>(rough);
      h.step_m.at(r, c) = static_cast<float>(1.4 * rough);
      h.cost.at(r, c) =
          static_cast<float>(std::min(1.0, std::max(slope / max_slope_rad, rough / 0.1)));
      h.reasons.at(r, c) =
          static_cast<std::uint8_t>((slope > max_slope_rad ? kHazardSlope : 0) |
                                    (rough > max_roughness_m ? kHazardRoughness : 0));
    }
  }
  // A wire across a corner, a puddle, somebody walking, a tree's shadow, a table.
  h.flags = Grid<std::uint8_t>(kCells, kCells, kFlagNone);
  const auto near = [](int r, int c, int r0, int c0, int reach) {
    return std::abs(r - r0) <= reach && std::abs(c - c0) <= reach;
  };
  for (int r = 0; r < kCells; ++r) {
    for (int c = 0; c < kCells; ++c) {
      h.flags.at(r, c) = static_cast<std::uint8_t>(
          (std::abs(r + c - kCells / 3) <= 1 ? kFlagThinStructure : 0) |
          (near(r, c, kCells * 4 / 5, kCells * 3 / 5, 5) ? kFlagNoTexture : 0) |
          (near(r, c, kCells / 2, kCells * 9 / 10, 3) ? kFlagMotion : 0) |
          (near(r, c, kCells / 6, kCells * 4 / 5, 6) ? kFlagShadow : 0) |
          (near(r, c, kCells * 9 / 10, kCells / 8, 4) ? kFlagElevated : 0));
    }
  }
  for (int r = 0; r < kCells; ++r) {
    for (int c = 0; c < kCells; ++c) {
      int nearest2 = 1 << 20;
      for (int y = 0; y < kCells; ++y) {
        for (int x = 0; x < kCells; ++x) {
          if (h.reasons.at(y, x) != 0) {
            nearest2 = std::min(nearest2, (y - r) * (y - r) + (x - c) * (x - c));
          }
        }
      }
      h.safe_distance_m.at(r, c) = static_cast<float>(std::sqrt(nearest2) * kCell_m);
      const bool unknown = h.reasons.at(r, c) == kHazardUnknown;
      const bool has_room = h.safe_distance_m.at(r, c) >= 2.3f;  // the clear radius
      h.ground.at(r, c) = unknown                   ? GroundClass::kUnknown
                          : h.reasons.at(r, c) != 0 ? GroundClass::kHazard
                          : has_room                ? GroundClass::kLandable
                                                    : GroundClass::kTooNear;
      ++h.counts[h.ground.at(r, c)];
      h.safe_cells += has_room ? 1 : 0;
    }
  }
  return std::make_shared<const HazardMaps>(std::move(h));
}

/// Grey picture of the ground as the nadir camera sees it.
inline ImageU8 Picture(const PinholeCamera& camera, const RigidTransform& X_WC) {
  ImageU8 picture(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray = X_WC.R * Eigen::Vector3d((x - camera.cx_px) / camera.fx_px,
                                                           (y - camera.cy_px) / camera.fy_px, 1.0);
      const Eigen::Vector3d ground = X_WC.p - ray * (X_WC.p.z() / ray.z());
      const double n = ground.x();
      const double e = ground.y();
      const double dn = Height(n + 0.05, e) - Height(n - 0.05, e);
      const double shade = 150 + 45 * (SmoothNoise(n / 4, e / 4) - 0.5) +
                           22 * (SmoothNoise(n * 6, e * 6) - 0.5) - 260 * dn +
                           14 * (Noise(x, y) - 0.5);
      picture.at(x, y) = static_cast<std::uint8_t>(std::clamp(shade, 0.0, 255.0));
    }
  }
  return picture;
}

/// Verdict per quarter-size pixel, looked up in the hazard maps.
inline std::shared_ptr<const ImageU8> Verdict(const HazardMaps& maps, const PinholeCamera& camera,
                                              const RigidTransform& X_WC) {
  ImageU8 verdict(camera.width / 4, camera.height / 4, 0);
  for (int y = 0; y < verdict.height(); ++y) {
    for (int x = 0; x < verdict.width(); ++x) {
      const Eigen::Vector3d ray =
          X_WC.R * Eigen::Vector3d((4 * x + 1.5 - camera.cx_px) / camera.fx_px,
                                   (4 * y + 1.5 - camera.cy_px) / camera.fy_px, 1.0);
      const Eigen::Vector3d ground = X_WC.p - ray * (X_WC.p.z() / ray.z());
      const auto cell = maps.geometry.CellFromPoint(ground.x(), ground.y());
      if (cell) {
        verdict.at(x, y) = maps.safe_distance_m.at(*cell) > 0.5f ? 1 : 2;
      }
    }
  }
  return std::make_shared<const ImageU8>(std::move(verdict));
}

}  // namespace palace::fake
