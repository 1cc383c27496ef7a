// RayCastCamera: pictures of a simulated world without GL, so that they depend on nothing but the
// numbers given: no driver, no version of Mesa.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "engine/simulation/scene_camera.h"
#include "engine/world/ray_pictures.h"

namespace palace {

class RayCastCamera final : public SceneCamera {
 public:
  explicit RayCastCamera(World world) : world_(std::move(world)) {}
  Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform& X_WC,
                         double time_s = 0) override {
    const ImageF grey = RenderGrey(WorldAt(world_, time_s), camera, X_WC, 1);
    ImageU8 picture(grey.width(), grey.height());
    std::transform(
        grey.pixels().begin(), grey.pixels().end(), picture.pixels().begin(),
        [](float g) { return static_cast<std::uint8_t>(std::clamp(std::lround(g), 0L, 255L)); });
    return picture;
  }

 private:
  World world_;
};

inline Result<std::unique_ptr<SceneCamera>> MakeRayCastCamera(const World& world) {
  return std::unique_ptr<SceneCamera>(std::make_unique<RayCastCamera>(world));
}

}  // namespace palace
