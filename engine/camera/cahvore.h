// CAHVORE: the JPL model of wide-angle and fisheye lenses.
//
//   zeta = (P-C).O,  lambda = (P-C) - zeta O,  theta from the moving entrance pupil:
//     zeta sin(theta) - |lambda| cos(theta) = (theta - sin(theta)) e(theta)
//     e(theta) = E0 + E1 theta^2 + E2 theta^4
//   chi = tan(L theta)/L for L > 0, theta for L = 0, sin(L theta)/L for L < 0   (L: linearity)
//   P' = (|lambda|/chi) O + (1 + R0 + R1 chi^2 + R2 chi^4) lambda,  then CAHV with P'
//
// The projection centre of a ray lies at C + (theta/sin(theta) - 1) e(theta) O. Rays may come from
// beyond 90 degrees where the lens allows it. Nothing comes back for points on the axis behind the
// camera (within 1e-8 rad, moving pupil or not), L theta at or over 90 degrees, a distortion that
// no longer rises, and pupils that run away from the axis faster than the ray turns; never a
// clamped value.
//
// Source: Gennery 2006, "Generalized camera calibration including fish-eye lenses".
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/camera/camera_ray.h"
#include "engine/model/camera_models.h"

namespace palace {

/// Pixel of the point p_FQ.
std::optional<Eigen::Vector2d> ProjectCahvore(const CahvoreModel& model,
                                              const Eigen::Vector3d& p_FQ);
/// The same with its derivative by p_FQ.
std::optional<ProjectionJacobian> JacobianOfCahvore(const CahvoreModel& model,
                                                    const Eigen::Vector3d& p_FQ);
/// Pixel of the point at infinity along `direction` (any length but 0), where the pupil's place
/// does not count.
std::optional<Eigen::Vector2d> ProjectDirectionCahvore(const CahvoreModel& model,
                                                       const Eigen::Vector3d& direction);
/// Ray through the pixel; its origin is the pupil of that ray.
std::optional<CameraRay> RayFromPixelCahvore(const CahvoreModel& model,
                                             const Eigen::Vector2d& pixel);

}  // namespace palace
