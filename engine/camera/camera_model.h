// A camera of any lens family: projection, rays, Jacobians and limits through one set of names.
//
// Points, rays and centres are in the model's frame F and its unit of length: metres, millimetres
// for Willson's files (CameraModel::unit_m). Pixels: (0,0) is the centre of the top-left pixel.
// What lies outside a model's range has no answer; see the family's own header.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Dense>

#include "engine/camera/camera_ray.h"
#include "engine/model/camera_models.h"

namespace palace {

/// Columns and rows of a picture; 0 unknown.
struct PictureSize {
  int width = 0;
  int height = 0;
};

/// Pixel of the point p_FQ, which may lie outside the picture.
std::optional<Eigen::Vector2d> ProjectCamera(const CameraModel& model, const Eigen::Vector3d& p_FQ);
/// The same with its derivative by p_FQ: px per unit of length.
std::optional<ProjectionJacobian> JacobianOfCamera(const CameraModel& model,
                                                   const Eigen::Vector3d& p_FQ);
/// Pixel of the point at infinity along `direction_F` (any length but 0).
std::optional<Eigen::Vector2d> ProjectDirection(const CameraModel& model,
                                                const Eigen::Vector3d& direction_F);
/// Ray through the pixel.
std::optional<CameraRay> RayFromPixelCamera(const CameraModel& model, const Eigen::Vector2d& pixel);

int WidthOf(const CameraModel& model);   ///< pixels; 0 unknown
int HeightOf(const CameraModel& model);  ///< pixels; 0 unknown
bool HasSize(const CameraModel& model);
void SetSize(CameraModel& model, int width, int height);

/// The linear part of a camera: its rays without distortion. For CAHV its exact model, for the
/// other families the pinhole that is left when all distortion terms are 0; O = A.
CahvorModel LinearPartOf(const CameraModel& model);
/// Camera axes (x = H', y = A x H', z = A of the linear part) from F.
Eigen::Matrix3d RotationOf(const CameraModel& model);
/// Projection centre in F (CAHVORE: of rays along O).
Eigen::Vector3d CentreOf(const CameraModel& model);
/// The same camera in the frame G of which F is a part: p_G = R_GF p_F + t_GF, unit of length kept.
CameraModel MovedCamera(CameraModel model, const Eigen::Matrix3d& R_GF,
                        const Eigen::Vector3d& t_GF);
/// The same camera with another unit of length, e.g. 1 for metres.
CameraModel InUnit(CameraModel model, double unit_m);

/// "CAHV", "CAHVOR", "CAHVORE type 3, linearity 0.37", "Tsai", "pinhole", "OpenCV 5", "fisheye".
std::string FamilyOf(const CameraModel& model);

}  // namespace palace
