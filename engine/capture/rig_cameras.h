// The cameras that RIG.toml's [capture] names: what to open, and what fits the rig.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "engine/camera/files/rig_file.h"
#include "engine/capture/camera_device.h"

namespace palace {

/// Two cameras, or one that gives both pictures side by side.
struct RigCameras {
  RigFile file;
  std::string rig_toml;
  std::vector<CameraRequest> requests;  ///< left, right; or the one

  bool recorded() const { return requests.front().kind == CameraKind::kFile; }
  bool side_by_side() const { return requests.size() == 1; }
  /// "Camera left", as channels are called.
  std::string NameOfCamera(std::size_t index) const;
  /// Is this picture of that camera as large as the rig says? The error names both sizes.
  Status Check(std::size_t index, const ImageU8& picture) const;
  /// The largest time between the pictures of a pair: as set, or half a period.
  double ToleranceAt(double rate_hz) const;
};

/// Errors name the file, and a mixture of recorded and live cameras, cameras of different size, and
/// `loop` on live ones.
Result<RigCameras> LoadRigCameras(const std::filesystem::path& rig_toml);

}  // namespace palace
