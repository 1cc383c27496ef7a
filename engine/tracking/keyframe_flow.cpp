#include "engine/tracking/keyframe_flow.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "engine/camera/grey_view.h"
#include "engine/tracking/view_geometry.h"

namespace palace {
namespace {

constexpr int kMinForHomography = 6;
constexpr double kVisibleMargin_px = 8;

cv::Mat WarpedKeyframe(const ImageU8& keyframe, const Eigen::Matrix3d& current_from_key) {
  cv::Matx33d H;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      H(r, c) = current_from_key(r, c);
    }
  }
  cv::Mat warped;
  cv::warpPerspective(GreyView(keyframe), warped, H, GreyView(keyframe).size(), cv::INTER_LINEAR,
                      cv::BORDER_REPLICATE);
  return warped;
}

/// The points as Lucas-Kanade wants them: those predicted inside the current picture only.
struct Batch {
  std::vector<std::size_t> index;
  std::vector<cv::Point2f> predicted;  // in the warped keyframe
  std::vector<cv::Point2f> seen;       // in the current picture
  std::vector<bool> found;
};

void RunForwardsAndBackwards(const cv::Mat& warped, const cv::Mat& current,
                             const KeyframeFlowOptions& options, Batch& batch) {
  const cv::Size window(options.window_px, options.window_px);
  const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 12, 0.02);
  std::vector<cv::Mat> warped_pyramid;
  std::vector<cv::Mat> current_pyramid;
  cv::buildOpticalFlowPyramid(warped, warped_pyramid, window, options.pyramid_levels);
  cv::buildOpticalFlowPyramid(current, current_pyramid, window, options.pyramid_levels, false);
  std::vector<unsigned char> forwards;
  std::vector<unsigned char> backwards;
  // Errors are not asked for: they would be measured over every window once more.
  cv::calcOpticalFlowPyrLK(warped_pyramid, current_pyramid, batch.predicted, batch.seen, forwards,
                           cv::noArray(), window, options.pyramid_levels, stop,
                           cv::OPTFLOW_USE_INITIAL_FLOW, 1e-4);
  std::vector<cv::Point2f> returned = batch.predicted;
  // The way back starts at the answer, so the full picture suffices to expose a false match.
  cv::calcOpticalFlowPyrLK(current_pyramid, warped_pyramid, batch.seen, returned, backwards,
                           cv::noArray(), window, 0, stop, cv::OPTFLOW_USE_INITIAL_FLOW, 1e-4);
  batch.found.resize(batch.seen.size());
  for (std::size_t i = 0; i < batch.seen.size(); ++i) {
    const cv::Point2f gap = returned[i] - batch.predicted[i];
    batch.found[i] = forwards[i] != 0 && backwards[i] != 0 &&
                     gap.dot(gap) <= options.max_return_px * options.max_return_px;
  }
}

/// Marks which found points move by one homography.
void MarkAgreement(const KeyframeFlowOptions& options, const Batch& batch,
                   std::vector<FlowPoint>& points) {
  std::vector<cv::Point2f> from;
  std::vector<cv::Point2f> to;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < batch.index.size(); ++i) {
    if (points[batch.index[i]].found) {
      from.push_back(batch.predicted[i]);
      to.push_back(batch.seen[i]);
      index.push_back(batch.index[i]);
    }
  }
  if (from.size() < static_cast<std::size_t>(kMinForHomography)) {
    return;
  }
  std::vector<unsigned char> inlier;
  const cv::Mat H =
      cv::findHomography(from, to, cv::RANSAC, options.max_residual_px, inlier, 500, 0.995);
  for (std::size_t i = 0; !H.empty() && i < index.size(); ++i) {
    points[index[i]].agrees = inlier[i] != 0;
  }
}

}  // namespace

std::vector<FlowPoint> FollowFromKeyframe(const ImageU8& keyframe, const ImageU8& current,
                                          const Eigen::Matrix3d& current_from_key,
                                          const std::vector<Eigen::Vector2d>& key_pixels,
                                          const KeyframeFlowOptions& options) {
  PALACE_CHECK(keyframe.width() == current.width() && keyframe.height() == current.height(),
               keyframe.width(), current.width());
  std::vector<FlowPoint> points(key_pixels.size());
  const PinholeCamera frame{current.width(), current.height(), 1, 1, 0, 0};
  Batch batch;
  for (std::size_t i = 0; i < key_pixels.size(); ++i) {
    const Eigen::Vector2d predicted = MapPixel(current_from_key, key_pixels[i]);
    const Eigen::Vector2d start = predicted + options.shift_px;
    points[i].pixel = start;
    points[i].visible = InPicture(frame, predicted, kVisibleMargin_px) &&
                        InPicture(frame, start, kVisibleMargin_px);
    if (points[i].visible) {
      batch.index.push_back(i);
      batch.predicted.emplace_back(static_cast<float>(predicted.x()),
                                   static_cast<float>(predicted.y()));
      batch.seen.emplace_back(static_cast<float>(start.x()), static_cast<float>(start.y()));
    }
  }
  if (batch.index.empty()) {
    return points;
  }
  RunForwardsAndBackwards(WarpedKeyframe(keyframe, current_from_key), GreyView(current), options,
                          batch);
  for (std::size_t i = 0; i < batch.index.size(); ++i) {
    FlowPoint& point = points[batch.index[i]];
    point.pixel = Eigen::Vector2d(batch.seen[i].x, batch.seen[i].y);
    point.found = batch.found[i] && InPicture(frame, point.pixel, 2);
  }
  MarkAgreement(options, batch, points);
  return points;
}

}  // namespace palace
