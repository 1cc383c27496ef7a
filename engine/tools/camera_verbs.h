// The verbs of palacectl camera, and what they share.
#pragma once

#include <optional>
#include <string>

#include "engine/camera/files/camera_files.h"
#include "engine/core/result.h"

namespace palace {

/// The command line of one verb.
struct CameraOptions {
  std::string model;
  std::string side;  ///< "left", "right" or empty
  std::string size;  ///< "640x480" or empty
  std::string in;    ///< points or pixels
  std::string out;
  std::string to;
  std::string left;
  std::string right;
  std::string form = "auto";
  std::string field = "inside";
  bool field_is_given = false;
  double baseline_m = 0;
};

/// Prints the message; the exit code.
int FailCamera(const Error& error);
/// The model file, with --camera and --size; `side` counts where --camera is not given.
Result<CameraModel> ReadCameraModel(const std::string& path, const CameraOptions& options,
                                    std::optional<StereoSide> side = std::nullopt);
Status WriteCameraText(const std::string& path, const std::string& text);
/// The same, for a model; tells on stderr that a file of this name was replaced.
Status WriteCameraModel(const std::string& path, const std::string& text);

/// Each returns the exit code.
int RunCameraConvert(const CameraOptions& options);
int RunCameraAlign(const CameraOptions& options);

}  // namespace palace
