// ImageTimeWatch: both cameras' picture motion against the vehicle's turning (image_time.h).
#pragma once

#include <optional>
#include <vector>

#include "engine/core/frames.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/rig.h"
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
    void Add(const ImageU8* picture, Timestamp exposure);
  };
  Camera left_, right_;
};

}  // namespace palace
