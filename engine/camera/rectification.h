// Rectification: pictures of both cameras resampled so that rows are epipolar lines.
#pragma once

#include <memory>

#include <Eigen/Dense>

#include "engine/core/result.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/rig.h"

namespace palace {

/// Both pictures belong to the same pinhole; pixels that the raw picture does not hold are 0.
struct RectifiedPair {
  std::shared_ptr<const ImageU8> left;
  std::shared_ptr<const ImageU8> right;
};

/// Resampling maps of one rig, computed once.
///
/// Rectified rigs without distortion pass through unchanged. Pinhole rigs with plumb-bob distortion
/// are undistorted to one common pinhole; RIG.toml has no rotation between the cameras, so their
/// axes are taken as parallel. Rigs with camera models of any family are aligned as in AlignPair,
/// exactly for far points: where a CAHVORE pupil moves by d, points at range r move by f d / r
/// pixels. The maps are in double until their last rounding to float, 2 to the -12 px in a 4096 px
/// picture.
class StereoRectifier {
 public:
  /// Refuses rigs whose sizes, focal lengths or baseline are not positive, and model pairs that
  /// cannot be aligned or whose right camera stands to the left.
  static Result<StereoRectifier> Make(const StereoRig& rig);

  /// Refuses pictures whose sizes differ from the rig's, naming both sizes. Thread-safe.
  Result<RectifiedPair> Rectify(const StereoFrame& frame) const;
  /// The pinhole of both rectified pictures.
  const PinholeCamera& camera() const;
  /// Distance of the projection centres, metres.
  double baseline_m() const;
  /// Rectified axes in the left camera's own axes (of models: RotationOf). Identity for
  /// rectified rigs.
  const Eigen::Matrix3d& R_C_Rect() const;
  /// Of the rectified left camera: the rig's mount, turned to the rectified axes.
  RigidTransform X_BC(const StereoRig& rig) const;

 private:
  struct Maps;
  StereoRectifier() = default;

  PinholeCamera camera_;
  double baseline_m_ = 0;
  Eigen::Matrix3d R_C_Rect_ = Eigen::Matrix3d::Identity();
  int left_width_ = 0;
  int left_height_ = 0;
  int right_width_ = 0;
  int right_height_ = 0;
  std::shared_ptr<const Maps> maps_;  ///< null: pass-through
};

}  // namespace palace
