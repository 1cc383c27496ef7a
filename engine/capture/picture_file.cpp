#include "engine/capture/picture_file.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/camera/grey_view.h"
#include "engine/camera/picture_writer.h"
#include "engine/capture/jpeg_damage.h"
#include "engine/core/files.h"

namespace palace {
namespace {

constexpr std::size_t kLargestFile = std::size_t{256} << 20;  // 16 bits of 8192 x 8192 px, twice

constexpr std::string_view kPngStart("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kPngEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);
constexpr std::string_view kJpegStart("\xff\xd8\xff", 3);
constexpr std::string_view kJpegEnd("\xff\xd9", 2);

/// Where the picture itself begins in a JPEG, after tables and whatever a camera adds, a small
/// picture with an end of its own among it; npos where that is cut off.
std::size_t ScanOfJpeg(std::string_view bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && byte(at) == 0xFF) {
    if (byte(at + 1) == 0xFF) {
      ++at;  // padding
      continue;
    }
    if (byte(at + 1) == 0xDA) {
      return at;
    }
    at += 2 + (std::size_t{byte(at + 2)} << 8) + byte(at + 3);
  }
  return std::string_view::npos;
}

/// The decoders complain on stderr about a picture that is cut short, and may give its upper part.
bool CutShort(std::string_view bytes) {
  if (bytes.substr(0, kPngStart.size()) == kPngStart) {
    return bytes.find(kPngEnd) == std::string_view::npos;
  }
  if (bytes.substr(0, kJpegStart.size()) == kJpegStart) {
    const std::size_t scan = ScanOfJpeg(bytes), end = bytes.rfind(kJpegEnd);
    return scan == std::string_view::npos || end == std::string_view::npos || end < scan;
  }
  return false;
}

/// From 16 bits the upper eight; from 8 bits as it is. Nothing of other kinds.
std::optional<ImageU8> EightBits(const cv::Mat& picture) {
  if (picture.empty() || (picture.type() != CV_8UC1 && picture.type() != CV_16UC1)) {
    return std::nullopt;
  }
  ImageU8 image(picture.cols, picture.rows);
  for (int y = 0; y < picture.rows; ++y) {
    if (picture.type() == CV_8UC1) {
      std::copy_n(picture.ptr<std::uint8_t>(y), picture.cols, image.row(y));
    } else {
      std::transform(picture.ptr<std::uint16_t>(y), picture.ptr<std::uint16_t>(y) + picture.cols,
                     image.row(y), [](int v) { return static_cast<std::uint8_t>(v >> 8); });
    }
  }
  return image;
}

/// The largest value of a picture of 16 bits that fills 12 of them or fewer; 0 of others.
int LargestOfFewBits(const cv::Mat& picture) {
  constexpr double kTwelveBits = 4095;
  double largest = 0;
  if (picture.type() == CV_16UC1) {
    cv::minMaxLoc(picture, nullptr, &largest);
  }
  return largest <= kTwelveBits ? static_cast<int>(largest) : 0;
}

}  // namespace

Result<ImageU8> ReadGreyPicture(const std::filesystem::path& path) {
  const Result<std::string> file = ReadTextFile(path, kLargestFile);
  if (!file) {
    return file.error();
  }
  const std::string& bytes = *file;
  if (CutShort(bytes)) {
    return InvalidError(path.string() + ": the picture is cut short after " +
                        std::to_string(bytes.size()) + " bytes; copy or record it again");
  }
  if (bytes.starts_with(kJpegStart)) {
    if (const std::string damage = DamageInJpeg(bytes); !damage.empty()) {
      return InvalidError(path.string() + ": the picture is damaged inside (" + damage +
                          "); copy or record it again");
    }
  }
  cv::Mat picture;
  try {
    if (!bytes.empty()) {
      // As the camera stored it: a lens is that of the sensor, whichever way up it was held.
      picture =
          cv::imdecode(std::vector<std::uint8_t>(bytes.begin(), bytes.end()),
                       cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
    }
  } catch (const cv::Exception&) {
    picture.release();
  }
  if (const int largest = LargestOfFewBits(picture); largest > 0) {
    return InvalidError(path.string() + ": a picture of 16 bits whose largest value is " +
                        std::to_string(largest) +
                        ", nearly black; scale it to all 16 bits (65535), or to 8");
  }
  const std::optional<ImageU8> image = EightBits(picture);
  if (!image) {
    return InvalidError(path.string() +
                        ": not a picture that can be read; give a PNG, JPEG, TIFF or PGM file");
  }
  return *image;
}

Status WriteGreyPicture(const std::filesystem::path& path, const ImageU8& image) {
  return WritePicture(path, GreyView(image));
}

}  // namespace palace
