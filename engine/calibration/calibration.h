// Stereo calibration: views of the target in, two CAHVOR models with their covariance out.
//
// Closed-form start (tsai_start.h), each camera alone, then one bundle adjustment of both cameras
// and all poses (bundle_adjustment.h): first with a robust loss, then by plain least squares after
// points beyond `reject_sigma` are taken out. The target's pitch is the only source of scale: a
// wrong pitch cannot be seen, and scales the baseline with it.
// Thesis 4.1.3 fits CAHVOR to points that Tsai's model back-projected; here Tsai only starts the
// fit (erratum E18).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/calibration/bundle/bundle_adjustment.h"
#include "engine/calibration/target_observation.h"
#include "engine/core/result.h"
#include "engine/model/calibration_target.h"
#include "engine/model/rig.h"

namespace palace {

struct CalibrationOptions {
  int width = 0;  ///< of both cameras' pictures
  int height = 0;
  int hold_out_every = 4;         ///< every fourth view stays out of a second fit; 0: none
  int min_views_held_out = 8;     ///< with fewer views none is spared
  double reject_sigma = 4.5;      ///< points farther out are outliers
  int min_views = 4;              ///< fewer are refused
  double min_tilt_rad = 0.26;     ///< 15 degrees: a view counts as tilted
  int min_tilted_views = 3;       ///< fewer are refused
  double min_spread_rad = 0.26;   ///< angle between the two most different board normals
  double max_focal_sigma = 0.01;  ///< share of the focal length; beyond it the fit is refused
  LensPrior prior;
};

struct ViewResult {
  std::string name;        ///< of the left picture
  std::string right_name;  ///< may be empty
  RigidTransform X_C0T;
  double tilt_rad = 0;    ///< of the board against the left picture plane
  double distance_m = 0;  ///< of the board's middle
  int left_points = 0;    ///< seen, outliers included
  int right_points = 0;
  int left_outliers = 0;
  int right_outliers = 0;
  int outliers() const { return left_outliers + right_outliers; }
  double left_rms_px = 0;  ///< root mean square length of the residual; NaN where none was seen
  double right_rms_px = 0;
  bool held_out = false;       ///< of the fit behind held_out_rms_px
  double held_out_rms_px = 0;  ///< with cameras that never saw this view; NaN for the others
};

struct Calibration {
  int width = 0;
  int height = 0;
  RigEstimate estimate;     ///< from all views
  CameraMatrix covariance;  ///< of the 22 camera parameters
  double sigma_px = 0;      ///< of one coordinate of one point
  double left_rms_px = 0;   ///< root mean square length of the residuals, outliers left out
  double right_rms_px = 0;
  double held_out_rms_px = 0;  ///< NaN when no view was held out
  int points = 0;
  int outliers = 0;
  std::vector<ViewResult> views;  ///< those that took part, in the order given
  /// Cameras fitted without the held-out views, and the poses of all views in them.
  std::optional<RigEstimate> held_out_estimate;
  std::vector<PointResidual> residuals;  ///< outliers left out
  std::vector<PointResidual> rejected;

  CahvorModel LeftModel() const;
  CahvorModel RightModel() const;
  double baseline_m() const { return estimate.X_C0C1.p.norm(); }
  double baseline_sigma_m() const;
};

/// Refuses, with the reason and what to do: too few views or tilts, parallel boards, cameras that
/// see no common board, swapped, doubled or (a third and more of them) wrongly paired pictures,
/// parameters that the views do not determine. Views seen by one camera only help that camera;
/// sides with fewer than 12 points and views without any are left out.
Result<Calibration> Calibrate(const CalibrationTarget& target, const std::vector<TargetView>& views,
                              const CalibrationOptions& options);

}  // namespace palace
