// Vision fix: the position of the body that one tracked picture gives, with its covariance.
//
// Plane mode: resection of the camera from the landmarks with the AHRS attitude as prior. Template
// mode: equations 3.1-3.12 with the laser. Both end with the lever arm to the body.
// Covariance, after reference simulation.md 4.1: what the landmarks or the pixel scatter, plus what
// does not whiten (attitude in template mode, the place of the plane as a share of the distance).
#pragma once

#include <Eigen/Dense>

#include "engine/core/result.h"
#include "engine/model/landing_site.h"
#include "engine/model/rig.h"
#include "engine/model/settings/settings.h"
#include "engine/navigation/inertial_kalman.h"
#include "engine/tracking/site_tracker.h"

namespace palace {

struct VisionFix {
  PositionMeasurement measurement;
  /// Rotation vector in W that takes the AHRS attitude to the one the landmarks show; zero in
  /// template mode.
  Eigen::Vector3d attitude_correction_W = Eigen::Vector3d::Zero();
};

/// Enough of the picture may be trusted: the anchor coheres, or, where only the site's own patch is
/// hidden (a bird, a shadow), at least 12 landmarks and most of those visible agree.
bool TrackIsTrusted(const TrackResult& track, const TrackingSettings& settings);

Result<VisionFix> FixFromLandmarks(const TrackResult& track, const PinholeCamera& camera,
                                   const StereoRig& rig, const Eigen::Matrix3d& R_WB);
/// `laser_m` along the optical axis, taken with the picture.
Result<VisionFix> FixFromSitePixel(const TrackResult& track, const PinholeCamera& camera,
                                   const StereoRig& rig, const Eigen::Matrix3d& R_WB,
                                   double laser_m, const LandingSite& site);

}  // namespace palace
