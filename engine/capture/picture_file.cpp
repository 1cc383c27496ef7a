#include "engine/capture/picture_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/camera/grey_view.h"
#include "engine/camera/picture_writer.h"

namespace palace {
namespace {

constexpr std::string_view kPngStart("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kPngEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);
constexpr std::string_view kJpegStart("\xff\xd8\xff", 3);
constexpr std::string_view kJpegEnd("\xff\xd9", 2);

/// The decoders complain on stderr about a picture that is cut short, and may give its upper part.
bool CutShort(std::string_view bytes) {
  if (bytes.substr(0, kPngStart.size()) == kPngStart) {
    return bytes.find(kPngEnd) == std::string_view::npos;
  }
  if (bytes.substr(0, kJpegStart.size()) == kJpegStart) {
    return bytes.rfind(kJpegEnd) == std::string_view::npos;
  }
  return false;
}

}  // namespace

Result<ImageU8> ReadGreyPicture(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) {
    return UnavailableError(path.string() + ": no such file; check the name");
  }
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) {
    return UnavailableError(path.string() + ": cannot be read; check its permissions");
  }
  if (CutShort(bytes)) {
    return InvalidError(path.string() + ": the picture is cut short after " +
                        std::to_string(bytes.size()) + " bytes; copy or record it again");
  }
  cv::Mat picture;
  try {
    if (!bytes.empty()) {
      picture =
          cv::imdecode(std::vector<std::uint8_t>(bytes.begin(), bytes.end()), cv::IMREAD_GRAYSCALE);
    }
  } catch (const cv::Exception&) {
    picture.release();
  }
  if (picture.empty() || picture.type() != CV_8UC1) {
    return InvalidError(path.string() +
                        ": not a picture that can be read; give a PNG, JPEG, TIFF or PGM file");
  }
  ImageU8 image(picture.cols, picture.rows);
  for (int y = 0; y < picture.rows; ++y) {
    std::copy_n(picture.ptr<std::uint8_t>(y), picture.cols, image.row(y));
  }
  return image;
}

Status WriteGreyPicture(const std::filesystem::path& path, const ImageU8& image) {
  return WritePicture(path, GreyView(image));
}

}  // namespace palace
