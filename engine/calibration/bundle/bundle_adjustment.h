// Bundle adjustment of a stereo rig: both lenses, the right camera's place and every target pose in
// one least-squares problem.
//
//   minimise  sum over points  rho(| observed - ProjectDot(lens_k, X_CkC0 X_C0T(view), p_T) |)
//             + weak priors on the lenses
//
// The frame of the rig is the left camera's own axes, C0, which fixes the gauge; the target fixes
// the scale. Levenberg-Marquardt; each pose touches its own view only, so the poses are eliminated
// (Schur complement) and a step solves for the 22 camera parameters.
// Source: Triggs et al. 2000, "Bundle adjustment - a modern synthesis", sections 4 and 6.
#pragma once

#include <array>
#include <vector>

#include "engine/calibration/lens.h"
#include "engine/calibration/target_observation.h"
#include "engine/core/result.h"
#include "engine/model/calibration_target.h"

namespace palace {

/// Order of the camera parameters: left lens, right lens, rotation of C1 (small angles about the
/// axes of C1, rad), centre p_C0C1 (m).
inline constexpr int kRightLens = kLensSize;
inline constexpr int kRightRotation = 2 * kLensSize;
inline constexpr int kRightCentre = kRightRotation + 3;
inline constexpr int kCameraSize = kRightCentre + 3;
using CameraVector = Eigen::Matrix<double, kCameraSize, 1>;
using CameraMatrix = Eigen::Matrix<double, kCameraSize, kCameraSize>;

struct RigEstimate {
  std::array<Lens, 2> lens{Lens::Zero(), Lens::Zero()};
  RigidTransform X_C0C1;
  std::vector<RigidTransform> X_C0T;  ///< one a view
};

/// Standard deviations that keep what the data do not determine near zero: a lens without
/// distortion has no optical axis to find. 0.05 rad is 3 degrees, several times what a lens
/// is out of square by.
struct LensPrior {
  double axis_sigma = 0.05;
  double rho1_sigma = 1;
  double rho2_sigma = 5;
};

struct BundleOptions {
  std::array<bool, kCameraSize> free{};  ///< camera parameters that may move
  bool poses_free = true;
  bool robust = true;  ///< Cauchy's loss; false: plain least squares
  LensPrior prior;
  int max_iterations = 60;
  double cost_tolerance = 1e-12;  ///< relative decrease of the cost that counts as arrived
};

/// One residual, observed minus predicted.
struct PointResidual {
  int view = 0;
  int side = 0;  ///< 0 left, 1 right
  int index = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();     ///< observed
  Eigen::Vector2d error_px = Eigen::Vector2d::Zero();  ///< NaN where nothing is predicted
  /// Observed place of the dot's centre: the pixel less the eccentricity that ProjectDot predicts.
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
};

struct BundleResult {
  RigEstimate estimate;
  CameraMatrix covariance = CameraMatrix::Zero();  ///< zero rows for parameters not free
  double sigma_px = 0;  ///< of one coordinate, from the residuals and the degrees of freedom
  int iterations = 0;
  bool converged = false;
};

std::vector<PointResidual> Residuals(const CalibrationTarget& target,
                                     const std::vector<TargetView>& views,
                                     const RigEstimate& estimate);

/// Starts from `start`, whose X_C0T must have one pose a view. Fails when the start sees too few
/// points, and when the normal equations cannot be solved.
Result<BundleResult> AdjustBundle(const CalibrationTarget& target,
                                  const std::vector<TargetView>& views, const RigEstimate& start,
                                  const BundleOptions& options);

}  // namespace palace
