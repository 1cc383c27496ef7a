#include "engine/calibration/dot_finder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"

namespace palace {
namespace {

constexpr std::size_t kMostDots = 5000;
constexpr int kLeastArea_px = 8;
constexpr double kDarkness = 0.4;           // standard deviations under the local mean
constexpr double kLeastDeviation = 3;       // grey levels; below it a window is empty paper
constexpr double kMostElongation = 6;       // of the axes: 80 degrees of slant
constexpr double kEllipseTolerance = 0.22;  // area against the ellipse of the same moments
constexpr double kLeastContrast = 8;        // grey levels between dot and ring

constexpr double kWindowPerAxis = 1.35;  // first look: of the dot's half axes with their margin
constexpr double kRingPerAxis = 1.75;
constexpr double kBlurMargin_px = 1.5;
constexpr double kWindowInGap = 0.36;  // in the grid: of the gap to the neighbour's edge
constexpr double kRingInGap = 0.56;
constexpr double kWindowFade = 0.8;  // of the window: from here its weight falls to 0
constexpr int kRefineSteps = 4;
constexpr double kConverged_px = 1e-4;

struct Component {
  int label = 0;
  cv::Rect box;
  int area = 0;
};

/// 255 where the smoothed picture is darker than its surroundings.
cv::Mat DarkPixels(const cv::Mat& grey, int window_px) {
  cv::Mat smooth, square, mean, mean_square;
  cv::GaussianBlur(grey, smooth, {3, 3}, 0);
  smooth.convertTo(smooth, CV_32F);
  cv::multiply(smooth, smooth, square);
  const cv::Size window(window_px | 1, window_px | 1);
  cv::boxFilter(smooth, mean, CV_32F, window);
  cv::boxFilter(square, mean_square, CV_32F, window);
  cv::Mat dark(grey.size(), CV_8U);
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) {
      const double m = mean.at<float>(y, x);
      const double deviation = std::sqrt(std::max(0.0, mean_square.at<float>(y, x) - m * m));
      const double limit = m - kDarkness * deviation;
      dark.at<std::uint8_t>(y, x) =
          deviation > kLeastDeviation && smooth.at<float>(y, x) < limit ? 255 : 0;
    }
  }
  return dark;
}

/// Mean and covariance of a component's pixels, a pixel taken as a square.
Dot MomentsOf(const cv::Mat& labels, const Component& component) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  for (int y = component.box.y; y < component.box.y + component.box.height; ++y) {
    for (int x = component.box.x; x < component.box.x + component.box.width; ++x) {
      if (labels.at<int>(y, x) == component.label) {
        const double dx = x - component.box.x, dy = y - component.box.y;
        n += 1;
        sx += dx;
        sy += dy;
        sxx += dx * dx;
        sxy += dx * dy;
        syy += dy * dy;
      }
    }
  }
  Dot dot;
  const double mx = sx / n, my = sy / n;
  dot.centre = {component.box.x + mx, component.box.y + my};
  constexpr double kPixelVariance = 1.0 / 12;
  dot.covariance << sxx / n - mx * mx + kPixelVariance, sxy / n - mx * my, sxy / n - mx * my,
      syy / n - my * my + kPixelVariance;
  dot.area_px = n;
  return dot;
}

