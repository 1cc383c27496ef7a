// A folder of stereo pairs, poses and IMU in the layout of the EuRoC data sets.
//
//   mav0/cam0, cam1                      sensor.yaml, data.csv, data/ with the pictures
//   mav0/imu0/data.csv                   optional
//   mav0/state_groundtruth_estimate0/data.csv   optional: body poses in time
//
// cam0 is the left camera. Pictures of the two whose stamps lie at most a millisecond apart are a
// pair; its pose is the ground truth's at the left one's stamp (euroc_tables.h, StateAt), in our
// frames (euroc_frames.h). Where there is a ground truth, pairs without a pose are left out, as are
// pictures without partner and those that are named but not there: `left_out` says how many.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/camera/files/rig_file.h"
#include "engine/capture/euroc/euroc_frames.h"
#include "engine/capture/image_sequence.h"
#include "engine/core/result.h"

namespace palace {

struct EurocFolder {
  std::filesystem::path folder;  ///< the one that holds cam0
  /// No [pose], [images] or [capture]. Cameras that are one ideal pinhole with parallel axes, side
  /// by side, are rectified; others keep their models, in the frame I.
  RigFile rig;
  EurocMount mount;
  /// At least one pair. The first is taken at kRecordedStart; all have a pose, or none has.
  ImageSequence sequence;
  std::int64_t first_ns = 0;  ///< stamp of the first pair
  std::string left_out;       ///< what was left out and why, for people; empty: nothing
};

/// `folder` holds mav0, or cam0. Refuses sensor files and tables that cannot be read or make no
/// rig, and folders in which no pair is left.
Result<EurocFolder> LoadEurocFolder(const std::filesystem::path& folder);

/// Samples of the IMU in B, on the pictures' clock; empty without imu0.
Result<std::vector<ImuSample>> LoadEurocImu(const EurocFolder& folder);
/// The ground truth as poses of B likewise; empty without one.
Result<std::vector<VehiclePose>> LoadEurocPoses(const EurocFolder& folder);

}  // namespace palace
