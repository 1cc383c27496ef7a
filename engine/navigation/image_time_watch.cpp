#include "engine/navigation/image_time_watch.h"

#include <utility>

namespace palace {

void ImageTimeWatch::AddPoses(const std::vector<VehiclePose>& poses, const PinholeCamera& camera,
                              const RigidTransform& X_BC, double depth_m) {
  for (const VehiclePose& pose : poses) {
    const MotionRate rate = PredictMotion(pose, X_BC, 0.5 * (camera.fx_px + camera.fy_px), depth_m);
    left_.monitor.AddRate(rate);
    right_.monitor.AddRate(rate);
  }
}

void ImageTimeWatch::AddPictures(const ImageU8* left, const ImageU8* right, Timestamp exposure) {
  left_.Add(left, exposure);
  right_.Add(right, exposure);
}

void ImageTimeWatch::Camera::Add(const ImageU8* picture, Timestamp exposure) {
  if (picture == nullptr) {
    return;
  }
  PicturePyramid now = MakePyramid(*picture);
  if (before) {
    if (const auto shift_px = ShiftBetween(*before, now)) {
      monitor.AddMotion({before_at, exposure, *shift_px});
    }
  }
  before = std::move(now);
  before_at = exposure;
}

}  // namespace palace
