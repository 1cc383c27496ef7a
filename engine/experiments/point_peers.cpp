#include <memory>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/tracking.hpp>
#include <opencv2/video/tracking.hpp>

#include "engine/camera/grey_view.h"
#include "engine/core/check.h"
#include "engine/experiments/point_methods.h"

namespace palace {
namespace {

constexpr int kBox_px = 41;
constexpr int kEccReach_px = 40;

cv::Point2f PointOf(const Eigen::Vector2d& pixel) {
  return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
}

FollowPoint StartKlt(const ImageU8& first, const Eigen::Vector2d& pixel) {
  struct Memory {
    cv::Mat before;
    cv::Point2f at;
  };
  auto memory = std::make_shared<Memory>(Memory{GreyView(first).clone(), PointOf(pixel)});
  return [memory](const ImageU8& picture, int) {
    std::vector<cv::Point2f> next;
    std::vector<unsigned char> status;
    cv::calcOpticalFlowPyrLK(memory->before, GreyView(picture), std::vector{memory->at}, next,
                             status, cv::noArray(), cv::Size(21, 21), 3);
    memory->before = GreyView(picture).clone();
    memory->at = status[0] != 0 ? next[0] : memory->at;
    return PointReading{{double(memory->at.x), double(memory->at.y)}, status[0] != 0};
  };
}

FollowPoint StartBox(cv::Ptr<cv::Tracker> tracker, const ImageU8& first,
                     const Eigen::Vector2d& pixel) {
  cv::Rect box(cvRound(pixel.x()) - kBox_px / 2, cvRound(pixel.y()) - kBox_px / 2, kBox_px,
               kBox_px);
  const auto middle = [](const cv::Rect& b) {
    return Eigen::Vector2d(b.x + 0.5 * (b.width - 1), b.y + 0.5 * (b.height - 1));
  };
  const auto colour = [](const ImageU8& picture) {
    cv::Mat bgr;
    cv::cvtColor(GreyView(picture), bgr, cv::COLOR_GRAY2BGR);
    return bgr;
  };
  tracker->init(colour(first), box);
  const Eigen::Vector2d offset = pixel - middle(box);
  return [tracker, box, offset, middle, colour](const ImageU8& picture, int) mutable {
    const bool found = tracker->update(colour(picture), box);
    return PointReading{middle(box) + offset, found};
  };
}

FollowPoint StartEcc(const ImageU8& first, const Eigen::Vector2d& pixel, double min_coherence) {
  struct Memory {
    cv::Mat wanted;
    cv::Matx23d warp;  ///< picture from template
  };
  const double half = kBox_px / 2;
  auto memory = std::make_shared<Memory>();
  memory->warp = {1, 0, pixel.x() - half, 0, 1, pixel.y() - half};
  cv::getRectSubPix(GreyView(first), cv::Size(kBox_px, kBox_px), PointOf(pixel), memory->wanted);
  return [memory, half, min_coherence](const ImageU8& picture, int) {
    const auto middle = [half](const cv::Matx23d& warp) {
      const cv::Vec2d at = warp * cv::Vec3d(half, half, 1);
      return Eigen::Vector2d(at[0], at[1]);
    };
    const Eigen::Vector2d last = middle(memory->warp);
    const double scale = std::sqrt(std::abs(memory->warp(0, 0) * memory->warp(1, 1) -
                                            memory->warp(0, 1) * memory->warp(1, 0)));
    const int reach = kEccReach_px + cvCeil(std::min(scale, 12.0) * half);
    const cv::Rect part = cv::Rect(cvRound(last.x()) - reach, cvRound(last.y()) - reach,
                                   2 * reach + 1, 2 * reach + 1) &
                          cv::Rect(0, 0, picture.width(), picture.height());
    PointReading reading{last, false, 0};
    if (part.width < kBox_px || part.height < kBox_px) {
      return reading;
    }
    cv::Mat warp = cv::Mat(memory->warp).clone();
    warp.convertTo(warp, CV_32F);
    warp.at<float>(0, 2) -= static_cast<float>(part.x);
    warp.at<float>(1, 2) -= static_cast<float>(part.y);
    const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-4);
    try {
      reading.coherence =
          std::max(0.0, cv::findTransformECC(memory->wanted, GreyView(picture)(part), warp,
                                             cv::MOTION_AFFINE, until, cv::noArray(), 5));
    } catch (const cv::Exception&) {  // it has not converged
      return reading;
    }
    cv::Matx23d found;
    cv::Mat(warp).convertTo(cv::Mat(found, false), CV_64F);
    found(0, 2) += part.x;
    found(1, 2) += part.y;
    if (!middle(found).array().isFinite().all()) {
      return reading;
    }
    memory->warp = found;
    reading.pixel = middle(found);
    reading.followed = reading.coherence >= min_coherence;
    return reading;
  };
}

}  // namespace

FollowPoint StartPeer(PointMethod method, const ImageU8& first, const Eigen::Vector2d& pixel,
                      double min_coherence) {
  switch (method) {
    case PointMethod::kKlt:
      return StartKlt(first, pixel);
    case PointMethod::kKcf:
      return StartBox(cv::TrackerKCF::create(), first, pixel);
    case PointMethod::kCsrt:
      return StartBox(cv::TrackerCSRT::create(), first, pixel);
    case PointMethod::kEcc:
      return StartEcc(first, pixel, min_coherence);
    default:
      PALACE_CHECK(false, static_cast<int>(method));
      return {};
  }
}

}  // namespace palace
