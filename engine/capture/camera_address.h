// What a camera's address in RIG.toml means.
#pragma once

#include <filesystem>
#include <string>

#include "engine/capture/camera_device.h"

namespace palace {

/// "0" is /dev/video0; a path below /dev is a device; "scheme://..." is a stream (rtsp, rtsps,
/// http, https); anything else is a file, relative to `folder`. Other schemes are refused.
Result<CameraRequest> ParseCameraAddress(const std::string& text,
                                         const std::filesystem::path& folder);

/// The address as it may be shown: a stream's user and password are left out.
std::string NameOf(const CameraRequest& request);

/// Without opening it: is it there, is it what it should be, may this user read it? Errors say what
/// to do. Streams pass.
Status CheckCameraAddress(const CameraRequest& request);

}  // namespace palace
