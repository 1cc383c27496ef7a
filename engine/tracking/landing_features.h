// Landing features: the best places on the landing plane for one template each (thesis 3.1's "best
// trackable features in a region").
//
// Near the site, strongest smaller eigenvalue first, none that repeats within the search window,
// spread apart (template_selection.h), and none whose range says that it stands off the plane
// (landmark_placement.h).
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/tracking/site_view.h"
#include "engine/tracking/view_geometry.h"

namespace palace {

/// Side of a feature's template, odd: as set, 21 to 61 px, for the ground compared around it
/// has 64.
int FeatureSide(const TrackingSettings& settings);

/// At most `count` pixels, best first, as near to `site_pixel` as the picture allows and clear of
/// `taken`. Fewer where the ground is even, repeats itself or is not the plane's.
std::vector<Eigen::Vector2d> ChooseLandingFeatures(const SiteView& view, const GroundPlane& plane,
                                                   const Eigen::Vector2d& site_pixel,
                                                   const std::vector<Eigen::Vector2d>& taken,
                                                   int count);

}  // namespace palace
