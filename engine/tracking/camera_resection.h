// Camera resection: position of a camera, and a small correction of its attitude, from landmarks.
//
// Minimises  sum_i rho(|z_i - pi(R_CW (p_i - p_WC))|^2 / s_i^2) + |theta|^2 / sigma_theta^2
// over p_WC and a rotation vector theta (camera axes) on top of the prior attitude R_WC_prior;
// s_i^2 = sigma_px^2 + (f sigma_w / Z)^2. Start: the linear solution with the prior attitude,
// sum (I - u u') (p_i - p_WC) = 0 with u the unit ray of pixel i in W. Then Gauss-Newton, Huber
// (1964) weights first, Tukey's biweight (Beaton & Tukey 1974) once settled; scale by MAD.
// It lives with the tracker because new keyframes need the refined pose; navigation uses it too.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/result.h"
#include "engine/core/units.h"
#include "engine/model/rig.h"
#include "engine/tracking/landmark.h"

namespace palace {

struct ResectionOptions {
  double attitude_sigma_rad = Rad(0.3);  ///< per axis; 0 holds the prior attitude fixed
  int max_iterations = 12;
};

struct Resection {
  RigidTransform X_WC;
  /// Of p_WC in W, attitude uncertainty included. Independent errors only: what all landmarks share
  /// (a plane that is off, a scale) is not in it.
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  double rms_px = 0;  ///< of the inliers
  int inliers = 0;
  std::vector<bool> inlier;  ///< one per landmark
};

/// Invalid when fewer than 4 landmarks are given or remain, when they lie in one direction, or when
/// the solution puts most of them behind the camera.
Result<Resection> ResectCamera(const std::vector<GroundLandmark>& landmarks,
                               const PinholeCamera& camera, const Eigen::Matrix3d& R_WC_prior,
                               const ResectionOptions& options = {});

}  // namespace palace
