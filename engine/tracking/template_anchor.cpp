#include "engine/tracking/template_anchor.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"
#include "engine/core/median.h"

namespace palace {
namespace {

constexpr float kMinVariance = 1.0F;     // grey levels squared, as in coherence.cpp
constexpr float kMinEigenvalue = 0.02F;  // (grey levels per px) squared: below it, only noise
constexpr int kIterations = 12;
constexpr double kConverged_px = 0.005;
constexpr float kDamping = 1e-3F;     // an edge alone leaves one direction open
constexpr double kLargestStep = 1.3;  // of scale
constexpr float kTukey = 4.685F;      // 95 % as precise as plain least squares where nothing covers
constexpr float kLeastSigma = 0.1F;   // of the template's contrast: sensor noise, interpolation

/// A smoothed part of a picture, sampled between pixels; beyond it the edge is repeated. Bilinear
/// weights of unsmoothed pixels pull towards whole and half places.
class SmoothPart {
 public:
  SmoothPart(const ImageU8& picture, const Eigen::Vector2d& centre, double reach_px) {
    const cv::Mat whole = GreyView(picture);
    const int reach = static_cast<int>(std::ceil(reach_px)) + 2;
    cv::Rect part(static_cast<int>(std::lround(centre.x())) - reach,
                  static_cast<int>(std::lround(centre.y())) - reach, 2 * reach + 1, 2 * reach + 1);
    part &= cv::Rect(0, 0, whole.cols, whole.rows);
    if (part.empty()) {
      part = cv::Rect(0, 0, whole.cols, whole.rows);
    }
    origin_ = Eigen::Vector2d(part.x, part.y);
    cv::Mat grey;
    whole(part).convertTo(grey, CV_32F);
    cv::GaussianBlur(grey, smooth_, cv::Size(5, 5), 1.1);
  }

  float At(const Eigen::Vector2d& pixel) const {
    const double x = std::clamp(pixel.x() - origin_.x(), 0.0, smooth_.cols - 1.0);
    const double y = std::clamp(pixel.y() - origin_.y(), 0.0, smooth_.rows - 1.0);
    const int x0 = std::min(static_cast<int>(x), std::max(smooth_.cols - 2, 0));
    const int y0 = std::min(static_cast<int>(y), std::max(smooth_.rows - 2, 0));
    const float a = static_cast<float>(x - x0), b = static_cast<float>(y - y0);
    const float* row = smooth_.ptr<float>(y0) + x0;
    const float* next = smooth_.ptr<float>(std::min(y0 + 1, smooth_.rows - 1)) + x0;
    const int right = x0 + 1 < smooth_.cols ? 1 : 0;
    const float top = row[0] + a * (row[right] - row[0]);
    const float bottom = next[0] + a * (next[right] - next[0]);
    return top + b * (bottom - top);
  }

