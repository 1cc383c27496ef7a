#include "engine/world/scene_library.h"

#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/random.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kHoverHeight_m = 15.24;
// A little more than promised, so that measured maps still show the promise.
constexpr double kKeptClear_m = kClearDiscRadius_m + 0.4;
constexpr double kImageMargin_px = 8;

struct ScatterPlan {
  int tables = 0;
  int cones = 0;
};

bool BothCamerasSee(const StereoRig& rig, const Eigen::Vector3d& p_WQ) {
  const RigidTransform X_WB{Eigen::Matrix3d::Identity(), {0, 0, -kHoverHeight_m}};
  const Eigen::Vector3d p_CQ = (X_WB * rig.X_BC()).Inverse() * p_WQ;
  const PinholeCamera& camera = rig.left.pinhole;
  if (p_CQ.z() <= 0) {
    return false;
  }
  const double y = camera.fy_px * p_CQ.y() / p_CQ.z() + camera.cy_px;
  const double left_x = camera.fx_px * p_CQ.x() / p_CQ.z() + camera.cx_px;
  const double right_x = camera.fx_px * (p_CQ.x() - rig.baseline_m) / p_CQ.z() + camera.cx_px;
  return y > kImageMargin_px && y < camera.height - 1 - kImageMargin_px &&
         right_x > kImageMargin_px && left_x < camera.width - 1 - kImageMargin_px;
}

bool SeesWholeDisc(const Scene& scene, const StereoRig& rig, double north_m, double east_m) {
  for (int i = 0; i < 32; ++i) {
    const double angle = 2 * std::numbers::pi * i / 32;
    const double n = north_m + kKeptClear_m * std::cos(angle);
    const double e = east_m + kKeptClear_m * std::sin(angle);
    if (!BothCamerasSee(rig, {n, e, -scene.GroundHeight(n, e)})) {
      return false;
    }
  }
  return true;
}

/// Radius of the circle that holds the object's base.
double BaseRadius(const SceneObject& object) {
  const bool round = object.shape == SceneShape::kCone || object.shape == SceneShape::kCylinder;
  return round ? object.size_north_m / 2 : std::hypot(object.size_north_m, object.size_east_m) / 2;
}

SceneObject DrawObject(RandomStream& random, bool table) {
  SceneObject object;
  object.shape = table ? SceneShape::kTable : SceneShape::kCone;
  object.north_m = random.Uniform(3, 31);
  object.east_m = random.Uniform(-14, 14);
  if (table) {
    object.yaw_rad = random.Uniform(0, std::numbers::pi);
    object.size_north_m = random.Uniform(1.4, 1.6);
    object.size_east_m = random.Uniform(0.75, 0.85);
    object.height_m = 0.75;
    object.grey = static_cast<float>(random.Uniform(0.25, 0.9));
  } else {
    object.size_north_m = object.size_east_m = 0.4;
    object.height_m = 0.71;
    object.grey = static_cast<float>(random.Uniform(0.55, 0.85));
  }
  return object;
}

/// Keeps the disc and the space around other objects free; objects are redrawn until they fit.
void Scatter(Scene& scene, const ScatterPlan& plan, RandomStream& random) {
  const StereoRig rig = DefaultRig();
  double disc_north = 0, disc_east = 0;
  do {
    disc_north = random.Uniform(10, 24);
    disc_east = random.Uniform(-8, 8);
  } while (!SeesWholeDisc(scene, rig, disc_north, disc_east));
  for (int i = 0; i < plan.tables + plan.cones; ++i) {
    for (;;) {
      const SceneObject object = DrawObject(random, i < plan.tables);
      const double radius = BaseRadius(object);
      const bool off_disc = std::hypot(object.north_m - disc_north, object.east_m - disc_east) >
                            kKeptClear_m + radius;
      const bool off_others = scene.ObstacleDistance(object.north_m, object.east_m) > radius + 0.5;
      if (off_disc && off_others) {
        scene.objects.push_back(object);
        break;
      }
    }
  }
}

}  // namespace

std::vector<std::string_view> SceneNames() { return {"runway", "cones", "slope", "empty"}; }

StereoRig DefaultRig() {
  StereoRig rig;
  PinholeCamera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx_px = camera.fy_px = camera.width / 2.0 / std::tan(Rad(45) / 2);
  camera.cx_px = (camera.width - 1) / 2.0;
  camera.cy_px = (camera.height - 1) / 2.0;
  rig.left.pinhole = rig.right.pinhole = camera;
  rig.baseline_m = 1.0;
  rig.tilt_rad = -Rad(45);
  rig.position_body_m = {0.8, -0.5, 0.3};
  rig.rate_hz = 10;
  return rig;
}

Result<Scene> MakeScene(std::string_view name, std::uint64_t seed) {
  RandomStream random(seed, name);
  Scene scene;
  scene.name = std::string(name);
  scene.texture_seed = seed;
  if (name == "runway") {
    const int tables = 6 + random.Index(4), cones = 6 + random.Index(4);
    Scatter(scene, {tables, cones}, random);
  } else if (name == "cones") {
    scene.runway_markings = false;
    Scatter(scene, {0, 16}, random);
  } else if (name == "slope") {
    scene.runway_markings = false;
    scene.slope_north_rad = Rad(5);
    Scatter(scene, {4, 4}, random);
  } else if (name != "empty") {
    std::string known;
    for (const std::string_view each : SceneNames()) {
      known += (known.empty() ? "" : ", ") + std::string(each);
    }
    return UsageError("there is no scene \"" + std::string(name) + "\"; choose one of " + known);
  }
  return scene;
}

}  // namespace palace
