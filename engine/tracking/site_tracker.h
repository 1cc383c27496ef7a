// SiteTracker: follows the ground at the landing site from picture to picture.
//
// TrackerMode::kPlane (modern, plane_tracker.h): many features on the ground around the site, each
// anchored in a keyframe and carrying a world position. TrackerMode::kTemplate (thesis 3.1,
// template_tracker.h): one template, refreshed every frame. The mode is read at Lock and stays
// until the next Lock. Both run on every picture, with some features beside them, each alone
// (tracker_set.h): what they say is told in TrackResult::set, and changes nothing else.
//
// Pictures are rectified left pictures of the given pinhole camera; all poses are of the left
// camera in W. Any one thread. The same calls give the same bits.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/time.h"
#include "engine/model/image.h"
#include "engine/model/landing_site.h"
#include "engine/model/navigation_status.h"
#include "engine/model/range_map.h"
#include "engine/model/rig.h"
#include "engine/model/settings/settings.h"
#include "engine/model/tracker_set_status.h"
#include "engine/tracking/landmark.h"

namespace palace {

class TrackerSet;

/// What one picture said. `landmarks` are the trusted ones only; empty when the frame is no good.
struct TrackResult {
  Timestamp time;
  TrackerStatus status;
  std::vector<GroundLandmark> landmarks;
  TrackerSetStatus set;  ///< all trackers side by side; empty before Lock
};

class SiteTracker {
 public:
  SiteTracker();
  ~SiteTracker();
  SiteTracker(SiteTracker&&) noexcept;
  SiteTracker& operator=(SiteTracker&&) noexcept;

  /// Forgets the site; locked() is false afterwards.
  void Reset();
  /// The ground around the site had enough to hold on to when Lock was called.
  bool anchored() const;
  /// It is anchored, and the last picture still held it.
  bool locked() const;
  /// Anchors on the ground around the site. X_WC: left camera at exposure on the estimate in force.
  /// range may be null; then the plane through the site with normal_W is used.
  void Lock(const ImageU8& left, const PinholeCamera& camera, const RigidTransform& X_WC,
            const RangeMap* range, const LandingSite& site, const TrackingSettings& settings,
            Timestamp time);
  /// X_WC_predicted: predicted camera pose of this frame. Errors of some tens of pixels are
  /// absorbed; a step of the estimate (hand-over) too. Before Lock: an unlocked, empty result.
  TrackResult Track(const ImageU8& left, const PinholeCamera& camera,
                    const RigidTransform& X_WC_predicted, const RangeMap* range,
                    const TrackingSettings& settings, Timestamp time);
  /// For a time without a picture of now: where the trackers would see the site, all LOST for the
  /// reason `why`. Empty before Lock.
  TrackerSetStatus Coast(const PinholeCamera& camera, const RigidTransform& X_WC_predicted,
                         const TrackingSettings& settings, const std::string& why, Timestamp time);

 private:
  std::unique_ptr<TrackerSet> set_;
};

}  // namespace palace
