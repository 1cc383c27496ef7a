// Geometry between a pinhole camera and the plane of the ground.
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/camera/pinhole.h"
#include "engine/core/frames.h"
#include "engine/model/rig.h"

namespace palace {

/// The plane through the site; normal_W is a unit vector that points up.
struct GroundPlane {
  Eigen::Vector3d p_WS = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_W = -Eigen::Vector3d::UnitZ();

  double HeightOf(const Eigen::Vector3d& p_W) const { return normal_W.dot(p_W - p_WS); }
};

/// Nothing when the point is not at least 5 cm in front of the camera.
std::optional<Eigen::Vector2d> PixelFromCameraPoint(const PinholeCamera& camera,
                                                    const Eigen::Vector3d& p_C);
std::optional<Eigen::Vector2d> PixelFromWorldPoint(const PinholeCamera& camera,
                                                   const RigidTransform& X_WC,
                                                   const Eigen::Vector3d& p_W);
/// Depth along the optical axis at which the pixel's ray meets the plane. Nothing when the camera
/// is below the plane or the ray is within 3 degrees of it.
std::optional<double> PlaneDepth(const PinholeCamera& camera, const RigidTransform& X_WC,
                                 const GroundPlane& plane, const Eigen::Vector2d& pixel);
/// Pixels of view B from pixels of view A for points of the plane: K (R + t n'/d) K^-1 with X_BA =
/// (R, t), n'p = d the plane in A (Faugeras & Lustman 1988). Nothing when A is not above the plane.
std::optional<Eigen::Matrix3d> PlaneHomography(const PinholeCamera& camera,
                                               const RigidTransform& X_WA,
                                               const RigidTransform& X_WB,
                                               const GroundPlane& plane);
Eigen::Vector2d MapPixel(const Eigen::Matrix3d& b_from_a, const Eigen::Vector2d& pixel);
/// The pixel lies in the picture, at least `margin_px` from its edge.
bool InPicture(const PinholeCamera& camera, const Eigen::Vector2d& pixel, double margin_px);

}  // namespace palace
