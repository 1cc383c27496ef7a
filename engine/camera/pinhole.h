// Pinhole camera: the projection of an undistorted, rectified picture.
//
//   x_px = fx X/Z + cx,  y_px = fy Y/Z + cy     p_CQ = (X, Y, Z) in C, metres
//
// Camera axes right, down, forward; pixel (0,0) is the centre of the top-left pixel, so a picture
// of W columns spans x = -0.5 .. W - 0.5 and its centre is (W - 1) / 2.
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/model/rig.h"

namespace palace {

/// Square pixels, centred principal point: f = (W / 2) / tan(hfov / 2), c = ((W-1)/2, (H-1)/2).
/// The field of view is measured from picture edge to picture edge. 0 < hfov < pi.
/// Source: thesis equation 3.1 with errata E1 (tan, not arctan) and E2 (pixel centres).
PinholeCamera PinholeFromFov(int width, int height, double hfov_rad);

/// Pixel of the point p_CQ, which may lie outside the picture. Nothing for points at or behind the
/// focal plane (Z <= 1e-6 m) and for values that are not finite.
std::optional<Eigen::Vector2d> ProjectPinhole(const PinholeCamera& camera,
                                              const Eigen::Vector3d& p_CQ);

/// Ray through the pixel in C, scaled to unit depth: (X/Z, Y/Z, 1).
Eigen::Vector3d RayFromPixel(const PinholeCamera& camera, const Eigen::Vector2d& pixel);

/// True when the pixel lies on the picture, its outer half pixels included; false for NaN.
bool InPicture(const PinholeCamera& camera, const Eigen::Vector2d& pixel);

}  // namespace palace
