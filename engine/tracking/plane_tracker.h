// PlaneTracker: many features on the ground around the site, anchored in a keyframe.
//
// Each landmark has a place in W, fixed when it is made, and a pixel in the keyframe. A picture is
// tracked from the keyframe, not from the picture before, so errors do not add up from frame to
// frame (Matthews, Ishikawa & Baker 2004, the template update problem). The camera's pose is
// resected from the landmarks. A new keyframe is cut when the scale has changed by 1.4 or half of
// the landmarks are gone: those still seen keep their place in W and get a new pixel, new ones get
// theirs from the refined pose, the plane of the site and the range map. No keyframe is cut while
// the coherence is low: an occluder must not become the anchor. One may all the same, a shadow's
// edge that passes, so earlier keyframes are kept and tried again while the newest is lost.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/time.h"
#include "engine/model/image.h"
#include "engine/model/landing_site.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"
#include "engine/tracking/site_tracker.h"
#include "engine/tracking/view_geometry.h"

namespace palace {

class PlaneTracker {
 public:
  /// Arguments as SiteTracker::Lock.
  void Lock(const ImageU8& left, const PinholeCamera& camera, const RigidTransform& X_WC,
            const RangeMap* range, const LandingSite& site, const TrackingSettings& settings);
  bool anchored() const;
  bool locked() const { return locked_; }
  /// A predicted pose, made better by what the last good picture corrected of its own.
  RigidTransform Corrected(const RigidTransform& X_WC_predicted) const {
    return {X_WC_predicted.R * correction_R_, X_WC_predicted.p + correction_p_W_};
  }
  TrackResult Track(const ImageU8& left, const PinholeCamera& camera,
                    const RigidTransform& X_WC_predicted, const RangeMap* range,
                    const TrackingSettings& settings, Timestamp time);

 private:
  struct Landmark {
    Eigen::Vector3d p_WF = Eigen::Vector3d::Zero();
    Eigen::Vector2d key_pixel = Eigen::Vector2d::Zero();
    double sigma_w_m = 0;
    int outlier_frames = 0;  ///< seen, but moving on its own
  };
  struct Keyframe {
    ImageU8 picture{};
    RigidTransform X_WC{};  ///< camera when it was cut
    std::vector<Landmark> landmarks{};
    std::size_t landmarks_when_cut = 0;
  };
  /// One attempt at a picture.
  struct Attempt {
    RigidTransform X_WC;  ///< refined when ok, else as predicted
    std::vector<Eigen::Vector2d> pixels;
    std::vector<bool> visible;
    std::vector<bool> inlier;
    int visible_count = 0;
    int inliers = 0;
    double rms_px = 0;
    bool ok = false;
  };

  /// R_prior: the attitude as given; X_WC: where to look, with the last correction.
  Attempt Try(const ImageU8& left, const PinholeCamera& camera, const RigidTransform& X_WC,
              const Eigen::Matrix3d& R_prior, const Eigen::Vector2d& shift_px) const;
  Attempt BestAttempt(const ImageU8& left, const PinholeCamera& camera,
                      const RigidTransform& X_WC_predicted, const TrackingSettings& settings) const;
  /// From one of the earlier keyframes, another with each picture that is lost. The one that sees
  /// the ground again is the keyframe from then on, and those cut after it are forgotten.
  Attempt TryEarlier(const ImageU8& left, const PinholeCamera& camera,
                     const RigidTransform& X_WC_predicted);
  void Resect(const PinholeCamera& camera, const Eigen::Matrix3d& R_prior, Attempt& attempt) const;
  bool NeedsKeyframe(const Attempt& attempt, double coherence,
                     const TrackingSettings& settings) const;
  void CutKeyframe(const ImageU8& left, const PinholeCamera& camera, const RigidTransform& X_WC,
                   const RangeMap* range, const TrackingSettings& settings,
                   std::vector<Landmark> kept);
  void AddLandmarks(const PinholeCamera& camera, const RangeMap* range,
                    const TrackingSettings& settings);
  void NoteOutliers(const Attempt& attempt);
  double MeanDistance(const Eigen::Vector3d& p_WC) const;
  Eigen::Vector2d PatchCentre(const PinholeCamera& camera, const Attempt& attempt) const;
  static std::string WhyNotLocked(const Attempt& attempt);
  TrackerStatus Describe(const ImageU8& left, const PinholeCamera& camera, const Attempt& attempt,
                         const TrackingSettings& settings, Timestamp time) const;

  GroundPlane plane_;
  Keyframe key_;
  std::deque<Keyframe> earlier_;  ///< the newest last
  /// Refined minus predicted pose of the last good picture: the next prediction starts there.
  Eigen::Vector3d correction_p_W_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d correction_R_ = Eigen::Matrix3d::Identity();
  int keyframes_ = 0;
  int frames_lost_ = 0;
  bool locked_ = false;
};

}  // namespace palace
