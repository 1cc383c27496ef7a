// The lens of one camera in its own axes: CAHVOR written so that its parameters can be fitted.
//
//   O = (o1, o2, 1) / |(o1, o2, 1)|,  zeta = p.O,  lambda = p - zeta O,  tau = |lambda|^2 / zeta^2,
//   p' = p + (rho1 tau + rho2 tau^2) lambda
//   x = hs p'_x / p'_z + hc,   y = vs p'_y / p'_z + vc
//
// p in C, metres. rho0 = 0 (it is a scale of hs and vs) and theta = -90 degrees (rows perpendicular
// to columns), so A, H', V' are the axes of C. o1, o2 are tangents of the angles between the
// optical axis O and A. Source: Gennery 2006; vision reference section 2.2.
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/rig.h"

namespace palace {

enum LensIndex { kHs, kHc, kVs, kVc, kO1, kO2, kRho1, kRho2, kLensSize };
using Lens = Eigen::Matrix<double, kLensSize, 1>;

/// A projected pixel with its derivatives.
struct LensProjection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> by_point;         ///< d pixel / d p_CQ, px/m
  Eigen::Matrix<double, 2, kLensSize> by_lens;  ///< d pixel / d lens
};

/// Nothing behind the camera and where the distortion folds over, as ProjectCahvor.
std::optional<Eigen::Vector2d> PixelThroughLens(const Lens& lens, const Eigen::Vector3d& p_CQ);
std::optional<LensProjection> ProjectThroughLens(const Lens& lens, const Eigen::Vector3d& p_CQ);

/// Where the centroid of a dot's picture lies. A circle seen at a slant becomes an oval whose
/// centroid is not the picture of the circle's centre; with pi the projection of the target's plane
/// and D the determinant of its derivative,
///   centroid = integral of pi D over the dot / integral of D,
/// here by the four-point rule of degree 3 on the disc, (+-r/2, +-r/2): perspective and distortion
/// to second order in the dot's size, error of order (r / distance)^2 of the correction itself.
/// Derivatives are those of the centre. Diameter 0 gives the centre.
/// Source: Heikkila 2000 (the effect); the rule: Stroud 1971, S2 3-1.
std::optional<LensProjection> ProjectDot(const Lens& lens, const RigidTransform& X_CT,
                                         const Eigen::Vector3d& p_TQ, double diameter_m);

/// The model in frame F of a camera whose axes are X_FC.
CahvorModel CahvorFromLens(const Lens& lens, const RigidTransform& X_FC, int width, int height);

/// The lens of a model with its axes X_FC; a row shear (theta other than -90 degrees) and R0 are
/// dropped.
Lens LensFromCahvor(const CahvorModel& model, RigidTransform& X_FC);

}  // namespace palace
