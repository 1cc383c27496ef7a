// Two cameras of a rig in one frame.
#pragma once

#include <optional>
#include <string>

#include "engine/camera/camera_model.h"
#include "engine/core/result.h"
#include "engine/model/rig.h"

namespace palace {

struct CameraPair {
  CameraModel left;
  CameraModel right;
};

/// Both in metres and in one frame. Poses come from the files: both tell one, or the right one
/// tells its pose beside a left camera that is the frame (OpenCV's R and T, ROS's P). Where neither
/// file tells a pose (intrinsics alone) the axes are parallel and the right camera stands
/// `baseline_m` to the right along the left one's x axis. Refuses other mixtures and a missing
/// baseline; `names` are the files, for the message.
Result<CameraPair> PlacePair(const CameraModel& left, const CameraModel& right,
                             std::optional<double> baseline_m, const std::string& left_name,
                             const std::string& right_name);

/// The cameras and the baseline of a rig with these two, in metres. A pair that is one ideal
/// pinhole twice, with parallel axes, the right one to the right along x, needs no models: it is
/// rectified.
void SetCameras(StereoRig& rig, const CameraPair& pair);
/// The camera of a rig that has this model, in metres.
RigCamera RigCameraOf(const CameraModel& model);

}  // namespace palace
