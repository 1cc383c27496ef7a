#include "engine/stereo/beyond_right_picture.h"

#include <limits>

#include "engine/stereo/ground_disparity.h"

namespace palace {

void RefuseBeyondRightPicture(const RigidTransform& X_WC, double ground_height_m, RangeMap& range) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  const GroundDisparity ground(range.camera, range.baseline_m, X_WC, ground_height_m);
  for (int y = 0; y < range.camera.height; ++y) {
    for (int x = 0; x < range.camera.width; ++x) {
      const double ground_px = ground.At(x, y);
      const bool is_compared = x >= ground_px;
      if (is_compared || range.disparity_px.at(x, y) >= kFallsAway * ground_px) {
        continue;
      }
      range.disparity_px.at(x, y) = kUnknown;
      range.disparity_sigma_px.at(x, y) = kUnknown;
      range.depth_m.at(x, y) = kUnknown;
      range.depth_sigma_m.at(x, y) = kUnknown;
    }
  }
}

}  // namespace palace
