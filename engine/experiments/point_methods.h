// Ways to follow one point through a film, ours and OpenCV's, behind one function.
//
//   plane      SiteTracker, TrackerMode::kPlane: knows the believed poses
//   template   SiteTracker, TrackerMode::kTemplate, the thesis's refreshed template: likewise
//   follower   FeatureFollower: pictures alone, as all that follow
//   set        the consensus of TrackerSet (SiteTracker tells it beside the plane): followed where
//   it is
//              trusted
//   KLT        calcOpticalFlowPyrLK from picture to picture, window 21, four levels (Bouguet 2000)
//   KCF, CSRT  OpenCV's trackers of a box of 41 px, as they come (Henriques et al. 2015; Lukezic et
//              al. 2017)
//   ECC        findTransformECC, affine, the first 41 px for ever, from where it was last
//              (Evangelidis & Psarakis 2008)
//
// Each says where the point is and whether it holds it. KLT by its status, KCF and CSRT by what
// update returns, ECC by convergence and the same least coherence as ours (tracking.min_coherence).
#pragma once

#include <array>
#include <cmath>
#include <functional>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/experiments/point_film.h"
#include "engine/model/image.h"

namespace palace {

enum class PointMethod { kPlane, kTemplate, kFollower, kSet, kKlt, kKcf, kCsrt, kEcc };
/// Each alone; the set is of these.
inline constexpr std::array kAllPointMethods = {
    PointMethod::kPlane, PointMethod::kTemplate, PointMethod::kFollower, PointMethod::kKlt,
    PointMethod::kKcf,   PointMethod::kCsrt,     PointMethod::kEcc};
/// As listed above.
const char* NameOf(PointMethod method);

/// What one picture said.
struct PointReading {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  bool followed = false;   ///< told as good
  double coherence = NAN;  ///< 0 to 1; NaN: the method tells none
};

/// The next picture of the film. Called with each in order, the second first.
using FollowPoint = std::function<PointReading(const ImageU8& picture, int index)>;

/// Anchored on the film's first picture. `film` must outlive what is returned. A method that
/// refuses the point never says that it follows.
FollowPoint StartFollowing(PointMethod method, const PointFilm& film, const ImageU8& first);

/// OpenCV's four of them, in point_peers.cpp.
FollowPoint StartPeer(PointMethod method, const ImageU8& first, const Eigen::Vector2d& pixel,
                      double min_coherence);

}  // namespace palace
