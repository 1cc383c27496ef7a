// KeyPatch: a place of the ground as a keyframe shows it, and how it should look from elsewhere.
//
// Between keyframe and present picture lies the homography of the site's plane under the predicted
// motion, H = K (R + t n'/d) K^-1 (view_geometry.h). What the prediction lacks is a shift, and a
// small similarity A:
//
//   now = place + A (H(key) - H(key pixel of the patch))
//
// so that scale, rotation and perspective are taken out before anything is compared.
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"
#include "engine/tracking/view_geometry.h"

namespace palace {

/// How a patch is predicted to look now.
struct PatchView {
  Eigen::Matrix3d now_from_key = Eigen::Matrix3d::Identity();  ///< H
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();             ///< H(key pixel of the patch)
  double zoom = 1;                                             ///< pixels now per pixel of the key
};

struct KeyPatch {
  std::shared_ptr<const ImageU8> keyframe{};
  RigidTransform X_WK{};  ///< predicted pose of the camera when it was cut
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();

  /// Nothing where the camera is not above the plane, then or now.
  std::optional<PatchView> ViewFrom(const PinholeCamera& camera, const RigidTransform& X_WC,
                                    const GroundPlane& plane) const;
};

/// Pixels of the keyframe from pixels of now, for a patch that lies at `place` now.
Eigen::Matrix3d KeyFromNow(const PatchView& view, const Eigen::Matrix2d& A,
                           const Eigen::Vector2d& place);

}  // namespace palace
