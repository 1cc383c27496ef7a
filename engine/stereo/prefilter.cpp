#include "engine/stereo/prefilter.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/core/check.h"

namespace palace {
namespace {

cv::Mat View(const ImageU8& image) {
  // OpenCV has no read-only view; only results are written through it.
  return cv::Mat(image.height(), image.width(), CV_8UC1,
                 const_cast<std::uint8_t*>(image.pixels().data()));
}

void FilterLaplacian(const cv::Mat& picture, cv::Mat& out) {
  cv::Mat smooth;
  cv::GaussianBlur(picture, smooth, {5, 5}, 1.0, 1.0, cv::BORDER_REPLICATE);
  cv::Laplacian(smooth, out, CV_8U, 1, 2.0, 128.0, cv::BORDER_REPLICATE);
}

}  // namespace

ImageU8 Prefilter(const ImageU8& picture, StereoPrefilter filter) {
  if (filter == StereoPrefilter::kNone || picture.empty()) {
    return picture;
  }
  ImageU8 filtered(picture.width(), picture.height());
  cv::Mat out = View(filtered);
  if (filter == StereoPrefilter::kLaplacian) {
    FilterLaplacian(View(picture), out);
  } else {
    cv::bilateralFilter(View(picture), out, 5, 30, 2, cv::BORDER_REPLICATE);
  }
  return filtered;
}

std::optional<RectifiedPair> FilterThenRectify(const StereoFrame& raw,
                                               const StereoRectifier& rectifier,
                                               const StereoSettings& settings) {
  if (settings.filter_order != FilterOrder::kFilterFirst ||
      settings.prefilter == StereoPrefilter::kNone) {
    return std::nullopt;
  }
  const Result<RectifiedPair> pair =
      rectifier.Rectify({raw.time, Prefilter(raw.left, settings.prefilter),
                         Prefilter(raw.right, settings.prefilter)});
  return pair ? std::optional(*pair) : std::nullopt;
}

ImageU8 HalfSize(const ImageU8& picture) {
  PALACE_CHECK(picture.width() >= 2 && picture.height() >= 2, picture.width(), picture.height());
  ImageU8 half(picture.width() / 2, picture.height() / 2);
  for (int y = 0; y < half.height(); ++y) {
    const std::uint8_t* up = picture.row(2 * y);
    const std::uint8_t* down = picture.row(2 * y + 1);
    std::uint8_t* out = half.row(y);
    for (int x = 0; x < half.width(); ++x) {
      out[x] = static_cast<std::uint8_t>(
          (up[2 * x] + up[2 * x + 1] + down[2 * x] + down[2 * x + 1] + 2) / 4);
    }
  }
  return half;
}

}  // namespace palace