 private:
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  cv::Mat smooth_;
};

/// Grey levels that the template explains only with its own contrast, in units of the template:
/// (now - offset) / gain - values, with gain and offset by weighted least squares. Nothing where
/// the picture is even, or darker where the template is brighter.
std::optional<Eigen::VectorXf> Residuals(const Eigen::VectorXf& now, const Eigen::VectorXf& values,
                                         const Eigen::VectorXf& weights) {
  const float sum = weights.sum();
  const float mean_now = weights.dot(now) / sum, mean_value = weights.dot(values) / sum;
  const Eigen::VectorXf d_now = now.array() - mean_now, d_value = values.array() - mean_value;
  const float variance = weights.dot(d_now.cwiseAbs2()) / sum;
  const float common = weights.dot(d_now.cwiseProduct(d_value));
  const float own = weights.dot(d_value.cwiseAbs2());
  if (!(variance > kMinVariance && common > 0 && own > 0)) {
    return std::nullopt;
  }
  return d_now * (own / common) - d_value;
}

Eigen::VectorXf TukeyWeights(const Eigen::VectorXf& residuals) {
  const Eigen::VectorXf sizes = residuals.cwiseAbs();
  std::vector<float> sorted(sizes.data(), sizes.data() + sizes.size());
  const float least = kLeastSigma / std::sqrt(static_cast<float>(sizes.size()));
  const float sigma = std::max(static_cast<float>(kSigmaPerMad) * UpperMedian(sorted), least);
  const Eigen::ArrayXf rest = (1 - (residuals.array() / (kTukey * sigma)).square()).max(0.0F);
  return rest.square();
}

}  // namespace

std::optional<TemplateAnchor> TemplateAnchor::Make(const ImageU8& picture,
                                                   const Eigen::Vector2d& centre, int side,
                                                   int stride) {
  PALACE_CHECK(side > 2 && side % 2 == 1 && stride >= 1, side, stride);
  TemplateAnchor anchor;
  anchor.side_ = side;
  const int half = side / 2, a_row = (side + stride - 1) / stride;
  anchor.offsets_.resize(2, a_row * a_row);
  int count = 0;
  for (int y = -half; y <= half; y += stride) {
    for (int x = -half; x <= half; x += stride) {
      anchor.offsets_.col(count++) = Eigen::Vector2d(x, y);
    }
  }
  const SmoothPart smooth(picture, centre, half + 1);
  anchor.values_.resize(count);
  anchor.lean_.resize(4, count);
  Eigen::Matrix2f gradients = Eigen::Matrix2f::Zero();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d pixel = centre + anchor.offsets_.col(i);
    const Eigen::Vector2f o = anchor.offsets_.col(i).cast<float>();
    anchor.values_(i) = smooth.At(pixel);
    const Eigen::Vector2f g(0.5F * (smooth.At(pixel + Eigen::Vector2d::UnitX()) -
                                    smooth.At(pixel - Eigen::Vector2d::UnitX())),
                            0.5F * (smooth.At(pixel + Eigen::Vector2d::UnitY()) -
                                    smooth.At(pixel - Eigen::Vector2d::UnitY())));
    anchor.lean_.col(i) << g.x(), g.y(), g.dot(o), g.y() * o.x() - g.x() * o.y();
    gradients += g * g.transpose();
  }
  anchor.values_.array() -= anchor.values_.mean();
  const float length = anchor.values_.norm();
  const float weakest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2f>(gradients / static_cast<float>(count))
          .eigenvalues()(0);
  if (length * length <= kMinVariance * static_cast<float>(count) || weakest < kMinEigenvalue) {
    return std::nullopt;
  }
  anchor.values_ /= length;
  // What gain and offset of the exposure can explain is no sign of motion.
  anchor.lean_ /= length;
  anchor.lean_.colwise() -= anchor.lean_.rowwise().mean().eval();
  anchor.lean_ -= (anchor.lean_ * anchor.values_) * anchor.values_.transpose();
  return anchor;
}

std::optional<TemplateAnchor::Fit> TemplateAnchor::Refined(const ImageU8& picture,
                                                           const TemplatePlacement& start) const {
  const SmoothPart smooth(picture, start.place, start.scale * side_);
  TemplatePlacement at = start;
  Eigen::VectorXf now(values_.size());
  Eigen::VectorXf weights = Eigen::VectorXf::Ones(values_.size());
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::Matrix2d A = at.Linear();
    for (int i = 0; i < now.size(); ++i) {
      now(i) = smooth.At(at.place + A * offsets_.col(i));
    }
    const auto residuals = Residuals(now, values_, weights);
    if (!residuals) {
      return std::nullopt;
    }
    weights = TukeyWeights(*residuals);
    const Eigen::Matrix4Xf weighted = lean_ * weights.asDiagonal();
    Eigen::Matrix4f hessian = weighted * lean_.transpose();
    hessian.diagonal() *= 1 + kDamping;
    const Eigen::Vector4d step = hessian.ldlt().solve(weighted * *residuals).cast<double>();
    at.place -= A * step.head<2>();
    at.scale *= std::exp(-step(2));
    at.angle_rad -= step(3);
    if (!step.allFinite() || (at.place - start.place).norm() > side_ / 4.0 ||
        std::abs(std::log(at.scale / start.scale)) > std::log(kLargestStep)) {
      return std::nullopt;
    }
    if (step.head<2>().norm() + side_ / 2.0 * step.tail<2>().norm() < kConverged_px) {
      break;
    }
  }
  return Fit{at, double{weights.mean()}};
}

}  // namespace palace
