// FeatureFollower: one feature through a film, without any pose (thesis 3.1, 3.3).
//
// What is followed is an anchor: the template as it was cut from one picture. Each picture is
// searched for it in a window around where the feature is expected (place and velocity, pixels and
// pixels per picture) by normalised cross-correlation, with the anchor turned and scaled as it was
// seen last. From there its place, scale and angle are found to a fraction of a pixel, held by what
// is seen of it where something covers a part (template_anchor.h). Coherence is the correlation
// there, 0 to 1 (coherence.h): against the anchor, never against the picture before, which a slow
// drift and a bird that flies through the picture would both please (erratum E26; Matthews,
// Ishikawa & Baker 2004, the template update problem).
//
//   kFollowed --coherence < limit, or a third covered--> kLost
//   kLost --coherence >= limit, no rival--> kReacquired, kFollowed
//
// While it is lost nothing is learned. The place runs on with the last velocity for half a second
// of 30 Hz and then stands; the window grows with every picture, to the whole picture. One that
// descends while nothing is seen goes on to descend: from picture to picture in turn the anchor is
// sought at the scale that has run on at its last rate, at a tenth more and less, and at that of
// the last sighting. A place is taken for the feature again where the anchor has no second place
// nearly as good and what lies around both agrees too; in the first pictures only at nearly the
// coherence of before, for half a template agrees with what covers the rest by chance.
//
// Where we deviate from the thesis: it refreshes the template every picture. Here a new anchor is
// cut only at a good coherence, when the scale has changed by 1.4 or when the coherence sinks
// slowly (the view changes; what comes between sinks it fast).
//
// Pure: pictures in, states out. No clock, no files; the same pictures give the same bits. Any one
// thread.
#pragma once

#include <deque>
#include <string>

#include <Eigen/Dense>

#include "engine/core/result.h"
#include "engine/model/follow_state.h"
#include "engine/model/image.h"
#include "engine/tracking/template_anchor.h"
#include "engine/tracking/template_match.h"

namespace palace {

struct FollowerOptions {
  int template_px = 41;        ///< side, odd, 11 to 101
  int search_px = 32;          ///< half side of the window beyond the template, 4 to 128
  double min_coherence = 0.7;  ///< 0.1 to 0.99
  bool update = true;          ///< false: the first template is the anchor for ever
};
/// kUsage: which one is out of its range, its value and its limits.
Status CheckFollowerOptions(const FollowerOptions& options);

/// What one picture said.
struct FollowedFeature {
  FollowState state = FollowState::kFollowed;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< of the feature; kLost: where it may be
  double coherence = 0;                             ///< of the best place in the window
  double scale = 1;                                 ///< since the first picture; kLost: the last
  double angle_rad = 0;                             ///< likewise, clockwise in the picture
  Eigen::Vector2d window_centre = Eigen::Vector2d::Zero();
  int window_side_px = 0;  ///< of the search; it ends at the picture's edge
  int pictures_lost = 0;   ///< in a row, this one included
  int anchors = 1;         ///< cut so far
  std::string why_lost;    ///< value and limit; empty unless kLost
};

class FeatureFollower {
 public:
  /// Cuts the anchor around `pixel`. kUsage: an option is out of its range, the template does not
  /// fit into the picture, or the ground there is too even to be followed.
  static Result<FeatureFollower> Start(const ImageU8& picture, const Eigen::Vector2d& pixel,
                                       const FollowerOptions& options);

  /// The first picture, as it was anchored.
  FollowedFeature first() const;
  /// The next picture, of the size of the first.
  FollowedFeature Follow(const ImageU8& picture);

 private:
  struct Anchor {
    ImageU8 picture;  ///< the whole: what lies around decides whether it is seen again
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    double scale = 1;  ///< of the anchor since the first picture
    double angle_rad = 0;
    TemplateAnchor values;
  };
  struct Sighting {
    TemplatePlacement at;
    double coherence = 0;
    std::string why_not;  ///< empty: it is the feature
  };

  FeatureFollower() = default;
  static bool MakeAnchor(const ImageU8& picture, const TemplatePlacement& at, int template_px,
                         Anchor& anchor);
  /// `expected`: place, scale and angle to be sought.
  Sighting Look(const ImageU8& picture, const TemplatePlacement& expected, int radius_px) const;
  /// Of the anchor, in this picture; while it is lost another in each.
  double SoughtScale() const;
  double Coherence(const ImageU8& picture, const TemplatePlacement& at, int side) const;
  std::string WhyNotTheSame(const ImageU8& picture, const TemplateMatch& match,
                            const TemplatePlacement& at) const;
  /// Of what is followed now; of what is taken up again more, at first.
  double LeastCoherence() const;
  bool NeedsAnchor(const Sighting& sighting) const;
  void Keep(const ImageU8& picture, const Sighting& sighting);

  FollowerOptions options_;
  Anchor anchor_;
  TemplatePlacement at_;  ///< relative to the anchor; of the last sighting
  Eigen::Vector2d coasted_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_px_ = Eigen::Vector2d::Zero();  ///< per picture
  std::deque<Eigen::Vector2d> places_;                     ///< of the last pictures in a row
  std::deque<double> log_scales_;                          ///< likewise, since the first picture
  std::deque<double> coherences_;                          ///< likewise, with this anchor
  double fresh_coherence_ = 0;  ///< of the first picture with this anchor
  int lost_ = 0;
  int anchors_ = 1;
};

}  // namespace palace
