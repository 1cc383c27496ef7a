// Random cone fields, the thesis's experiment (Hintze 2004, 4.4.2 and Table 4.5): road cones in
// what both cameras see, one disc kept clear.
#pragma once

#include <cstdint>

#include <Eigen/Dense>

#include "engine/experiments/field_trial.h"
#include "engine/world/ray_pictures.h"

namespace palace {

inline constexpr double kTallCone_m = 0.7112;  ///< 28 in
inline constexpr int kConesInField = 12;

struct ConeFieldPlan {
  double clear_radius_m = 2.3;
  /// Cones keep this much more from the middle of the clear disc, and the disc this much from the
  /// edges of what both cameras see: half a cell's diagonal, twice.
  double margin_m = 0.21;
  double cone_height_m = kTallCone_m;
  double largest_slope_rad = 0.0524;  ///< of the ground, 3 degrees
};

struct ConeField {
  World world;
  HoverView view;  ///< centred so that both pictures' overlap lies about the origin of W
  Eigen::Vector2d clear_middle = Eigen::Vector2d::Zero();  ///< north, east, metres
  /// False where the clear disc does not fit into what both cameras see; cones then stand anywhere.
  bool disc_fits = true;
};

/// Texture, slope, heading, clear disc and cones are drawn from the seed. The places do not depend
/// on the cones' size. `view` gives rig and height.
ConeField MakeConeField(const ConeFieldPlan& plan, const HoverView& view, std::uint64_t seed);

/// Rectangle both cameras see on level ground from the mean pose of a nadir view, half sizes along
/// the picture's x and y, metres.
Eigen::Vector2d HalfOverlap(const HoverView& view);
/// A place seen from the middle of the overlap: along the picture's x and against its y (forward).
Eigen::Vector2d RightForward(const ConeField& field, double north_m, double east_m);

}  // namespace palace
