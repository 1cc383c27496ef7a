// Template match: where in a window a template lies, and how good the next best place is.
//
// Zero-mean normalised cross-correlation at every whole pixel. The second best place is the highest
// other local maximum (5 x 5 px) more than an eighth of the template away, by row or by column:
// what falls off steadily from the best place is the same place, and a ridge that reaches the
// window's edge is another. Where the window is flat (black, burnt out) there is nothing to compare
// and the score is 0. Between pixels the best place is the top of a parabola through its
// neighbours.
#pragma once

#include <Eigen/Dense>

#include "engine/model/image.h"

namespace palace {

struct TemplateMatch {
  Eigen::Vector2i corner = Eigen::Vector2i::Zero();   ///< of the template in the window
  Eigen::Vector2d between = Eigen::Vector2d::Zero();  ///< the same, sub-pixel
  double score = 0;                                   ///< 0 to 1
  double second_score = 0;                            ///< 0 where the window holds no other place
};

/// The template is square and fits into the window.
TemplateMatch MatchTemplate(const ImageU8& window, const ImageU8& wanted);

}  // namespace palace