bool IsElliptic(const Dot& dot) {
  const double determinant = dot.covariance.determinant();
  if (!(determinant > 0)) {
    return false;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(dot.covariance);
  const double elongation = std::sqrt(axes.eigenvalues()[1] / axes.eigenvalues()[0]);
  const double of_moments = 4 * std::numbers::pi * std::sqrt(determinant);
  return elongation < kMostElongation && std::abs(dot.area_px / of_moments - 1) < kEllipseTolerance;
}

/// What is weighed and what is background: an ellipse, window and ring in multiples of it.
struct Window {
  Eigen::Matrix2d shape;  ///< d^T shape^-1 d = 1 on the ellipse, px^2
  double window = 0;
  double ring = 0;
};

/// Calls visit(x, y, m) for every pixel with m = the factor by which the ellipse round `centre`
/// would have to grow to reach the pixel, up to `most`. False when that leaves the picture.
template <typename Visit>
bool ForEllipse(const ImageU8& picture, const Eigen::Vector2d& centre, const Eigen::Matrix2d& shape,
                double most, Visit visit) {
  const Eigen::Matrix2d inverse = shape.inverse();
  const double reach_x = most * std::sqrt(shape(0, 0)), reach_y = most * std::sqrt(shape(1, 1));
  const double left = std::floor(centre.x() - reach_x);
  const double right = std::ceil(centre.x() + reach_x);
  const double top = std::floor(centre.y() - reach_y);
  const double bottom = std::ceil(centre.y() + reach_y);
  if (!(left >= 0 && top >= 0 && right < picture.width() && bottom < picture.height())) {
    return false;
  }
  for (int y = static_cast<int>(top); y <= static_cast<int>(bottom); ++y) {
    for (int x = static_cast<int>(left); x <= static_cast<int>(right); ++x) {
      const Eigen::Vector2d d(x - centre.x(), y - centre.y());
      const double m = std::sqrt(d.dot(inverse * d));
      if (m <= most) {
        visit(x, y, m);
      }
    }
  }
  return true;
}

/// Background grey = a + b (x - cx) + c (y - cy), fitted to the ring without what is dark in it:
/// neighbouring dots, the edge of the board.
class Background {
 public:
  void Add(double dx, double dy, double grey) { samples_.push_back({dx, dy, grey}); }

  bool Fit() {
    constexpr std::size_t kLeastSamples = 12;
    constexpr int kTrims = 3;
    if (samples_.size() < kLeastSamples) {
      return false;
    }
    // The brighter half tells the board's level; whatever is far from it is something else.
    std::vector<double> greys;
    for (const Eigen::Vector3d& s : samples_) {
      greys.push_back(s.z());
    }
    const auto upper = greys.begin() + static_cast<std::ptrdiff_t>(greys.size() * 3 / 4);
    std::nth_element(greys.begin(), upper, greys.end());
    plane_ = {*upper, 0, 0};
    double limit = 0.2 * *upper;
    for (int trim = 0; trim < kTrims; ++trim) {
      Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      std::size_t kept = 0;
      for (const Eigen::Vector3d& s : samples_) {
        if (std::abs(s.z() - At(s.x(), s.y())) <= limit) {
          const Eigen::Vector3d row(1, s.x(), s.y());
          normal += row * row.transpose();
          right += row * s.z();
          ++kept;
        }
      }
      if (kept < kLeastSamples) {
        return false;
      }
      plane_ = normal.ldlt().solve(right);
      double sum = 0;
      for (const Eigen::Vector3d& s : samples_) {
        const double off = s.z() - At(s.x(), s.y());
        sum += std::abs(off) <= limit ? off * off : 0;
      }
      constexpr double kTrimSigmas = 2.5;
      constexpr double kQuantum = 1.5;  // grey levels: never trim the rounding
      limit = std::max(kTrimSigmas * std::sqrt(sum / static_cast<double>(kept)), kQuantum);
    }
    return plane_.allFinite();
  }

  double At(double dx, double dy) const { return plane_[0] + plane_[1] * dx + plane_[2] * dy; }

 private:
  std::vector<Eigen::Vector3d> samples_;
  Eigen::Vector3d plane_ = Eigen::Vector3d::Zero();
};

/// Weight 1 - grey / background; the window fades out at its rim, so that pixels entering or
/// leaving it do not pull.
struct Weighed {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double area_px = 0;
};

std::optional<Weighed> Weigh(const ImageU8& picture, const Eigen::Vector2d& centre,
                             const Window& window) {
  Background background;
  const bool inside =
      ForEllipse(picture, centre, window.shape, window.ring, [&](int x, int y, double m) {
        if (m > window.window) {
          background.Add(x - centre.x(), y - centre.y(), picture.at(x, y));
        }
      });
  if (!inside || !background.Fit() || !(background.At(0, 0) > kLeastContrast)) {
    return std::nullopt;
  }
  double sum = 0, darkest = 1;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  bool bright = true;
  ForEllipse(picture, centre, window.shape, window.window, [&](int x, int y, double m) {
    const Eigen::Vector2d d(x - centre.x(), y - centre.y());
    const double level = background.At(d.x(), d.y());
    bright = bright && level > kLeastContrast;
    if (!bright) {
      return;
    }
    const double share = picture.at(x, y) / level;
    const double fade = std::min(1.0, (1 - m / window.window) / (1 - kWindowFade));
    const double weight = fade * (1 - share);
    darkest = std::min(darkest, share);
    sum += weight;
    first += weight * d;
    second += weight * d * d.transpose();
  });
  const double contrast = 1 - darkest;
  if (!bright || !(contrast * background.At(0, 0) > kLeastContrast) ||
      !(sum > 0.5 * kLeastArea_px * contrast)) {
    return std::nullopt;
  }
  Weighed result;
  result.shift = first / sum;
  result.covariance = second / sum - result.shift * result.shift.transpose();
  result.area_px = sum / contrast;
  return result;
}

/// The window of a first look at a dot, from its own moments.
Window WindowOf(const Dot& dot) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(dot.covariance);
  const Eigen::Vector2d half = 2 * solver.eigenvalues().cwiseMax(0.05).cwiseSqrt() +
                               Eigen::Vector2d::Constant(kBlurMargin_px);
  const Eigen::Matrix2d axes = solver.eigenvectors();
  return {axes * half.cwiseAbs2().asDiagonal() * axes.transpose(), kWindowPerAxis, kRingPerAxis};
}

}  // namespace

