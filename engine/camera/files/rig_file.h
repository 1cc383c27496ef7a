// RIG.toml: the description of a stereo rig that a person edits.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/model/rig.h"
#include "engine/model/vehicle_state.h"

namespace palace {

/// [capture]: where live or filmed pictures come from. One address is a device (number, or path
/// below /dev), a URL (rtsp, http ...) or a video file (relative to the folder of RIG.toml).
struct RigCapture {
  std::string left;
  std::string right;          ///< empty with side_by_side
  bool side_by_side = false;  ///< one device gives both pictures in one, the left one at the left
  int width = 0;              ///< of the picture asked of a device; both halves if side by side
  int height = 0;
  std::optional<double> rate_hz;           ///< asked of a device
  std::optional<double> pair_tolerance_s;  ///< nothing: half a period
  std::string fourcc;                      ///< pixel format asked of a device, e.g. MJPG; or empty
  bool loop = false;                       ///< video files: begin again after the end
};

struct RigFile {
  StereoRig rig;
  /// From [pose]: X_WB at (0, 0, -height_m), so height_m is the height of the left focal point
  /// above the ground when position_body_m is zero. Nothing without that table.
  std::optional<VehiclePose> pose;
  std::string left_pattern;  ///< [images]; empty without that table
  std::string right_pattern;
  std::filesystem::path poses_csv;  ///< [images] poses (poses_file.h), with folder; empty without
  std::optional<RigCapture> capture;
  std::filesystem::path folder;  ///< of the TOML file; patterns and model files are relative to it
};

/// Tables and keys:
///   [left], [right]  model_file (any format of camera_files.h; with width height where the file
///   tells
///                    no size), or width height fx_px fy_px cx_px cy_px (+ distortion k1..k3)
///   [rig]            baseline_m (with model files that tell a pose optional and checked against
///   them;
///                    files without a pose need it, their axes count as parallel),
///                    rectified, min_disparity_px, num_disparities
///   [mount]          tilt_deg (-90 nadir .. 0 horizon), position_body_m
///   [pose]           roll_deg pitch_deg heading_deg height_m
///   [images]         left right rate_hz, and poses: a POSES.csv that then tells times and poses
///   [capture]        left right, or left and side_by_side = true; optional width height rate_hz
///                    pair_tolerance_ms fourcc loop
/// Required: [left], [right], [rig], [mount] tilt_deg; [pose] needs all its keys, [images] both
/// sides. Unknown and missing keys and impossible values are errors that name file,
/// line, key, value, limit and remedy.
Result<RigFile> LoadRigFile(const std::filesystem::path& path);

}  // namespace palace
