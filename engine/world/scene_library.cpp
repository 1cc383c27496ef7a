#include "engine/world/scene_library.h"

#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/world/families/clearing.h"
#include "engine/world/families/families.h"

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

bool SeesWholeDisc(const World& scene, const StereoRig& rig, double north_m, double east_m) {
  for (int i = 0; i < 32; ++i) {
    const double angle = 2 * std::numbers::pi * i / 32;
    const double n = north_m + kKeptClear_m * std::cos(angle);
    const double e = east_m + kKeptClear_m * std::sin(angle);
    if (!BothCamerasSee(rig, {n, e, -scene.ground.Height(n, e)})) {
      return false;
    }
  }
  return true;
}

Solid DrawSolid(const Ground& ground, RandomStream& random, bool table) {
  const double north_m = random.Uniform(3, 31), east_m = random.Uniform(-14, 14);
  if (table) {
    const double yaw_rad = random.Uniform(0, std::numbers::pi);
    const double size_x_m = random.Uniform(1.4, 1.6), size_y_m = random.Uniform(0.75, 0.85);
    Solid solid = StandingOn(ground, Table{size_x_m, size_y_m, 0.75}, north_m, east_m, yaw_rad);
    solid.albedo = random.Uniform(0.25, 0.9);
    return solid;
  }
  Solid solid = StandingOn(ground, Cone{0.4, 0.71}, north_m, east_m);
  solid.albedo = random.Uniform(0.55, 0.85);
  return solid;
}

/// Keeps the disc and the space around other solids free; solids are redrawn until they fit.
void Scatter(World& scene, const ScatterPlan& plan, RandomStream& random) {
  const StereoRig rig = DefaultRig();
  double disc_north = 0, disc_east = 0;
  do {
    disc_north = random.Uniform(10, 24);
    disc_east = random.Uniform(-8, 8);
  } while (!SeesWholeDisc(scene, rig, disc_north, disc_east));
  for (int i = 0; i < plan.tables + plan.cones; ++i) {
    for (;;) {
      const Solid solid = DrawSolid(scene.ground, random, i < plan.tables);
      const double north_m = solid.X_WO.p.x(), east_m = solid.X_WO.p.y();
      const double radius = FootRadius(solid.shape);
      const bool off_disc =
          std::hypot(north_m - disc_north, east_m - disc_east) > kKeptClear_m + radius;
      const bool off_others = ObstacleDistance(scene, north_m, east_m) > radius + 0.5;
      if (off_disc && off_others) {
        scene.solids.push_back(solid);
        break;
      }
    }
  }
}

}  // namespace

std::vector<std::string_view> PlainSceneNames() { return {"runway", "cones", "slope", "empty"}; }

std::vector<std::string_view> SceneNames() {
  std::vector<std::string_view> names = PlainSceneNames();
  const std::vector<std::string_view> families = FamilyNames();
  names.insert(names.end(), families.begin(), families.end());
  names.push_back("search");
  return names;
}

std::string SceneList() {
  std::string list;
  for (const std::string_view each : SceneNames()) {
    list += std::string(each) + ", ";
  }
  return list + "or a world file (*.toml)";
}

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

Result<World> MakeScene(std::string_view name, std::uint64_t seed) {
  if (IsFamily(name)) {
    return MakeFamily(name, seed);
  }
  if (name == "search") {
    return MakeSearchedGround(seed);
  }
  RandomStream random(seed, name);
  World scene;
  scene.name = std::string(name);
  scene.ground.texture_seed = seed;
  scene.ground.runway_markings = name == "runway" || name == "empty";
  if (name == "runway") {
    const int tables = 6 + random.Index(4), cones = 6 + random.Index(4);
    Scatter(scene, {tables, cones}, random);
  } else if (name == "cones") {
    Scatter(scene, {0, 16}, random);
  } else if (name == "slope") {
    scene.ground.rise_north = std::tan(Rad(5));
    Scatter(scene, {4, 4}, random);
  } else if (name != "empty") {
    return UsageError("there is no scene \"" + std::string(name) + "\"; choose one of " +
                      SceneList());
  }
  return scene;
}

}  // namespace palace
