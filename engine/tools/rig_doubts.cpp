#include "engine/tools/rig_doubts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/median.h"
#include "engine/core/text.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kWidestView_deg = 170, kNarrowestView_deg = 1;
constexpr double kGrossly = 1.5;
constexpr double kLooksDown = 0.3;  // down part of the view: 17 degrees below the horizon
constexpr int kEvery_px = 8;        // a median needs no more

std::string DoubtOf(const RigCamera& camera, const char* side) {
  const PinholeCamera& lens = camera.pinhole;
  if (camera.model || !(lens.fx_px > 0)) {
    return "";
  }
  const double view_deg = Deg(2 * std::atan(lens.width / (2 * lens.fx_px)));
  if (view_deg <= kWidestView_deg && view_deg >= kNarrowestView_deg) {
    return "";
  }
  return std::string("[") + side +
         WithNumbers(
             "] fx_px = %.6g with width = %.0f px is a field of view of %.3g degrees, which "
             "no such lens has; fx_px is in pixels: millimetres divided by the size of a "
             "pixel",
             lens.fx_px, lens.width, view_deg);
}

}  // namespace

std::string DoubtOfFocalLength(const StereoRig& rig) {
  const std::string left = DoubtOf(rig.left, "left");
  return left.empty() ? DoubtOf(rig.right, "right") : left;
}

std::string DoubtOfHeight(const RangeMap& range) {
  if (!range.pose || range.pose->X_WC.R(2, 2) < kLooksDown) {
    return "";
  }
  const Eigen::Vector3d down_C = range.pose->X_WC.R.row(2);
  const PinholeCamera& camera = range.camera;
  std::vector<double> below_m;
  for (int y = 0; y < range.depth_m.height(); y += kEvery_px) {
    const float* depths = range.depth_m.row(y);
    for (int x = 0; x < range.depth_m.width(); x += kEvery_px) {
      const Eigen::Vector3d ray((x - camera.cx_px) / camera.fx_px,
                                (y - camera.cy_px) / camera.fy_px, 1);
      const double below = static_cast<double>(depths[x]) * down_C.dot(ray);
      if (std::isfinite(below)) {
        below_m.push_back(below);
      }
    }
  }
  const double said_m = -range.pose->X_WC.p.z();
  if (below_m.empty() || !(said_m > 0)) {
    return "";
  }
  const double median_m = UpperMedian(below_m);
  if (median_m < kGrossly * said_m && median_m > said_m / kGrossly) {
    return "";
  }
  return WithNumbers(
      "by its pose the camera is %.3g m above the ground (down = 0), by stereo %.3g m "
      "(median); check the height of the pose, and fx_px and baseline_m of the rig",
      said_m, median_m);
}

}  // namespace palace
