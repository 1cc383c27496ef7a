// Pictures one by one, from wherever they come: a folder, a video file, a device or a stream.
#pragma once

#include <filesystem>
#include <string>

#include "engine/capture/opencv_camera.h"

namespace palace {

struct SinglePictures {
  std::string name;   ///< as it may be shown
  bool live = false;  ///< a device or stream: it has no end
  CameraDevice device;
};

/// A folder gives its PNG, JPEG, TIFF and PGM files in order of name (2 after 10: write 02),
/// without times; anything else is an address as in RIG.toml (camera_address.h), relative to
/// `folder`. Devices are asked for `width` x `height` px. kInvalid: a folder without pictures.
Result<SinglePictures> OpenSinglePictures(const std::string& source,
                                          const std::filesystem::path& folder, int width,
                                          int height, const OpenCamera& open = OpenWithOpenCv);

}  // namespace palace
