#include "engine/camera/picture_writer.h"

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/core/files.h"

namespace palace {

Status WritePicture(const std::filesystem::path& path, const cv::Mat& picture) {
  std::vector<std::uint8_t> bytes;
  try {
    if (cv::imencode(path.extension().string(), picture, bytes) &&
        WriteTextFile(path, std::string(bytes.begin(), bytes.end()))) {
      return Ok();
    }
  } catch (const cv::Exception&) {  // said below
  }
  return UnavailableError(path.string() + ": cannot be written; check folder and disk");
}

}  // namespace palace
