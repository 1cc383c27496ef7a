// How a world of a family is looked at: height, tilt, lens and what goes wrong with the picture.
//
// The camera stands over the origin of W, heading north, `height_m` above the ground there. All is
// drawn widely from family and seed, apart from the world: another view of a world is another draw.
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/core/frames.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"
#include "engine/world/ray_pictures.h"
#include "engine/world/world.h"

namespace palace {

struct ViewPlan {
  double height_m = 15;
  double tilt_rad = 0;  ///< negative down; -pi/2 looks straight down
  PinholeCamera camera;
  double baseline_m = 1;
  double blur_px = 0;             ///< standard deviation, beside the lens's own (kLensBlur_px)
  Exposure exposure;              ///< of the left camera
  double right_gain = 1;          ///< of the right camera, over the left one's
  double vignetting = 0;          ///< share of light that the corners lack
  double attitude_error_rad = 0;  ///< of the pose beside the pictures, 1 sigma an axis
  double position_error_m = 0;

  /// Pose of the left camera over a ground of that height.
  RigidTransform X_WC(double ground_m) const;
};

/// Height of the ground that a view looks at, above the origin of W: the higher one of its foot and
/// of where its axis meets level ground, for over the street before a roof nobody looks at a roof.
double GroundSeen(const World& world, const ViewPlan& view);

/// What the plan's camera makes of the grey that falls on it; noise of the seed, which the two
/// cameras do not share.
ImageU8 ExposeAs(const ViewPlan& view, const ImageF& grey, bool right, std::uint64_t seed);

ViewPlan DrawViewPlan(std::string_view family, std::uint64_t seed);

}  // namespace palace
