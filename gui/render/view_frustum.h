// ViewFrustum: what a camera sees, as a body in the world: its pyramid of rays and the piece of
// ground that they meet (thesis figure 2.2: gray transparent frustum, red intersecting plane).
#pragma once

#include <array>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/rig.h"
#include "engine/world/world.h"
#include "gui/render/line_batch.h"

namespace palace {

/// In W, metres. Rays end on the ground, relief and all; objects do not stop them.
struct ViewFrustum {
  static constexpr double kReach_m = 80;  ///< farther ground is cut off

  Eigen::Vector3d apex_W = Eigen::Vector3d::Zero();
  /// Of the picture's corners, in order round it. A ray that meets no ground within reach ends
  /// where its column of the picture last does; where that meets none at all, after 20 m.
  std::array<Eigen::Vector3d, 4> corners_W{};
  std::vector<std::array<Eigen::Vector3d, 3>> patch_W;  ///< the ground that is seen, triangles
  std::vector<Eigen::Vector3d> outline_W;  ///< of the patch, closed; empty without ground
};

ViewFrustum CastFrustum(const Ground& ground, const PinholeCamera& camera,
                        const RigidTransform& X_WC);

/// The patch red and translucent, its outline red. Drawn against the depth of the world it passes
/// a metre nearer to the eye than it lies, so that small things below it do not tear it.
void AddSeenGround(LineBatch& batch, const ViewFrustum& frustum, const Eigen::Vector3d& eye_W,
                   double ui_scale);
/// Faces grey, faint; edges grey.
void AddFrustumBody(LineBatch& batch, const ViewFrustum& frustum, double ui_scale);

}  // namespace palace
