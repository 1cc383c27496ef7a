// Vision fix: the position of the body that one tracked picture gives, with its covariance.
//
// Plane mode: resection of the camera from the landmarks with the AHRS attitude as prior. Template
// mode: equations 3.1-3.12 with the laser. Both end with the lever arm to the body.
//
// Two kinds of error are told apart, after reference simulation.md 4.1. `measurement` carries what
// differs from picture to picture: pixels, laser, noise of the attitude. A filter averages it, and
// innovations are gated by it. What all pictures share is SharedErrors, and is stated on top.
//
// Where the landmarks lie was worked out with one attitude. Resection shows every attitude since
// then against it, so the mean of the differences is that one attitude's own noise: LandmarkFrame
// turns the fixes back by it. What remains is noise / sqrt(pictures). The attitude's bias is in all
// of them and shows in none.
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/core/result.h"
#include "engine/core/units.h"
#include "engine/model/landing_site.h"
#include "engine/model/rig.h"
#include "engine/model/settings/settings.h"
#include "engine/navigation/inertial_kalman.h"
#include "engine/navigation/shared_errors.h"
#include "engine/tracking/site_tracker.h"

namespace palace {

/// Of the attitude that the vehicle tells, one standard deviation of each axis. No message tells
/// them; the default: the attitude reference of the R-50's file.
struct AttitudeErrors {
  double noise_rad = Rad(0.1);  ///< from one pose to the next
  double bias_rad = Rad(0.15);  ///< what all poses of an approach share
};

struct VisionFix {
  PositionMeasurement measurement;
  SharedErrors shared;
  /// By how much this picture moved all positions before it: what is known of LandmarkFrame grew.
  Eigen::Vector3d frame_shift_W = Eigen::Vector3d::Zero();
  /// Rotation vector in W that takes the AHRS attitude to the one the landmarks show; zero in
  /// template mode.
  Eigen::Vector3d attitude_correction_W = Eigen::Vector3d::Zero();
};

/// How the landmarks of one site are turned against the mean attitude since they were placed.
class LandmarkFrame {
 public:
  /// What the landmarks say of one picture, beside the attitude told of it.
  void Add(const RigidTransform& X_WC_resected, const Eigen::Matrix3d& R_WC_told);
  /// A pose by the landmarks, in W as the mean attitude has it: turned about where they were placed
  /// from, the site kept at its height, for there the tracker laid the ground. As given before the
  /// first Add.
  RigidTransform Levelled(const RigidTransform& X_W, const Eigen::Vector3d& p_WS) const;
  const Eigen::Vector3d& placed_from_W() const { return placed_from_W_; }
  int pictures() const { return pictures_; }

 private:
  int pictures_ = 0;
  Eigen::Vector3d placed_from_W_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_W_ = Eigen::Vector3d::Zero();  ///< rotation vector, mean
};

/// Enough of the picture may be trusted: the anchor coheres, or, where only the site's own patch is
/// hidden (a bird, a shadow), at least 12 landmarks and most of those visible agree.
bool TrackIsTrusted(const TrackResult& track, const TrackingSettings& settings);

/// `frame` learns of the picture.
Result<VisionFix> FixFromLandmarks(const TrackResult& track, const PinholeCamera& camera,
                                   const StereoRig& rig, const Eigen::Matrix3d& R_WB,
                                   const LandingSite& site, const AttitudeErrors& attitude,
                                   LandmarkFrame& frame);
/// `laser_m` along the optical axis, taken with the picture.
Result<VisionFix> FixFromSitePixel(const TrackResult& track, const PinholeCamera& camera,
                                   const StereoRig& rig, const Eigen::Matrix3d& R_WB,
                                   double laser_m, const LandingSite& site,
                                   const AttitudeErrors& attitude);

}  // namespace palace
