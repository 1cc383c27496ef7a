#include "engine/tracking/template_match.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"

namespace palace {
namespace {

constexpr double kMinVariance = 1.0;  // grey levels squared, as in coherence.cpp

/// Scores over flat ground are rounding errors divided by rounding errors, up to 1.
void ForgetFlatPlaces(const cv::Mat& window, int side, cv::Mat& score) {
  cv::Mat sums, squares;
  cv::integral(window, sums, squares, CV_64F, CV_64F);
  const auto box = [side](const cv::Mat& sum, int x, int y) {
    return sum.at<double>(y + side, x + side) - sum.at<double>(y, x + side) -
           sum.at<double>(y + side, x) + sum.at<double>(y, x);
  };
  const double n = static_cast<double>(side) * side;
  for (int y = 0; y < score.rows; ++y) {
    float* row = score.ptr<float>(y);
    for (int x = 0; x < score.cols; ++x) {
      const double mean = box(sums, x, y) / n;
      const double variance = box(squares, x, y) / n - mean * mean;
      row[x] = variance > kMinVariance && std::isfinite(row[x]) ? row[x] : 0.F;
    }
  }
}

double Parabola(double before, double at, double after) {
  const double bend = before - 2 * at + after;
  return bend < -1e-12 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

Eigen::Vector2d TopNear(const cv::Mat& score, const cv::Point& at) {
  Eigen::Vector2d top(at.x, at.y);
  if (at.x > 0 && at.x + 1 < score.cols) {
    top.x() += Parabola(score.at<float>(at.y, at.x - 1), score.at<float>(at.y, at.x),
                        score.at<float>(at.y, at.x + 1));
  }
  if (at.y > 0 && at.y + 1 < score.rows) {
    top.y() += Parabola(score.at<float>(at.y - 1, at.x), score.at<float>(at.y, at.x),
                        score.at<float>(at.y + 1, at.x));
  }
  return top;
}

}  // namespace

TemplateMatch MatchTemplate(const ImageU8& window, const ImageU8& wanted) {
  const int side = wanted.width();
  PALACE_CHECK(side > 0 && wanted.height() == side, side, wanted.height());
  PALACE_CHECK(window.width() >= side && window.height() >= side, window.width(), window.height());
  cv::Mat score;
  cv::matchTemplate(GreyView(window), GreyView(wanted), score, cv::TM_CCOEFF_NORMED);
  ForgetFlatPlaces(GreyView(window), side, score);
  double best = 0;
  cv::Point at;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &at);
  TemplateMatch match;
  match.corner = {at.x, at.y};
  match.between = TopNear(score, at);
  match.score = std::clamp(best, 0.0, 1.0);
  cv::Mat peak;
  cv::dilate(score, peak, cv::Mat::ones(5, 5, CV_8U));
  const int same_place = std::max(side / 8, 2);
  for (int y = 0; y < score.rows; ++y) {
    const float* row = score.ptr<float>(y);
    const float* top = peak.ptr<float>(y);
    for (int x = 0; x < score.cols; ++x) {
      const bool other = std::max(std::abs(x - at.x), std::abs(y - at.y)) > same_place;
      if (other && row[x] >= top[x]) {
        match.second_score = std::max(match.second_score, static_cast<double>(row[x]));
      }
    }
  }
  match.second_score = std::min(match.second_score, 1.0);
  return match;
}

}  // namespace palace
