// LitSceneRenderer: pictures of a world with material ground, drawn by OpenGL 3.3 core: what
// RayScene casts, quickly enough to fly by.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/simulation/scene_camera.h"
#include "engine/world/ray_scene.h"
#include "engine/world/world.h"
#include "gui/render/framebuffer.h"

namespace palace {

/// The triangles of relief and solids that RayScene meets (the relief's to within 5 mm), the same
/// lit picture of the ground, Lambert light on solids with shadow maps of the sun for what stands
/// still and for what moves. Edges are multisampled 4x; Render lights the ground afterwards, once a
/// sample (LitResolve), DrawInto as it is drawn. Projection as SceneRenderer's.
/// One GL 3.3 core context must be current on the calling thread for every call, and for the
/// destructor.
class LitSceneRenderer final : public SceneCamera {
 public:
  /// Works out the ground's light (seconds for large grounds), compiles shaders. The world's ground
  /// has a material.
  static Result<std::unique_ptr<LitSceneRenderer>> Create(const World& world);
  /// With the light that was worked out for that scene, which is not needed afterwards.
  static Result<std::unique_ptr<LitSceneRenderer>> Create(const RayScene& scene);
  ~LitSceneRenderer() override;

  Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform& X_WC,
                         double time_s = 0) override;
  /// The same into a target of the camera's size, before it is resolved: with its depth, for what
  /// is drawn after it.
  void DrawInto(const Framebuffer& target, const PinholeCamera& camera, const RigidTransform& X_WC,
                double time_s);
  /// Distance along the optical axis through the pixels' centres, metres; infinity: sky.
  Result<ImageF> Depth(const PinholeCamera& camera, const RigidTransform& X_WC, double time_s = 0);
  /// On: what the camera cannot see is not sent to the device, which changes no bit of any picture
  /// (a test asks). Off: for that test.
  void Cull(bool on);

 private:
  struct Parts;
  explicit LitSceneRenderer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace palace
