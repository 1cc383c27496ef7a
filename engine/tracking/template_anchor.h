// TemplateAnchor: a square template of one picture, and where it lies in another, to a fraction of
// a pixel. With offsets d from its middle
//
//   pixel = place + scale R(angle) d
//
// Gauss-Newton finds the four numbers under which the two agree best, in the inverse compositional
// form (Baker & Matthews 2004), whatever gain and offset the exposure gave (as ECC, Evangelidis &
// Psarakis 2008). What covers a part of the template must not draw the rest along: pixels weigh by
// Tukey's biweight of their residual, with the median of all residuals as its scale (Huber 1981;
// Baker, Gross, Ishikawa & Matthews 2003, part 2). It follows the larger part of the template that
// moves as one.
//
// Any one thread; the same pictures give the same bits.
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/model/image.h"

namespace palace {

struct TemplatePlacement {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  double scale = 1;
  double angle_rad = 0;  ///< clockwise in the picture

  Eigen::Matrix2d Linear() const {
    return scale * Eigen::Rotation2Dd(angle_rad).toRotationMatrix();
  }
};

class TemplateAnchor {
 public:
  /// The template of `side` (odd) around `centre`; of its pixels every `stride`-th by row and
  /// column is used. Nothing where the ground is too even to say where it lies.
  static std::optional<TemplateAnchor> Make(const ImageU8& picture, const Eigen::Vector2d& centre,
                                            int side, int stride = 1);

  struct Fit {
    TemplatePlacement at{};
    double seen = 0;  ///< share of the template that agrees, 0 to 1: the mean weight
  };
  /// From a start a few pixels off. Nothing where none lies within a quarter of the side and 1.3 of
  /// the scale.
  std::optional<Fit> Refined(const ImageU8& picture, const TemplatePlacement& start) const;

 private:
  int side_ = 0;
  Eigen::Matrix2Xd offsets_;
  Eigen::VectorXf values_;  ///< mean 0, length 1
  Eigen::Matrix4Xf lean_;   ///< of the values, by place x, y, log scale, angle
};

}  // namespace palace
