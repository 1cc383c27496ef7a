// The least-squares fit of conversion.h: parameters of a target family that place given rays at
// given pixels.
//
//   minimise sum_i |project(x, ray_i) - pixel_i|^2 + N w^2 f^2 |d(x)|^2
//
// A ray that the target does not reach counts as one that lands the picture's diagonal away: a wide
// lens may give up a corner for the rest of the picture, and the residual says how many it did.
// d is how far turn and centre leave the start, in radians and focal lengths. Turn, centre,
// tangential and prism terms imitate each other nearly; the weak prior decides what pixels do not.
//
// Source: Levenberg 1944, Marquardt 1963. Derivatives are central differences, one-sided for a ray
// that one of the sides loses.
#pragma once

#include <optional>
#include <vector>

#include "engine/camera/conversion_targets.h"

namespace palace {

/// A ray, taken from far away, and its pixel.
struct RaySample {
  Eigen::Vector2d pixel;
  Eigen::Vector3d direction;
};

struct TargetFit {
  Eigen::VectorXd x;
  double cost_px2 = 0;  ///< over the judges, lost rays included, without the prior
};

/// The best end of several descents, with and without leave to lose rays: from `start`, usually a
/// smaller family's answer, and, where those leave over a pixel rms, from the target's own start
/// and from a fit that grows from the inner rays outward. What is best the rays of `judges` decide,
/// which lie closer: a range can end between two samples. Never worse there than `start`. `samples`
/// are sorted from the axis outward. Nothing when the target's own start loses a ray.
std::optional<TargetFit> FitTarget(const std::vector<RaySample>& samples,
                                   const std::vector<RaySample>& judges,
                                   const ConversionTarget& target, const Eigen::VectorXd& start);

/// Greatest cosine between the errors at x and what one parameter moves (More 1978): 0 at a
/// minimum that no range bounds. The prior does not count.
double GradientCosine(const std::vector<RaySample>& samples, const ConversionTarget& target,
                      const Eigen::VectorXd& x);

}  // namespace palace
