// AnchoredFeature: one feature of the ground near the site, followed from its anchor, and where the
// site lies by it.
//
// Its anchor is a place in a keyframe, warped into the present view by the homography of the site's
// plane under the predicted motion (key_patch.h). What the prediction lacks is sought near where
// the feature was seen last, moved on as predicted, and found to a fraction of a pixel with a small
// scale and turn (template_anchor.h); where that does not find it as it was, by normalised
// cross-correlation first. The site's pixel is carried
// along in the keyframe,
//
//   site now = place + H(site in the keyframe) - H(feature in the keyframe)
//
// and asks for no place in W. It errs with its distance from the feature as the pose does; scale
// and turn of a template of 41 pixels are no better. Where the feature lies no other tracker
// decides.
//
// It is LOST where the ground around it differs from the anchor or does so suddenly (coherence.h),
// where a third of it is covered, or where it leaves the picture. It is then carried on by the
// prediction and looked for where the other trackers see it, and now and then widely, and is
// re-acquired where it is nearly as coherent as before and has no second place. A new anchor is cut
// only at a good coherence when the scale has changed by 1.4.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <Eigen/Dense>

#include "engine/model/tracker_set_status.h"
#include "engine/tracking/coasted_pixel.h"
#include "engine/tracking/coherence.h"
#include "engine/tracking/key_patch.h"
#include "engine/tracking/site_view.h"

namespace palace {

/// What helps to find a feature that is LOST.
struct FeatureHint {
  std::optional<Eigen::Vector2d> site_pixel{};  ///< by the trackers that hold
  bool may_look_wide = false;                   ///< a wide search costs half a millisecond
};

class AnchoredFeature {
 public:
  /// `patch` is the feature in this very picture, in which the site lies at `site_pixel`.
  AnchoredFeature(int number, KeyPatch patch, const Eigen::Vector2d& site_pixel,
                  const PredictedPixel& site);

  void Follow(const SiteView& view, const GroundPlane& plane, const PredictedPixel& site,
              const FeatureHint& hint);
  /// There is no picture to look at.
  void Coast(const PinholeCamera& camera, const RigidTransform& X_WC_predicted,
             const GroundPlane& plane, const PredictedPixel& site, const std::string& why);
  /// Seen well, and from so near that the anchor should be cut anew.
  bool wants_anchor() const { return wants_anchor_; }
  /// In the picture followed last.
  void CutAnchor(std::shared_ptr<const ImageU8> picture, const RigidTransform& X_WC_predicted);

  const TrackerMember& member() const { return member_; }

 private:
  struct Sighting {
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    Eigen::Matrix2d A = Eigen::Matrix2d::Identity();
    PatchComparison patches;
    std::string why_not;  ///< empty: it is the feature
  };
  /// Within `reach_px` of where it is expected; by 0 as far as Gauss-Newton goes.
  Sighting Look(const SiteView& view, const PatchView& patch, const Eigen::Vector2d& expected,
                int reach_px, double least) const;
  Sighting Find(const SiteView& view, const PatchView& patch, const FeatureHint& hint);
  std::string WhyNot(double coherence, double seen, bool alone, double least) const;
  /// From the feature, pixels of now.
  Eigen::Vector2d ToSite(const PatchView& patch) const;
  void Keep(const SiteView& view, const PatchView& patch, const PredictedPixel& site,
            Sighting sighting);
  void Lose(const std::optional<PatchView>& patch, const PredictedPixel& site, std::string why);

  KeyPatch patch_;
  Eigen::Vector2d site_key_;  ///< the site's pixel in the keyframe
  Eigen::Matrix2d A_ = Eigen::Matrix2d::Identity();
  Eigen::Vector2d pixel_;      ///< of the feature; coasted while LOST
  Eigen::Vector2d predicted_;  ///< of the feature by the plain prediction, same picture
  CoastedPixel site_;
  TrackerMember member_;
  double fresh_coherence_ = 0;  ///< the best with this anchor
  bool wants_anchor_ = false;
};

}  // namespace palace
