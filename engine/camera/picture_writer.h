// Pictures on disk, written whole or not at all.
#pragma once

#include <filesystem>

#include "engine/core/result.h"

namespace cv {
class Mat;
}  // namespace cv

namespace palace {

/// In the format of the name's extension. OpenCV's own writer leaves what fits on a full disk,
/// under the name of a whole picture. Errors name the file.
Status WritePicture(const std::filesystem::path& path, const cv::Mat& picture);

}  // namespace palace
