// SceneRenderer: what an ideal pinhole camera sees of a World, drawn by OpenGL 3.3 core.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/simulation/scene_camera.h"
#include "engine/world/world.h"
#include "gui/render/framebuffer.h"

namespace palace {

/// How a scene is shown. Tests of geometry ask for plain black ground.
struct SceneLook {
  float ground_grey = 0.42F;  ///< albedo
  float contrast = 1;         ///< of all grain; 0 plain
  bool shadows = true;
};

/// Exact projection: x_px = fx X/Z + cx with pixel (0,0) the centre of the top-left pixel. The
/// ground's texture is computed per pixel from the pixel's own ray, so that left and right pictures
/// of one place agree to float precision; it carries contrast from 1 mm to 5 m wavelengths, so that
/// stereo matches at every height. Edges are multisampled 4x. The same scene, camera and driver
/// give the same bits.
///
/// Lighting: Lambert with sun and sky, shadows projected onto the ground plane. The ground reaches
/// +-200 m; beyond it is sky.
/// One GL 3.3 core context must be current on the calling thread for every call, and for the
/// destructor.
class SceneRenderer final : public SceneCamera {
 public:
  /// Compiles shaders and makes the textures of its ground.texture_seed.
  static Result<std::unique_ptr<SceneRenderer>> Create(const World& scene,
                                                       const SceneLook& look = {});
  ~SceneRenderer() override;

  Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform& X_WC,
                         double time_s = 0) override;
  /// The same into a target of the camera's size, before it is resolved: with its depth, for what
  /// is drawn after it.
  void DrawInto(const Framebuffer& target, const PinholeCamera& camera,
                const RigidTransform& X_WC);

 private:
  struct Parts;
  explicit SceneRenderer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace palace
