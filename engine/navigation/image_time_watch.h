// ImageTimeWatch: both cameras' picture motion against the vehicle's turning (image_time.h).
//
// Pictures are compared after the turn that the attitude tells is taken out of all but their middle:
// in yaw, what lies above the middle of a camera that looks down moves by up to a third more.
#pragma once

#include <optional>
#include <vector>

#include "engine/core/frames.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/rig.h"
#include "engine/navigation/attitude_history.h"
#include "engine/navigation/image_time.h"
#include "engine/tracking/picture_shift.h"

namespace palace {

class ImageTimeWatch {
 public:
  void Reset() { *this = ImageTimeWatch(); }
  /// Once a bundle, with or without pictures. `depth_m`: of the ground in the middle; NaN unknown.
  void AddPoses(const std::vector<VehiclePose>& poses, const PinholeCamera& camera,
                const RigidTransform& X_BC, double depth_m);
  /// Rectified pictures of the pinhole that AddPoses was given; null: that camera gave none.
  void AddPictures(const ImageU8* left, const ImageU8* right, Timestamp exposure);

  const ImageTime& left() const { return left_.monitor.status(); }
  const ImageTime& right() const { return right_.monitor.status(); }

 private:
  struct Camera {
    ImageTimeMonitor monitor;
    std::optional<PicturePyramid> before;
    Timestamp before_at;
  };
  void Add(const ImageU8* picture, Timestamp exposure, Camera& camera) const;
  /// Of the cameras between two times; none where no attitude is known.
  Eigen::Matrix3d Turn(Timestamp from, Timestamp to) const;

  AttitudeHistory attitude_;
  PinholeCamera camera_;
  Eigen::Matrix3d R_BC_ = Eigen::Matrix3d::Identity();
  Camera left_, right_;
};

}  // namespace palace
