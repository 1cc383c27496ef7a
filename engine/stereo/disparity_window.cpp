#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/camera/pinhole.h"
#include "engine/core/check.h"
#include "engine/stereo/stereo.h"

namespace palace {
namespace {

constexpr int kWidest = 256;
constexpr int kStep = 16;               // SGBM searches multiples of 16
constexpr int kPointsPerSide = 8;       // border rays on each side of the picture
constexpr double kLeastHeight_m = 0.3;  // a camera standing on its skids
constexpr double kFarShare = 0.92;      // ground may fall away by a twelfth of the range
constexpr double kNearShare = 1.04;
constexpr double kMargin_px = 2;

/// Least and greatest of Z_ground's inverse over the picture's border, 1/m; 0 at the horizon.
struct InverseDepths {
  double least = std::numeric_limits<double>::infinity();
  double greatest = 0;
};

void AddRay(const PinholeCamera& camera, const RigidTransform& X_WC, double height_m, double x,
            double y, InverseDepths& range) {
  // The ray has unit depth, so its down component is (height of camera over ground) / depth.
  const double down = (X_WC.R * RayFromPixel(camera, {x, y})).z();
  const double inverse = std::max(0.0, down / height_m);
  range.least = std::min(range.least, inverse);
  range.greatest = std::max(range.greatest, inverse);
}

}  // namespace

DisparityWindow PredictWindow(const PinholeCamera& camera, double baseline_m,
                              const RigidTransform& X_WC, double ground_height_m, double tallest_m,
                              const StereoSettings& settings) {
  PALACE_CHECK(camera.width > 1 && camera.height > 1 && camera.fx_px > 0 && baseline_m > 0,
               camera.width, camera.height, camera.fx_px, baseline_m);
  const double height_m = std::max(kLeastHeight_m, HeightFromDown(X_WC.p.z()) - ground_height_m);
  InverseDepths range;
  for (int i = 0; i <= kPointsPerSide; ++i) {
    const double x = i * (camera.width - 1.0) / kPointsPerSide;
    const double y = i * (camera.height - 1.0) / kPointsPerSide;
    AddRay(camera, X_WC, height_m, x, 0, range);
    AddRay(camera, X_WC, height_m, x, camera.height - 1.0, range);
    AddRay(camera, X_WC, height_m, 0, y, range);
    AddRay(camera, X_WC, height_m, camera.width - 1.0, y, range);
  }
  const double fb = camera.fx_px * baseline_m;
  const double far_px = std::max(0.0, fb * range.least * kFarShare - kMargin_px);
  const double ground_px = fb * range.greatest * kNearShare + kMargin_px;
  // An object's top is nearer by height / (height - tallest); half the height at the most, so that
  // a low flight does not ask for an endless window.
  const double reach_m = std::clamp(tallest_m, 0.0, height_m / 2);
  const double top_px = fb * range.greatest * height_m / (height_m - reach_m) + kMargin_px;

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
