#include "engine/stereo/prefilter.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"

namespace palace {
namespace {

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
  cv::Mat out = GreyView(filtered);
  if (filter == StereoPrefilter::kLaplacian) {
    FilterLaplacian(GreyView(picture), out);
  } else {
    cv::bilateralFilter(GreyView(picture), out, 5, 30, 2, cv::BORDER_REPLICATE);
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

}  // namespace palace
