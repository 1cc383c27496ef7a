#include "engine/tracking/feature_selection.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"

namespace palace {
namespace {

struct Corner {
  float strength = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

constexpr float kMinEigenvalue = 1e-5F;  // below it lies sensor noise on bare ground

/// Local maxima of the smaller eigenvalue, in full-resolution pixels, strongest first.
std::vector<Corner> FindCorners(const ImageU8& picture, const FeatureSelectionOptions& options) {
  const cv::Mat full = GreyView(picture);
  cv::Mat half;
  cv::Mat strength;
  cv::Mat dilated;
  cv::pyrDown(full, half);
  cv::cornerMinEigenVal(half, strength, 5, 3);
  cv::dilate(strength, dilated, cv::Mat());
  const int border = static_cast<int>(std::ceil(options.border_px / 2));
  std::vector<Corner> corners;
  for (int y = border; y < half.rows - border; ++y) {
    const float* row = strength.ptr<float>(y);
    const float* peak = dilated.ptr<float>(y);
    for (int x = border; x < half.cols - border; ++x) {
      if (row[x] >= kMinEigenvalue && row[x] >= peak[x]) {
        // pyrDown keeps even pixels: pixel (x, y) of the half picture is (2x, 2y) of the full one.
        corners.push_back({row[x], Eigen::Vector2d(2.0 * x, 2.0 * y)});
      }
    }
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.strength > b.strength; });
  return corners;
}

/// Points kept so far in square buckets of the spacing, so that a neighbour check is nine buckets.
class Spread {
 public:
  Spread(const ImageU8& picture, double spacing_px)
      : spacing_px_(spacing_px),
        cols_(static_cast<int>(picture.width() / spacing_px) + 1),
        rows_(static_cast<int>(picture.height() / spacing_px) + 1),
        buckets_(static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows_)) {}

  void Add(const Eigen::Vector2d& pixel) { Bucket(Col(pixel), Row(pixel)).push_back(pixel); }

  bool IsFree(const Eigen::Vector2d& pixel) const {
    for (int row = std::max(Row(pixel) - 1, 0); row <= std::min(Row(pixel) + 1, rows_ - 1); ++row) {
      for (int col = std::max(Col(pixel) - 1, 0); col <= std::min(Col(pixel) + 1, cols_ - 1);
           ++col) {
        for (const Eigen::Vector2d& other : buckets_[Index(col, row)]) {
          if ((other - pixel).squaredNorm() < spacing_px_ * spacing_px_) {
            return false;
          }
        }
      }
    }
    return true;
  }

 private:
  int Col(const Eigen::Vector2d& p) const {
    return std::clamp(static_cast<int>(p.x() / spacing_px_), 0, cols_ - 1);
  }
  int Row(const Eigen::Vector2d& p) const {
    return std::clamp(static_cast<int>(p.y() / spacing_px_), 0, rows_ - 1);
  }
  std::size_t Index(int col, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
           static_cast<std::size_t>(col);
  }
  std::vector<Eigen::Vector2d>& Bucket(int col, int row) { return buckets_[Index(col, row)]; }

  double spacing_px_;
  int cols_;
  int rows_;
  std::vector<std::vector<Eigen::Vector2d>> buckets_;
};

}  // namespace

std::vector<Eigen::Vector2d> SelectFeatures(const ImageU8& picture,
                                            const std::vector<Eigen::Vector2d>& taken,
                                            const FeatureSelectionOptions& options) {
  PALACE_CHECK(options.spacing_px >= 1, options.spacing_px);
  std::vector<Eigen::Vector2d> features;
  if (picture.width() < 4 * options.border_px || picture.height() < 4 * options.border_px) {
    return features;
  }
  Spread spread(picture, options.spacing_px);
  for (const Eigen::Vector2d& pixel : taken) {
    spread.Add(pixel);
  }
  for (const Corner& corner : FindCorners(picture, options)) {
    if (static_cast<int>(features.size()) >= options.max_count) {
      break;
    }
    if (spread.IsFree(corner.pixel)) {
      spread.Add(corner.pixel);
      features.push_back(corner.pixel);
    }
  }
  return features;
}

}  // namespace palace
