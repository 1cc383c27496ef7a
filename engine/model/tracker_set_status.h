// What several trackers of one landing site say side by side of one picture
// (tracking/tracker_set.h). Pixels are of the rectified left picture, (0,0) the centre of the
// top-left; unknown is NaN. It is told beside the tracker in force, whose word TrackerStatus is and
// which alone navigation uses.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/time.h"
#include "engine/model/follow_state.h"
#include "engine/model/image.h"

namespace palace {

/// One tracker.
struct TrackerMember {
  enum class Kind : std::uint8_t {
    kPlane,     ///< many features on the ground, anchored in keyframes: all of them together
    kTemplate,  ///< the thesis's: one template at the site, refreshed with every picture
    kFeature,   ///< one anchored feature of the ground near the site
  };
  Kind kind = Kind::kFeature;
  std::string name{};     ///< "Plane", "Template", "Feature 3"; another feature gets another number
  bool in_force = false;  ///< navigation uses this one
  FollowState state = FollowState::kLost;
  std::string why_lost{};  ///< with value and limit; empty unless LOST
  /// Of the picture with the member's anchor, 0 to 1: what weighs. For the template that is the
  /// ground as it was when the set last anchored it, not the picture before.
  double coherence = 0;
  /// What the member itself goes by, 0 to 1. The template: correlation with the picture before,
  /// which stays high while it drifts (erratum E26). Others: their coherence.
  double own_score = 0;
  /// Of what it follows; LOST: where that is by the inertial solution.
  Eigen::Vector2d pixel = Eigen::Vector2d::Constant(NAN);
  /// Of the site, by this member; LOST: coasted likewise. May lie outside the picture.
  Eigen::Vector2d site_pixel = Eigen::Vector2d::Constant(NAN);
  double sigma_px = NAN;  ///< of site_pixel, one axis; grows while LOST
  int pictures_lost = 0;  ///< in a row, this one included
  double lost_s = 0;      ///< since the last picture that held it
  double weight = 0;      ///< share of the consensus, 0 to 1; 0: LOST, drifts, or not anchored
  /// Of site_pixel from the consensus of the others; NaN while LOST or with no others.
  double disagreement_px = NAN;
  /// Followed, and beyond TrackerSetStatus::kDrift_px from the others for several pictures.
  bool drifts = false;
  int anchors = 0;  ///< cut so far: keyframes of the plane, restarts of the template
  Eigen::Vector2d window_centre = Eigen::Vector2d::Constant(NAN);  ///< of the search
  double window_side_px = 0;                                       ///< 0: none was made
  /// The anchor as it should look now, the picture there, and their difference (128 = equal). All
  /// three of one size, or null.
  std::shared_ptr<const ImageU8> anchor_patch{};
  std::shared_ptr<const ImageU8> current_patch{};
  std::shared_ptr<const ImageU8> difference_patch{};

  bool followed() const { return state != FollowState::kLost; }
};

/// Where the site is by all members that are followed, each by its weight.
struct TrackerConsensus {
  /// Enough members agree, of more than one kind of anchor.
  bool trusted = false;
  std::string why_not_trusted{};  ///< with value and limit; empty while trusted
  Eigen::Vector2d site_pixel = Eigen::Vector2d::Constant(NAN);  ///< coasted while none is followed
  double sigma_px = NAN;   ///< one axis; grows while no member is followed
  int agreeing = 0;        ///< members within kDrift_px of it
  double spread_px = NAN;  ///< of those that agree, the farthest from it
};

struct TrackerSetStatus {
  Timestamp time;
  /// Plane, template, then the features by number. Empty while no site is tracked.
  std::vector<TrackerMember> members{};
  TrackerConsensus consensus{};
  /// Who drifts, for people: "Template is 12 px off the others, limit 5 px"; empty: nobody.
  std::string disagreement{};
  static constexpr double kDrift_px = 5;
};

}  // namespace palace
