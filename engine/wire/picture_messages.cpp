#include <optional>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/wire/sensor_messages.h"
#include "engine/wire/wire_fields.h"
#include "engine/wire/wire_pack.h"

namespace palace {
namespace {

constexpr int kLargestSide = 8192;

/// Width and height from the frame header of a JPEG stream, read before anything is decompressed:
/// a few bytes must not be able to ask for gigabytes (ISO/IEC 10918-1, B.2.2).
std::optional<std::pair<int, int>> JpegSize(const std::vector<std::uint8_t>& data) {
  if (data.size() < 4 || data[0] != 0xFF || data[1] != 0xD8) {
    return std::nullopt;
  }
  std::size_t at = 2;
  while (at + 9 < data.size()) {
    if (data[at] != 0xFF) {
      return std::nullopt;
    }
    const int marker = data[at + 1];
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    const std::size_t length = static_cast<std::size_t>(data[at + 2]) << 8 | data[at + 3];
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) {
      return std::pair{data[at + 7] << 8 | data[at + 8], data[at + 5] << 8 | data[at + 6]};
    }
    if (length < 2) {
      return std::nullopt;
    }
    at += 2 + length;
  }
  return std::nullopt;
}

Result<TimedPicture> FromJpeg(const image_t& m) {
  const auto size = JpegSize(m.data);
  if (!size || size->first != m.width || size->second != m.height) {
    return InvalidError("the JPEG data is not a picture of the announced " +
                        std::to_string(m.width) + "x" + std::to_string(m.height) + " pixels");
  }
  cv::Mat grey;
  try {
    grey = cv::imdecode(m.data, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    grey.release();
  }
  if (grey.cols != m.width || grey.rows != m.height || grey.type() != CV_8UC1) {
    return InvalidError("the JPEG data does not decode");
  }
  TimedPicture picture{{m.utime}, ImageU8(m.width, m.height)};
  for (int y = 0; y < m.height; ++y) {
    std::copy_n(grey.ptr<std::uint8_t>(y), m.width, picture.grey.row(y));
  }
  return picture;
}

Result<TimedPicture> FromGrey(const image_t& m) {
  const std::size_t stride = static_cast<std::size_t>(m.row_stride);
  const auto width = static_cast<std::size_t>(m.width);
  const auto height = static_cast<std::size_t>(m.height);
  // The last row may come without its padding.
  if (m.row_stride < m.width || m.data.size() < stride * (height - 1) + width ||
      m.data.size() > stride * height) {
    return InvalidError(std::to_string(m.data.size()) + " bytes do not make " +
                        std::to_string(m.height) + " rows of " + std::to_string(m.row_stride) +
                        " bytes for a width of " + std::to_string(m.width));
  }
  TimedPicture picture{{m.utime}, ImageU8(m.width, m.height)};
  for (int y = 0; y < m.height; ++y) {
    std::copy_n(m.data.data() + stride * static_cast<std::size_t>(y), width, picture.grey.row(y));
  }
  return picture;
}

}  // namespace

Result<TimedPicture> PictureFromWire(const WireMessage& message) {
  return DecodeAnd<image_t>(message, [](const image_t& m) -> Result<TimedPicture> {
    if (m.width < 1 || m.height < 1 || m.width > kLargestSide || m.height > kLargestSide) {
      return InvalidError("a picture of " + std::to_string(m.width) + "x" +
                          std::to_string(m.height) + " pixels is not between 1 and 8192 a side");
    }
    switch (m.pixelformat) {
      case image_t::PIXEL_FORMAT_GRAY:
        return FromGrey(m);
      case image_t::PIXEL_FORMAT_MJPEG:
        return FromJpeg(m);
      default:
        return InvalidError("pixel format " + std::to_string(m.pixelformat) +
                            " is neither GRAY (1497715271) nor MJPEG (1196444237)");
    }
  });
}

}  // namespace palace
