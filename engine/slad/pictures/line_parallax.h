// Heights of lines along the baseline, told by the vehicle's own motion.
//
// Along the baseline a line has no disparity to see, but from a place aside it shows: laid into an
// older left picture by the ground's disparity d, its pixel q(d) is the line's own only if it lies
// on the ground; one that is `above` pixels of disparity nearer is found
//
//   r = s above,   s = n . dq/dd    rows beside it, n across the line
//
// Steps, for an older view: the pose's error is taken out by the ground's texture on both sides of
// the line (shift and turn by least squares on the grey, after Lucas & Kanade 1981); the grey
// across the line, averaged along it, is found again in the older picture at r; above = r / s with
// the variance of both. Views from different places are weighted by theirs. s is about the way
// between the views, across the line, over the baseline: 0.2 m aside tells a wire 1 m over ground
// that is 15 m away. The pose's error of that way makes the height err by as large a share, so the
// way is corrected by what registration finds: ground of disparity d that was laid e rows wrong
// adds w e / d to s, w the way's share in the variance of e, the rest being the turn's. What no
// view tells, or tells twice, has no height.
//
// Frames: pixels of the rectified left pictures, all of one camera; poses as SLAD gets them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/slad/pictures/line_pieces.h"
#include "engine/slad/pictures/older_views.h"
#include "engine/slad/pictures/scene_ground.h"

namespace palace {

/// Disparity of a line beyond the ground's.
struct LineAbove {
  double px = 0;
  double sigma_px = 0;
};

class LineParallax {
 public:
  /// All must outlive it.
  LineParallax(const SceneView& view, const SceneGround& ground, const OlderViews& older);
  ~LineParallax();
  LineParallax(const LineParallax&) = delete;

  /// Of a chain of pieces nearly along the rows; nothing where no older view tells.
  std::optional<LineAbove> Above(const MarkStrips& strips,
                                 const std::vector<LinePiece>& chain) const;

 private:
  /// What one older view tells.
  struct Sight {
    double px = 0;
    double variance_px2 = 0;  ///< of what was found
    double of_height2 = 0;    ///< and this times its square: the way between the views errs
  };
  class Pair;
  std::vector<std::unique_ptr<Pair>> pairs_;  ///< with each older view
};

}  // namespace palace
