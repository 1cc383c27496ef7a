#include "engine/stereo/disparity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"
#include "engine/model/half_size.h"
#include "engine/stereo/depth_edges.h"
#include "engine/stereo/opencv_matchers.h"
#include "engine/stereo/semi_global.h"
#include "engine/stereo/speckles.h"
#include "engine/stereo/subpixel.h"

namespace palace {
namespace {

constexpr int kSpeckleArea_px = 100;
constexpr float kSpeckleStep_px = 2;
constexpr int kWidestSearch_px = 256;  // a disparity's index is a byte
constexpr int kLeastWidth_px = 64;     // below it a smaller picture has nothing to match

/// 255 where the 3x3 neighbourhood is all black or all white.
cv::Mat UniformMask(const ImageU8& picture) {
  const cv::Mat image = GreyView(picture);
  const cv::Mat element = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  cv::Mat low;
  cv::Mat high;
  cv::erode(image, low, element, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::dilate(image, high, element, {-1, -1}, 1, cv::BORDER_REPLICATE);
  return (high == 0) | (low == 255);
}

void RefuseUniform(const ImageU8& left, const ImageU8& right, ImageF& disparity) {
  const cv::Mat left_uniform = UniformMask(left);
  const cv::Mat right_uniform = UniformMask(right);
  for (int y = 0; y < disparity.height(); ++y) {
    const std::uint8_t* here = left_uniform.ptr<std::uint8_t>(y);
    const std::uint8_t* there = right_uniform.ptr<std::uint8_t>(y);
    float* d = disparity.row(y);
    for (int x = 0; x < disparity.width(); ++x) {
      if (!std::isnan(d[x])) {
        const int match = std::clamp(x - static_cast<int>(d[x] + 0.5F), 0, disparity.width() - 1);
        if (here[x] != 0 || there[match] != 0) {
          d[x] = std::numeric_limits<float>::quiet_NaN();
        }
      }
    }
  }
}

ImageF MatchFullSize(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                     const StereoSettings& settings) {
  if (settings.method == StereoMethod::kSgbm) {
    return MatchWithOpenCv(OpenCvMatcher::kSgbm3Way, left, right, window, settings);
  }
  SemiGlobalOptions options;
  options.uniqueness_percent = settings.uniqueness_percent;
  options.max_left_right_px = settings.max_left_right_px;
  ImageF disparity = MatchSemiGlobal(left, right, window, options);
  RemoveSpeckles(disparity, kSpeckleArea_px, kSpeckleStep_px);
  return disparity;
}

ImageF MatchAtHalfSize(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                       const StereoSettings& settings) {
  StereoSettings smaller = settings;
  smaller.pyramid_levels = std::max(0, settings.pyramid_levels - 1);
  const ImageU8 half_left = HalfSize(left), half_right = HalfSize(right);
  const ImageF coarse = MatchWholePixels(half_left, half_right, HalfWindow(window), smaller);
  SubpixelOptions options;
  options.window_px = settings.refine_window_px | 1;
  const ImageF half = RefineDisparity(half_left, half_right, coarse, options).disparity_px;
  ImageF disparity(left.width(), left.height(), std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < 2 * half.height(); ++y) {
    for (int x = 0; x < 2 * half.width(); ++x) {
      disparity.at(x, y) = 2 * half.at(x / 2, y / 2);
    }
  }
  return disparity;
}

}  // namespace

DisparityWindow HalfWindow(const DisparityWindow& window) {
  return {window.min_px / 2, (window.count / 2 + 16) / 16 * 16};
}

ImageF MatchWholePixels(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                        const StereoSettings& settings) {
  const bool large = left.width() - window.min_px >= 2 * kLeastWidth_px && left.height() >= 2;
  if (large && (settings.pyramid_levels > 0 || window.count > kWidestSearch_px)) {
    return MatchAtHalfSize(left, right, window, settings);
  }
  const DisparityWindow searched{window.min_px, std::min(window.count, kWidestSearch_px)};
  ImageF disparity = MatchFullSize(left, right, searched, settings);
  RefuseUniform(left, right, disparity);
  return DecideBesideDepthEdges(left, right, disparity);
}

}  // namespace palace
