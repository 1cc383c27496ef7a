// OpenCV's cameras: pinhole with the polynomial, rational, thin-prism and tilted distortion, and
// the equidistant fisheye.
//
//   p_C = R_CF p_F + t_CF,  (a, b) = (x/z, y/z),  r^2 = a^2 + b^2
//   polynomial  g = (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6)
//               a' = a g + 2 p1 a b + p2 (r^2 + 2 a^2) + s1 r^2 + s2 r^4
//               b' = b g + p1 (r^2 + 2 b^2) + 2 p2 a b + s3 r^2 + s4 r^4, then the tilt of the
//               sensor
//   fisheye     theta = angle from the axis, a' = theta (1 + k1 theta^2 + ... + k4 theta^8) a / r
//   x_px = fx a' + cx,  y_px = fy b' + cy
//
// The model ends where, on the way from the axis, its radial part no longer grows or its 2x2
// derivative no longer keeps orientation: two directions would share a pixel. Points and pixels
// beyond that have no answer, even where the derivative recovers farther out, as have points at or
// behind the focal plane (fisheye: on the axis behind the camera).
// Source: OpenCV 4.6 calib3d documentation; Brown 1971; Kannala & Brandt 2006.
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/camera/camera_ray.h"
#include "engine/model/camera_models.h"

namespace palace {

/// Pixel of the point p_FQ.
std::optional<Eigen::Vector2d> ProjectOpenCv(const OpenCvModel& model, const Eigen::Vector3d& p_FQ);
/// The same with its derivative by p_FQ.
std::optional<ProjectionJacobian> JacobianOfOpenCv(const OpenCvModel& model,
                                                   const Eigen::Vector3d& p_FQ);
/// Ray through the pixel: Newton's method, continued from the centre of the picture where it would
/// otherwise leave the model's range.
std::optional<CameraRay> RayFromPixelOpenCv(const OpenCvModel& model, const Eigen::Vector2d& pixel);

}  // namespace palace
