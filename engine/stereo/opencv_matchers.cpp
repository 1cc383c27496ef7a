#include "engine/stereo/opencv_matchers.h"

#include <cmath>
#include <limits>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "engine/camera/grey_view.h"

namespace palace {
namespace {

constexpr int kPreFilterCap = 31;
constexpr int kBmWindow_px = 15;
constexpr int kSpeckleArea_px = 100;
constexpr int kSpeckleRange_px = 2;
constexpr float kFixedPoint = 16.0F;  // OpenCV's disparities are sixteenths of a pixel

int Mode(OpenCvMatcher matcher) {
  switch (matcher) {
    case OpenCvMatcher::kSgbmHh:
      return cv::StereoSGBM::MODE_HH;
    case OpenCvMatcher::kSgbmHh4:
      return cv::StereoSGBM::MODE_HH4;
    case OpenCvMatcher::kSgbm3Way:
      return cv::StereoSGBM::MODE_SGBM_3WAY;
    default:
      return cv::StereoSGBM::MODE_SGBM;
  }
}

cv::Ptr<cv::StereoMatcher> Make(OpenCvMatcher matcher, int count, const StereoSettings& settings) {
  const int left_right = static_cast<int>(std::lround(settings.max_left_right_px));
  const int uniqueness = static_cast<int>(std::lround(settings.uniqueness_percent));
  if (matcher == OpenCvMatcher::kBm) {
    const cv::Ptr<cv::StereoBM> bm = cv::StereoBM::create(count, kBmWindow_px);
    bm->setPreFilterType(cv::StereoBM::PREFILTER_XSOBEL);
    bm->setPreFilterCap(kPreFilterCap);
    bm->setUniquenessRatio(uniqueness);
    bm->setDisp12MaxDiff(left_right);
    bm->setSpeckleWindowSize(kSpeckleArea_px);
    bm->setSpeckleRange(kSpeckleRange_px);
    return bm;
  }
  const int block = settings.block_size_px | 1;
  return cv::StereoSGBM::create(0, count, block, 8 * block * block, 32 * block * block, left_right,
                                kPreFilterCap, uniqueness, kSpeckleArea_px, kSpeckleRange_px,
                                Mode(matcher));
}

}  // namespace

const char* NameOf(OpenCvMatcher matcher) {
  switch (matcher) {
    case OpenCvMatcher::kBm:
      return "BM";
    case OpenCvMatcher::kSgbm:
      return "SGBM";
    case OpenCvMatcher::kSgbm3Way:
      return "SGBM 3WAY";
    case OpenCvMatcher::kSgbmHh:
      return "SGBM HH";
    case OpenCvMatcher::kSgbmHh4:
      return "SGBM HH4";
  }
  return "";
}

ImageF MatchWithOpenCv(OpenCvMatcher matcher, const ImageU8& left, const ImageU8& right,
                       const DisparityWindow& window, const StereoSettings& settings) {
  const int width = left.width();
  const int overlap = width - window.min_px;  // columns both pictures share at the least disparity
  cv::Mat left_padded;
  cv::Mat right_padded;
  cv::copyMakeBorder(GreyView(left).colRange(window.min_px, width), left_padded, 0, 0, window.count,
                     0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(GreyView(right).colRange(0, overlap), right_padded, 0, 0, window.count, 0,
                     cv::BORDER_REPLICATE);
  cv::Mat sixteenths;
  Make(matcher, window.count, settings)->compute(left_padded, right_padded, sixteenths);
  ImageF disparity(width, left.height(), std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < left.height(); ++y) {
    const std::int16_t* found = sixteenths.ptr<std::int16_t>(y) + window.count;
    float* out = disparity.row(y) + window.min_px;
    for (int x = 0; x < overlap; ++x) {
      if (found[x] >= 0 && x - (found[x] + 8) / 16 >= 0) {
        out[x] = static_cast<float>(found[x]) / kFixedPoint + static_cast<float>(window.min_px);
      }
    }
  }
  return disparity;
}

}  // namespace palace
