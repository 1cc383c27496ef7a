// TrackerSet: several trackers of one site side by side, on every picture.
//
//   plane       many features together, anchored in keyframes          plane_tracker.h
//   template    the thesis's, one, refreshed with every picture        template_tracker.h
//   features    four, each alone, anchored, the best on the plane      anchored_feature.h
//
// One is in force by TrackingSettings::mode, read at Lock; what it says goes to navigation as it
// is, and no other member changes it. The set tells beside it where each sees the site, how
// coherent the ground there is with its anchor, where they agree (tracker_consensus.h) and who
// drifts: whoever is followed and more than TrackerSetStatus::kDrift_px from the consensus of the
// others in three pictures in a row, while two or more others agree.
//
// The thesis's template has no anchor: its score compares successive pictures. The set keeps one
// for it, the ground at the consensus, cut anew when the scale has changed by 1.4, and measures its
// coherence where the template says that the site is.
//
// What a member is LOST it carries on by the prediction, with growing sigma (coasted_pixel.h). A
// feature that has left the picture, drifts, or is not found again for three seconds is replaced
// while the consensus is trusted. A template that gave up is begun anew at the consensus, unless it
// is the one in force.
//
// Any one thread. The same calls give the same bits.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/model/landing_site.h"
#include "engine/model/tracker_set_status.h"
#include "engine/tracking/anchored_feature.h"
#include "engine/tracking/coasted_pixel.h"
#include "engine/tracking/key_patch.h"
#include "engine/tracking/plane_tracker.h"
#include "engine/tracking/site_tracker.h"
#include "engine/tracking/site_view.h"
#include "engine/tracking/template_tracker.h"

namespace palace {

class TrackerSet {
 public:
  /// Anchors all trackers on the ground around the site.
  TrackerSet(const SiteView& view, const LandingSite& site);
  /// Of the tracker in force.
  bool anchored() const;
  bool locked() const;
  /// What the tracker in force says, and beside it the set.
  TrackResult Track(const SiteView& view);
  /// There is no picture to look at, for the reason `why`: all members are LOST and carried on.
  TrackerSetStatus Coast(const PinholeCamera& camera, const RigidTransform& X_WC_predicted,
                         const TrackingSettings& settings, const std::string& why, Timestamp time);

 private:
  /// Plane or template: told by its TrackerStatus.
  struct Told {
    TrackerMember member{};
    CoastedPixel site{};
    int beyond = 0;  ///< pictures in a row beyond the limit from the others
  };
  struct Feature {
    AnchoredFeature tracker;
    int beyond = 0;  ///< likewise
  };

  PredictedPixel Predicted(const PinholeCamera& camera, const RigidTransform& X_WC,
                           const TrackingSettings& settings, Timestamp time) const;
  static void Describe(const TrackerStatus& status, double sigma_px, const PredictedPixel& site,
                       Told& told);
  void CompareTemplate(const SiteView& view);
  void FollowFeatures(const SiteView& view, const PredictedPixel& site);
  TrackerSetStatus Agree(const PredictedPixel& site);
  /// Where it gave up, and is not in force.
  void RestartTemplate(const SiteView& view, const Eigen::Vector2d& site_pixel);
  /// What the next picture needs: anchors and features.
  void Renew(const SiteView& view, const PredictedPixel& site, const TrackerSetStatus& status);
  void CutSiteAnchor(const SiteView& view, const Eigen::Vector2d& site_pixel);
  void ReplaceFeatures(const SiteView& view, const PredictedPixel& site,
                       const Eigen::Vector2d& site_pixel, int count);
  /// One copy of the picture for all that anchor in it.
  const std::shared_ptr<const ImageU8>& Copy(const ImageU8& left);

  TrackerMode mode_;
  LandingSite site_;
  GroundPlane plane_;
  PlaneTracker plane_tracker_;
  TemplateTracker template_tracker_;
  Told plane_told_, template_told_;
  std::vector<Feature> features_;
  int features_made_ = 0;
  KeyPatch site_anchor_;  ///< no keyframe: none was cut
  CoastedPixel consensus_;
  Eigen::Vector2d predicted_ = Eigen::Vector2d::Zero();  ///< of the site, where it could be
  int pictures_ = 0;
  std::shared_ptr<const ImageU8> copy_;  ///< of the present picture
};

}  // namespace palace
