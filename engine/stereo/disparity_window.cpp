#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/check.h"
#include "engine/stereo/ground_disparity.h"
#include "engine/stereo/stereo.h"

namespace palace {
namespace {

constexpr int kWidest = 256;
constexpr int kStep = 16;          // SGBM searches multiples of 16
constexpr int kPointsPerSide = 8;  // border rays on each side of the picture
constexpr double kNearShare = 1.04;
constexpr double kMargin_px = 2;

}  // namespace

DisparityWindow PredictWindow(const PinholeCamera& camera, double baseline_m,
                              const RigidTransform& X_WC, double ground_height_m, double tallest_m,
                              const StereoSettings& settings) {
  PALACE_CHECK(camera.width > 1 && camera.height > 1 && camera.fx_px > 0 && baseline_m > 0,
               camera.width, camera.height, camera.fx_px, baseline_m);
  const GroundDisparity ground(camera, baseline_m, X_WC, ground_height_m);
  double least_px = std::numeric_limits<double>::infinity();
  double greatest_px = 0;
  const auto add = [&](double x, double y) {
    const double d = ground.At(x, y);
    least_px = std::min(least_px, d);
    greatest_px = std::max(greatest_px, d);
  };
  for (int i = 0; i <= kPointsPerSide; ++i) {
    const double x = i * (camera.width - 1.0) / kPointsPerSide;
    const double y = i * (camera.height - 1.0) / kPointsPerSide;
    add(x, 0);
    add(x, camera.height - 1.0);
    add(0, y);
    add(camera.width - 1.0, y);
  }
  const double far_px = std::max(0.0, least_px * kFallsAway - kMargin_px);
  const double ground_px = greatest_px * kNearShare + kMargin_px;
  // An object's top is nearer by height / (height - tallest); half the height at the most, so that
  // a low flight does not ask for an endless window.
  const double height_m = ground.height_m();
  const double reach_m = std::clamp(tallest_m, 0.0, height_m / 2);
  const double top_px = greatest_px * height_m / (height_m - reach_m) + kMargin_px;

  const double wanted = std::max(ground_px, top_px);
  int first = static_cast<int>(std::floor(far_px));
  int end = static_cast<int>(std::ceil(std::min(wanted, 1e5))) + 1;
  if (end - first > kWidest) {
    // Too wide: give up the tops first, then the far ground.
    end = std::max(first + kWidest, static_cast<int>(std::ceil(std::min(ground_px, 1e5))) + 1);
    first = end - kWidest;
  }
  const int least = std::clamp(settings.num_disparities, kStep, kWidest);
  const int count =
      std::max((end - first + kStep - 1) / kStep, (least + kStep - 1) / kStep) * kStep;
  first = std::max(0, first - (count - (end - first)) / 2);
  return {first, count};
}

}  // namespace palace
