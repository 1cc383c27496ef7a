#include "engine/camera/camera_pair.h"

namespace palace {

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

}  // namespace palace
