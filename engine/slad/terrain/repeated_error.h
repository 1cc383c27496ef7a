// What every frame of a hover repeats of its errors, and no mean of them removes. Internal to the
// SLAD room.
#pragma once

#include <cmath>

#include <Eigen/Dense>

#include "engine/model/rig.h"

namespace palace {

/// Of one pixel by itself it has so many times the variance of stereo's window: 0.15 px against
/// 0.012.
inline constexpr double kRepeatedByPixel = 156;

/// Of stereo's window the worst textures repeat so many times the usual error.
inline constexpr double kWorstTexture = 2.5;

/// From where a map is seen.
struct Viewpoint {
  const PinholeCamera& camera;
  Eigen::Vector3d p_WC;

  double Range_m(const Eigen::Vector3d& p_WQ) const { return (p_WQ - p_WC).norm(); }
  /// Metres across that a pixel sees there.
  double Pixel_m(const Eigen::Vector3d& p_WQ) const { return Range_m(p_WQ) / camera.fx_px; }
  /// Variance of the height of a level square about the point, `stereo_m2` being that of stereo's
  /// window: that of a pixel over the pixels of the square.
  double RepeatedVariance(const Eigen::Vector3d& p_WQ, double square_m, double stereo_m2) const {
    const double across_px = square_m / Pixel_m(p_WQ);
    const double steepness = std::abs(p_WQ.z() - p_WC.z()) / Range_m(p_WQ);
    return stereo_m2 * (1 + kRepeatedByPixel / (across_px * across_px * steepness));
  }
};

}  // namespace palace
