#include "engine/camera/camera_pair.h"

#include "engine/camera/cahvor.h"

namespace palace {
namespace {

/// The pinhole that the camera is, if it is one without distortion.
std::optional<PinholeCamera> IdealPinhole(const CameraModel& model) {
  const auto* m = std::get_if<OpenCvModel>(&model.lens);
  const bool ideal = m != nullptr && m->lens == OpenCvLens::kPolynomial && m->coefficients == 0;
  return ideal ? std::optional(m->pinhole) : std::nullopt;
}

bool IsRectified(const CameraPair& pair) {
  constexpr double kSame = 1e-9;  // of axes; of the baseline
  const auto left = IdealPinhole(pair.left), right = IdealPinhole(pair.right);
  if (!left || left != right) {
    return false;
  }
  const Eigen::Matrix3d R = RotationOf(pair.left);
  const Eigen::Vector3d offset = R * (CentreOf(pair.right) - CentreOf(pair.left));
  return (R - RotationOf(pair.right)).cwiseAbs().maxCoeff() < kSame && offset.x() > 0 &&
         offset.tail<2>().norm() < kSame * offset.x();
}

}  // namespace

Result<CameraPair> PlacePair(const CameraModel& left, const CameraModel& right,
                             std::optional<double> baseline_m, const std::string& left_name,
                             const std::string& right_name) {
  CameraPair pair{InUnit(left, 1), InUnit(right, 1)};
  if (left.pose_is_known && right.pose_is_known) {
    return pair;
  }
  const bool of_opencv = std::holds_alternative<OpenCvModel>(left.lens) &&
                         std::holds_alternative<OpenCvModel>(right.lens);
  if (right.pose_is_known && of_opencv) {
    return pair;  // the left camera is the frame of the right one's pose
  }
  if (left.pose_is_known || right.pose_is_known) {
    return InvalidError((left.pose_is_known ? right_name : left_name) +
                        ": tells no pose, the other camera of the pair does; give both files a "
                        "pose in one frame, or neither and a baseline");
  }
  if (!baseline_m || !(*baseline_m > 0)) {
    return InvalidError(left_name + ", " + right_name +
                        ": neither tells a pose; give the baseline in metres (baseline_m in [rig], "
                        "--baseline for palacectl camera align), the axes then count as parallel");
  }
  pair.right = MovedCamera(pair.right, Eigen::Matrix3d::Identity(), {*baseline_m, 0, 0});
  return pair;
}

RigCamera RigCameraOf(const CameraModel& model) {
  RigCamera camera;
  camera.model = model;
  camera.pinhole = PinholeFromCahv(LinearPartOf(model)).camera;
  return camera;
}

void SetCameras(StereoRig& rig, const CameraPair& pair) {
  rig.rectified = IsRectified(pair);
  if (rig.rectified) {
    rig.left = rig.right = RigCamera{*IdealPinhole(pair.left)};
  } else {
    rig.left = RigCameraOf(pair.left);
    rig.right = RigCameraOf(pair.right);
  }
  rig.baseline_m = (CentreOf(pair.right) - CentreOf(pair.left)).norm();
}

}  // namespace palace
