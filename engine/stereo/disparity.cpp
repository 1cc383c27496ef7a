#include "engine/stereo/disparity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace palace {
namespace {

constexpr int kPreFilterCap = 31;
constexpr int kSpeckleArea_px = 100;
constexpr int kSpeckleRange_px = 2;
constexpr double kFixedPoint = 16.0;  // OpenCV's disparities are sixteenths of a pixel

cv::Mat View(const ImageU8& image) {
  // OpenCV has no read-only view; nothing here writes through it.
  return cv::Mat(image.height(), image.width(), CV_8UC1,
                 const_cast<std::uint8_t*>(image.pixels().data()));
}

/// Mean and standard deviation of every fourth pixel that is neither black nor white.
struct Brightness {
  double mean = 0;
  double deviation = 0;
};

Brightness Measure(const cv::Mat& image) {
  std::int64_t count = 0;
  std::int64_t sum = 0;
  std::int64_t square = 0;
  for (int y = 0; y < image.rows; y += 2) {
    const std::uint8_t* row = image.ptr<std::uint8_t>(y);
    for (int x = 0; x < image.cols; x += 2) {
      const int value = row[x];
      if (value > 0 && value < 255) {
        ++count;
        sum += value;
        square += value * value;
      }
    }
  }
  if (count == 0) {
    return {};
  }
  const double n = static_cast<double>(count);
  const double mean = static_cast<double>(sum) / n;
  return {mean, std::sqrt(std::max(0.0, static_cast<double>(square) / n - mean * mean))};
}

/// The right picture with the left one's mean and contrast; itself when they hardly differ.
cv::Mat MatchBrightness(const cv::Mat& left, const cv::Mat& right) {
  const Brightness a = Measure(left);
  const Brightness b = Measure(right);
  if (!(a.deviation > 1) || !(b.deviation > 1)) {
    return right;
  }
  const double gain = std::clamp(a.deviation / b.deviation, 0.5, 2.0);
  const double offset = a.mean - gain * b.mean;
  if (std::abs(gain - 1) < 0.03 && std::abs(a.mean - b.mean) < 3) {
    return right;
  }
  cv::Mat matched;
  right.convertTo(matched, CV_8U, gain, offset);
  return matched;
}

/// 255 where the 3x3 neighbourhood is all black or all white.
cv::Mat UniformMask(const cv::Mat& image) {
  const cv::Mat element = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  cv::Mat low;
  cv::Mat high;
  cv::erode(image, low, element, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::dilate(image, high, element, {-1, -1}, 1, cv::BORDER_REPLICATE);
  return (high == 0) | (low == 255);
}

cv::Mat RunSgbm(const cv::Mat& left, const cv::Mat& right, int count,
                const StereoSettings& settings) {
  const int block = settings.block_size_px | 1;
  const cv::Ptr<cv::StereoSGBM> sgbm = cv::StereoSGBM::create(
      0, count, block, 8 * block * block, 32 * block * block,
      static_cast<int>(std::lround(settings.max_left_right_px)), kPreFilterCap,
      static_cast<int>(std::lround(settings.uniqueness_percent)), kSpeckleArea_px, kSpeckleRange_px,
      cv::StereoSGBM::MODE_SGBM_3WAY);
  cv::Mat disparity;
  sgbm->compute(left, right, disparity);
  return disparity;
}

}  // namespace

ImageF MatchWholePixels(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                        const StereoSettings& settings) {
  const cv::Mat left_view = View(left);
  const cv::Mat right_view = View(right);
  const int width = left.width();
  const int height = left.height();
  const int overlap = width - window.min_px;  // columns both pictures share at the least disparity
  const cv::Mat matched = MatchBrightness(left_view, right_view);
  cv::Mat left_padded;
  cv::Mat right_padded;
  cv::copyMakeBorder(left_view.colRange(window.min_px, width), left_padded, 0, 0, window.count, 0,
                     cv::BORDER_REPLICATE);
  cv::copyMakeBorder(matched.colRange(0, overlap), right_padded, 0, 0, window.count, 0,
                     cv::BORDER_REPLICATE);
  const cv::Mat sixteenths = RunSgbm(left_padded, right_padded, window.count, settings);
  const cv::Mat left_uniform = UniformMask(left_view);
  const cv::Mat right_uniform = UniformMask(right_view);

  ImageF disparity(width, height, std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < height; ++y) {
    const std::int16_t* found = sixteenths.ptr<std::int16_t>(y) + window.count;
    const std::uint8_t* uniform = left_uniform.ptr<std::uint8_t>(y) + window.min_px;
    const std::uint8_t* other = right_uniform.ptr<std::uint8_t>(y);
    float* out = disparity.row(y) + window.min_px;
    for (int x = 0; x < overlap; ++x) {
      const int match = x - (found[x] + 8) / 16;  // column in the right picture
      if (found[x] >= 0 && match >= 0 && uniform[x] == 0 && other[match] == 0) {
        out[x] = static_cast<float>(found[x] / kFixedPoint + window.min_px);
      }
    }
  }
  return disparity;
}

}  // namespace palace
