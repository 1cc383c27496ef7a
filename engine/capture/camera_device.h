// One camera as the sources see it: three functions, so that a test can script a device.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "engine/core/result.h"
#include "engine/model/image.h"

namespace palace {

enum class CameraKind : std::uint8_t {
  kDevice,  ///< V4L2
  kStream,  ///< a URL
  kFile     ///< a video file
};

/// What to open. Size, rate and pixel format are asked of kDevice only.
struct CameraRequest {
  CameraKind kind = CameraKind::kFile;
  std::string address;  ///< path of the device or file, or URL
  int width = 0;
  int height = 0;
  double rate_hz = 0;    ///< 0: as it comes
  std::string fourcc{};  ///< empty: as it comes
};

struct CameraPicture {
  ImageU8 grey;
  /// kFile: the container's time of the picture. Otherwise the monotonic second at which it came
  /// out of the device, before it was decoded.
  double time_s = NAN;
};

/// An open camera. Destruction closes it.
struct CameraDevice {
  /// The next picture; waits for it, some seconds at most. kEnd: the end of a file. kInvalid: this
  /// one could not be decoded, the next may. kUnavailable: the device is lost, open it again.
  std::function<Result<CameraPicture>()> read;
  /// kFile: the next picture read is one at or before this time. Empty where that is impossible.
  std::function<Status(double time_s)> seek;
  double rate_hz = 0;             ///< as the device or container says; 0 unknown
  std::uint64_t frame_count = 0;  ///< as the container says; 0 unknown
};

/// Opens a camera, or says what is wrong with its address and what to do. Never throws.
using OpenCamera = std::function<Result<CameraDevice>(const CameraRequest&)>;

}  // namespace palace
