// WorldViewRenderer: the simulated world as it truly is, seen from outside, with the vehicle and
// what its camera sees (thesis 2.1, the views of RIPTIDE).
#pragma once

#include <memory>
#include <optional>

#include "engine/core/frames.h"
#include "engine/core/result.h"
#include "engine/model/rig.h"
#include "engine/world/ray_scene.h"
#include "engine/world/world.h"
#include "gui/render/framebuffer.h"
#include "gui/render/vehicle_body.h"
#include "gui/render/view_frustum.h"

namespace palace {

/// What is shown of one moment; all of it the truth.
struct WorldView {
  PinholeCamera eye;                   ///< its size is the picture's
  RigidTransform X_WE;                 ///< of the eye: right, down, forward
  double time_s = 0;                   ///< of what moves
  std::optional<RigidTransform> X_WB;  ///< the vehicle, at its own size
  VehicleBody body = VehicleBody::kHelicopter;
  double rotor_diameter_m = 3.1;
  const ViewFrustum* frustum = nullptr;
  double ui_scale = 1;  ///< widths of lines
};

/// Needs one GL 3.3 core context current for every call and for the destructor.
class WorldViewRenderer {
 public:
  /// Worlds whose ground has a material are lit: `light` is then theirs, else null.
  static Result<std::unique_ptr<WorldViewRenderer>> Create(const World& world,
                                                           const RayScene* light);
  ~WorldViewRenderer();

  /// Draws into `target`, row 0 of its texture on top. `samples` 1: no smooth edges.
  Status Render(const WorldView& view, Framebuffer& target, int samples);

 private:
  struct Parts;
  explicit WorldViewRenderer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace palace
