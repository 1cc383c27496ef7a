#include "engine/world/families/view_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/units.h"
#include "engine/world/families/drawing.h"
#include "engine/world/optics.h"

namespace palace {
namespace {

PinholeCamera CameraOf(double hfov_rad) {
  PinholeCamera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx_px = camera.fy_px = camera.width / 2.0 / std::tan(hfov_rad / 2);
  camera.cx_px = (camera.width - 1) / 2.0;
  camera.cy_px = (camera.height - 1) / 2.0;
  return camera;
}

}  // namespace

RigidTransform ViewPlan::X_WC(double ground_m) const {
  return {CameraRotationFromTilt(tilt_rad), {0, 0, -ground_m - height_m}};
}

double GroundSeen(const World& world, const ViewPlan& view) {
  const double ahead_m = view.height_m / std::tan(-view.tilt_rad);
  return std::max(SurfaceHeight(world, 0, 0), SurfaceHeight(world, ahead_m, 0));
}

ImageU8 ExposeAs(const ViewPlan& view, const ImageF& grey, bool right, std::uint64_t seed) {
  ImageF seen = grey;
  Blur(seen, view.blur_px);
  Vignette(seen, view.vignetting);
  Exposure exposure = view.exposure;
  exposure.gain *= right ? view.right_gain : 1;
  return Expose(seen, exposure, 2 * seed + (right ? 1 : 0));
}

ViewPlan DrawViewPlan(std::string_view family, std::uint64_t seed) {
  RandomStream random(seed, "view of " + std::string(family));
  ViewPlan view;
  const bool rmax = family == "rmax";
  view.height_m = rmax ? 150 * kMetresPerFoot : DrawLog(random, {8, 30});
  const bool nadir = Chance(random, 0.25);
  view.tilt_rad = rmax ? -Rad(35) : nadir ? -std::numbers::pi / 2 : -Rad(random.Uniform(38, 62));
  view.camera = CameraOf(Rad(random.Uniform(40, 65)));
  view.baseline_m = rmax ? 1.056 : 1;
  view.blur_px = Chance(random, 0.5) ? 0 : random.Uniform(0.2, 1.0);
  view.exposure.noise_grey = random.Uniform(0.8, 4);
  view.exposure.gain = random.Uniform(0.7, 1.25);
  view.exposure.offset = random.Uniform(-8, 12);
  view.right_gain = random.Uniform(0.92, 1.08);
  view.vignetting = Chance(random, 0.5) ? 0 : random.Uniform(0, 0.35);
  if (Chance(random, 0.7)) {
    view.attitude_error_rad = Rad(random.Uniform(0, 0.2));
    view.position_error_m = random.Uniform(0, 0.1);
  }
  return view;
}

}  // namespace palace
