#include "engine/navigation/image_time_watch.h"

#include <utility>

namespace palace {

void ImageTimeWatch::AddPoses(const std::vector<VehiclePose>& poses, const PinholeCamera& camera,
                              const RigidTransform& X_BC, double depth_m) {
  camera_ = camera;
  R_BC_ = X_BC.R;
  for (const VehiclePose& pose : poses) {
    attitude_.Add(pose);
    const MotionRate rate = PredictMotion(pose, X_BC, 0.5 * (camera.fx_px + camera.fy_px), depth_m);
    left_.monitor.AddRate(rate);
    right_.monitor.AddRate(rate);
  }
}

void ImageTimeWatch::AddPictures(const ImageU8* left, const ImageU8* right, Timestamp exposure) {
  Add(left, exposure, left_);
  Add(right, exposure, right_);
}

Eigen::Matrix3d ImageTimeWatch::Turn(Timestamp from, Timestamp to) const {
  const auto before = attitude_.At(from), now = attitude_.At(to);
  return before && now ? Eigen::Matrix3d((now->X_WB.R * R_BC_).transpose() * before->X_WB.R * R_BC_)
                       : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

void ImageTimeWatch::Add(const ImageU8* picture, Timestamp exposure, Camera& camera) const {
  if (picture == nullptr) {
    return;
  }
  PicturePyramid now = MakePyramid(*picture);
  if (camera.before) {
    const PicturePyramid turned =
        TurnedAroundMiddle(*camera.before, camera_, Turn(camera.before_at, exposure));
    if (const auto shift_px = ShiftBetween(turned, now)) {
      camera.monitor.AddMotion({camera.before_at, exposure, *shift_px});
    }
  }
  camera.before = std::move(now);
  camera.before_at = exposure;
}

}  // namespace palace
