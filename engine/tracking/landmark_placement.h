// Landmark placement: where on the ground a pixel lies, from the site's plane and the range map.
//
// The plane gives every pixel a depth. Where stereo has one too, the two are combined by their
// variances, and a pixel whose range says that it is not on the plane (a rock, a tree, a vehicle)
// is refused. What all ranges agree on - the camera's height drifted since the map was made - is
// taken out first.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/range_map.h"
#include "engine/model/rig.h"
#include "engine/tracking/view_geometry.h"

namespace palace {

/// What a place on the ground errs by that a pixel and a pose gave, as a share of its distance: an
/// attitude of 0.1 degree.
inline constexpr double kPlaceSigmaPerDepth = 0.002;

struct PlacedLandmark {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector3d p_WF = Eigen::Vector3d::Zero();
  double sigma_w_m = 0;
};

/// Median height of the range points above the plane, over the pixels within `radius_m` of the
/// site. Nothing with fewer than 10 ranges.
std::optional<double> MedianHeightAbovePlane(const PinholeCamera& camera,
                                             const RigidTransform& X_WC, const GroundPlane& plane,
                                             const RangeMap* range,
                                             const std::vector<Eigen::Vector2d>& pixels,
                                             double radius_m);

/// Nothing when the pixel does not see the plane within `radius_m` of the site, or its range is off
/// the plane. `common_height_m` is what MedianHeightAbovePlane said of the picture, else 0.
std::optional<PlacedLandmark> PlaceLandmark(const PinholeCamera& camera, const RigidTransform& X_WC,
                                            const GroundPlane& plane, const RangeMap* range,
                                            const Eigen::Vector2d& pixel, double radius_m,
                                            double common_height_m);

}  // namespace palace
