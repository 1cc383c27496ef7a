#include "engine/slad/pictures/older_views.h"

#include <array>
#include <cstdint>

#include <opencv2/imgproc.hpp>

namespace palace {
namespace {

constexpr std::size_t kKept = 4;
constexpr double kApart_m = 0.1;

}  // namespace

// Sums of sixteenths of grey: exact in any order, so the same bits everywhere.
ImageF SmoothedPicture(const ImageU8& picture) {
  const std::array<float, 5> binomial = {1 / 16.0F, 4 / 16.0F, 6 / 16.0F, 4 / 16.0F, 1 / 16.0F};
  ImageF smooth(picture.width(), picture.height());
  const cv::Mat from(picture.height(), picture.width(), CV_8U,
                     const_cast<std::uint8_t*>(picture.row(0)));
  cv::Mat to(smooth.height(), smooth.width(), CV_32F, smooth.row(0));
  cv::sepFilter2D(from, to, CV_32F, binomial, binomial, {-1, -1}, 0, cv::BORDER_REPLICATE);
  return smooth;
}

void OlderViews::Remember(const SceneView& view) {
  const ViewPose& pose = *view.range->pose;
  if (!views_.empty() && views_.back().camera != view.range->camera) {
    views_.clear();
  }
  if (!views_.empty() && (views_.back().pose.X_WC.p - pose.X_WC.p).norm() < kApart_m) {
    return;
  }
  views_.push_back({view.range->camera, pose, SmoothedPicture(*view.left)});
  if (views_.size() > kKept) {
    views_.pop_front();
  }
}

}  // namespace palace
