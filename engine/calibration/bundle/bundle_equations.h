// Normal equations of the bundle adjustment, and their solution with the poses eliminated.
//
//   [U  W; W^T  V] [d camera; d poses] = [gradient; pose gradient],  V block-diagonal, so
//   S = U - sum over views W_v V_v^-1 W_v^T   (Schur complement)  holds the cameras alone
//
// Internal to the room. Everything in px^2.
#pragma once

#include <optional>
#include <vector>

#include "engine/calibration/bundle/bundle_adjustment.h"

namespace palace {

using Pose6 = Eigen::Matrix<double, 6, 1>;
using Pose66 = Eigen::Matrix<double, 6, 6>;
using CameraPose = Eigen::Matrix<double, kCameraSize, 6>;

/// Normal equations of one linearisation, [U W; W^T V] with V block-diagonal. Everything in px^2.
struct NormalEquations {
  CameraMatrix U = CameraMatrix::Zero();
  CameraVector gradient = CameraVector::Zero();
  std::vector<CameraPose> W;
  std::vector<Pose66> V;
  std::vector<Pose6> pose_gradient;
};

struct BundleStep {
  CameraVector camera = CameraVector::Zero();
  std::vector<Pose6> poses;
};

/// The step of the damped equations (each diagonal times 1 + damping); nothing when they are not
/// positive.
std::optional<BundleStep> SolveEquations(const NormalEquations& n, const BundleOptions& options,
                                         double damping);

/// sigma^2 times the camera block of the inverse, zero rows for parameters not free; nothing when
/// it is singular.
std::optional<CameraMatrix> CameraCovariance(const NormalEquations& n, const BundleOptions& options,
                                             double sigma_px);

}  // namespace palace
