// RayCastCamera: pictures of a simulated scene without GL, so that they depend on nothing but the
// numbers given: no driver, no version of Mesa.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/core/check.h"
#include "engine/simulation/scene_camera.h"
#include "engine/world/scene.h"
#include "engine/world/stereo_world.h"

namespace palace {

/// The scene's solids where the laser and the skids meet them, all with the ground's texture.
inline StereoWorld StereoWorldOf(const Scene& scene) {
  PALACE_CHECK(scene.slope_east_rad == 0, scene.slope_east_rad);
  StereoWorld world;
  world.texture_seed = scene.texture_seed;
  world.slope_north = std::tan(scene.slope_north_rad);
  for (const SceneObject& o : scene.objects) {
    const double radius_m = o.size_north_m / 2;
    const Solid solid = o.shape == SceneShape::kCone ? MakeCone(0, 0, radius_m, 0, o.height_m)
                        : o.shape == SceneShape::kCylinder
                            ? MakeCone(0, 0, radius_m, radius_m, o.height_m)
                            : MakeBox(0, 0, o.size_north_m, o.size_east_m, o.height_m);
    world.solids.push_back(
        Moved(solid, o.yaw_rad, {o.north_m, o.east_m, -scene.GroundHeight(o.north_m, o.east_m)}));
  }
  return world;
}

class RayCastCamera final : public SceneCamera {
 public:
  explicit RayCastCamera(const Scene& scene) : world_(StereoWorldOf(scene)) {}
  Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform& X_WC) override {
    const ImageF grey = RenderGrey(world_, camera, X_WC, 1);
    ImageU8 picture(grey.width(), grey.height());
    std::transform(
        grey.pixels().begin(), grey.pixels().end(), picture.pixels().begin(),
        [](float g) { return static_cast<std::uint8_t>(std::clamp(std::lround(g), 0L, 255L)); });
    return picture;
  }

 private:
  StereoWorld world_;
};

inline Result<std::unique_ptr<SceneCamera>> MakeRayCastCamera(const Scene& scene) {
  return std::unique_ptr<SceneCamera>(std::make_unique<RayCastCamera>(scene));
}

}  // namespace palace
