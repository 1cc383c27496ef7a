// RIG.toml: the description of a stereo rig that a person edits.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/model/rig.h"
#include "engine/model/vehicle_state.h"

namespace palace {

struct RigFile {
  StereoRig rig;
  /// From [pose]: X_WB at (0, 0, -height_m), so height_m is the height of the left focal point
  /// above the ground when position_body_m is zero. Nothing without that table.
  std::optional<VehiclePose> pose;
  std::string left_pattern;  ///< [images]; empty without that table
  std::string right_pattern;
  std::string capture_left;  ///< [capture]; empty without that table
  std::string capture_right;
  std::filesystem::path folder;  ///< of the TOML file; patterns and model files are relative to it
};

/// Tables and keys:
///   [left], [right]  model_file, or width height fx_px fy_px cx_px cy_px (+ distortion k1..k3)
///   [rig]            baseline_m (optional with model files: then it is checked against them),
///                    rectified, min_disparity_px, num_disparities
///   [mount]          tilt_deg (-90 nadir .. 0 horizon), position_body_m
///   [pose]           roll_deg pitch_deg heading_deg height_m
///   [images]         left right rate_hz
///   [capture]        left right
/// Required: [left], [right], [rig], [mount] tilt_deg; [pose] needs all its keys, [images] and
/// [capture] both sides. Unknown and missing keys and impossible values are errors that name file,
/// line, key, value, limit and remedy.
Result<RigFile> LoadRigFile(const std::filesystem::path& path);

}  // namespace palace