std::vector<Dot> FindDots(const ImageU8& picture, int window_px) {
  const cv::Mat grey = GreyView(picture);
  cv::Mat labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(DarkPixels(grey, window_px), labels, stats,
                                                     centroids, 8, CV_32S);
  std::vector<Dot> dots;
  for (int label = 1; label < count; ++label) {
    const Component component{
        label,
        {stats.at<int>(label, cv::CC_STAT_LEFT), stats.at<int>(label, cv::CC_STAT_TOP),
         stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT)},
        stats.at<int>(label, cv::CC_STAT_AREA)};
    const cv::Rect& box = component.box;
    if (component.area < kLeastArea_px || box.width > window_px || box.height > window_px ||
        box.x <= 0 || box.y <= 0 || box.x + box.width >= grey.cols ||
        box.y + box.height >= grey.rows) {
      continue;
    }
    const Dot dot = MomentsOf(labels, component);
    if (IsElliptic(dot)) {
      dots.push_back(dot);
    }
  }
  if (dots.size() > kMostDots) {
    dots.clear();
  }
  return dots;
}

bool RefineDot(const ImageU8& picture, Dot& dot) {
  Dot refined = dot;
  for (int i = 0; i < kRefineSteps; ++i) {
    const auto weighed = Weigh(picture, refined.centre, WindowOf(refined));
    if (!weighed) {
      return false;
    }
    const double change = weighed->covariance.determinant() / dot.covariance.determinant();
    if (!(change > 0.2 && change < 5) || !(weighed->covariance(0, 0) > 0)) {
      return false;
    }
    refined.centre += weighed->shift;
    refined.covariance = weighed->covariance;
    refined.area_px = weighed->area_px;
    if (weighed->shift.norm() < kConverged_px) {
      break;
    }
  }
  if ((refined.centre - dot.centre).squaredNorm() > dot.covariance.trace()) {
    return false;
  }
  dot = refined;
  return true;
}

std::optional<Eigen::Vector2d> RefineInGrid(const ImageU8& picture, const GridDot& dot) {
  // Radii in pitches; the ellipse of radius 1 pitch is steps * unit circle.
  const double gap = 1 - dot.neighbour_radius - dot.radius;
  const Window window{dot.steps * dot.steps.transpose(), dot.radius + kWindowInGap * gap,
                      dot.radius + kRingInGap * gap};
  Eigen::Vector2d centre = dot.centre;
  const double limit_px = dot.radius * std::sqrt(dot.steps.determinant());
  for (int i = 0; i < kRefineSteps; ++i) {
    const auto weighed = Weigh(picture, centre, window);
    if (!weighed || !((centre + weighed->shift - dot.centre).norm() < limit_px)) {
      return std::nullopt;
    }
    centre += weighed->shift;
    if (weighed->shift.norm() < kConverged_px) {
      break;
    }
  }
  return centre;
}

}  // namespace palace
