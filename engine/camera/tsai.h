// Tsai's camera model in Willson's conventions.
//
//   p_C = R p_F + T,  R = Rz Ry Rx
//   Xu = f x/z, Yu = f y/z                       undistorted sensor coordinates
//   (Xu, Yu) = (Xd, Yd) (1 + kappa1 Rd^2)        the explicit direction is the undistorting one
//   x_px = Xd sx / dpx + Cx,  y_px = Yd / dpy + Cy
//
// For kappa1 < 0 the model ends at Rd = sqrt(-1/(3 kappa1)): points and pixels beyond it have no
// answer, as have points at or behind the focal plane. Lengths of F are those of T (millimetres in
// Willson's files).
// Source: Tsai 1987; Willson, Tsai 3.0b3. Thesis section 4.1 with errata E13 and E14.
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/camera/camera_ray.h"
#include "engine/model/camera_models.h"

namespace palace {

/// Rz Ry Rx.
Eigen::Matrix3d RotationOfTsai(const TsaiModel& model);
/// Sets the three angles so that RotationOfTsai gives R_CF.
void SetRotationOfTsai(TsaiModel& model, const Eigen::Matrix3d& R_CF);
/// Pixel of the point p_FQ.
std::optional<Eigen::Vector2d> ProjectTsai(const TsaiModel& model, const Eigen::Vector3d& p_FQ);
/// The same with its derivative by p_FQ.
std::optional<ProjectionJacobian> JacobianOfTsai(const TsaiModel& model,
                                                 const Eigen::Vector3d& p_FQ);
/// Ray through the pixel.
std::optional<CameraRay> RayFromPixelTsai(const TsaiModel& model, const Eigen::Vector2d& pixel);

}  // namespace palace
