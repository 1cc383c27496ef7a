// Vision fix: the position of the body that one tracked picture gives, with its covariance.
//
// Plane mode: resection of the camera from the landmarks with the AHRS attitude as prior. Template
// mode: equations 3.1-3.12 with the laser. Both end with the lever arm to the body.
//
// Two kinds of error are told apart, after reference simulation.md 4.1. `measurement` carries what
// differs from picture to picture: pixels, laser, noise of the attitude. A filter averages it, and
// innovations are gated by it. What all pictures share is SharedErrors, and is stated on top; what
// can be learned of it is turned back (landmark_frame.h).
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/core/result.h"
#include "engine/model/landing_site.h"
#include "engine/model/rig.h"
#include "engine/model/settings/settings.h"
#include "engine/navigation/inertial_kalman.h"
#include "engine/navigation/landmark_frame.h"
#include "engine/navigation/shared_errors.h"
#include "engine/tracking/site_tracker.h"

namespace palace {

/// What one picture says. All of it holds in `frame`, which has learned from the picture, and is
/// that of the fixes from then on if the filter takes this one.
struct VisionFix {
  PositionMeasurement measurement;
  SharedErrors shared;
  LandmarkFrame frame;
  /// By how much the picture moves all positions before it, for `frame` knows more than they did.
  Eigen::Vector3d frame_shift_W = Eigen::Vector3d::Zero();
  /// c of R = exp([c]x) R_WB, axes of W: from the attitude as told to that by the landmarks, which
  /// are turned back as in `frame`. Zero in template mode.
  Eigen::Vector3d attitude_correction_W = Eigen::Vector3d::Zero();

  /// In the frame of the fixes before it.
  PositionMeasurement AsBefore() const {
    PositionMeasurement before = measurement;
    before.p_WB -= frame_shift_W;
    return before;
  }
};

/// Enough of the picture may be trusted: the anchor coheres, or, where only the site's own patch is
/// hidden (a bird, a shadow), at least 12 landmarks and most of those visible agree.
bool TrackIsTrusted(const TrackResult& track, const TrackingSettings& settings);

/// `frame`: of the fixes that were taken before. `felt`: at the time of the picture.
Result<VisionFix> FixFromLandmarks(const TrackResult& track, const PinholeCamera& camera,
                                   const StereoRig& rig, const Eigen::Matrix3d& R_WB,
                                   const LandingSite& site, const AttitudeErrors& attitude,
                                   const std::optional<FeltBias>& felt, const LandmarkFrame& frame);
/// `laser_m` along the optical axis, taken with the picture.
Result<VisionFix> FixFromSitePixel(const TrackResult& track, const PinholeCamera& camera,
                                   const StereoRig& rig, const Eigen::Matrix3d& R_WB,
                                   double laser_m, const LandingSite& site,
                                   const AttitudeErrors& attitude);

}  // namespace palace
