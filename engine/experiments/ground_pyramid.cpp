#include "engine/experiments/ground_pyramid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "engine/camera/pinhole.h"
#include "engine/core/check.h"
#include "engine/world/baked_ground.h"

namespace palace {
namespace {

constexpr float kSky = 200, kBeyond = 128;
constexpr float kTexel_px = 0.6F;
constexpr float kLowestRay = 0.02F;  // down per unit depth; below it, sky
constexpr float kRayOffsets_px[] = {-1.0F / 3, 0, 1.0F / 3};

/// A kernel of three taps with the lens's standard deviation.
void SpreadByLens(ImageF& grey) {
  constexpr double kSide = kLensBlur_px * kLensBlur_px / 2;
  const cv::Mat kernel = (cv::Mat_<float>(1, 3) << kSide, 1 - 2 * kSide, kSide);
  cv::Mat view(grey.height(), grey.width(), CV_32F, grey.pixels().data());
  cv::sepFilter2D(view, view, CV_32F, kernel, kernel, cv::Point(-1, -1), 0, cv::BORDER_REPLICATE);
}

/// Of four places, so far to each side; of one where that is 0.
double Mean(const GroundPyramid::GreyOfPlace& grey, double north_m, double east_m, double aside_m) {
  if (aside_m == 0) {
    return grey(north_m, east_m);
  }
  double sum = 0;
  for (const double north : {-aside_m, aside_m}) {
    for (const double east : {-aside_m, aside_m}) {
      sum += grey(north_m + north, east_m + east);
    }
  }
  return sum / 4;
}

}  // namespace

GroundPyramid::GroundPyramid(const GreyOfPlace& grey, const Extent& extent) {
  PALACE_CHECK(extent.finest_m > 0 && extent.side > 0 && extent.side % 4 == 0 && extent.levels > 0,
               extent.finest_m, extent.side, extent.levels);
  const int side = extent.side, quarter = side / 4;
  double texel_m = extent.finest_m;
  for (int l = 0; l < extent.levels; ++l, texel_m *= 2) {
    Level level{static_cast<float>(texel_m), ImageF(side, side)};
    const double edge_m = -0.5 * side * texel_m;
    for (int r = 0; r < side; ++r) {
      float* out = level.grey.row(r);
      for (int c = 0; c < side; ++c) {
        const double north_m = edge_m + (r + 0.5) * texel_m, east_m = edge_m + (c + 0.5) * texel_m;
        const bool inside =
            l > 0 && r >= quarter && r < 3 * quarter && c >= quarter && c < 3 * quarter;
        if (inside) {
          const float* upper = levels_.back().grey.row(2 * (r - quarter)) + 2 * (c - quarter);
          const float* lower = upper + side;
          out[c] = 0.25F * (upper[0] + upper[1] + lower[0] + lower[1]);
        } else {
          out[c] = static_cast<float>(Mean(grey, north_m, east_m, l == 0 ? 0 : 0.25 * texel_m));
        }
      }
    }
    levels_.push_back(std::move(level));
  }
}

float GroundPyramid::AtLevel(std::size_t level, float north_m, float east_m) const {
  for (; level < levels_.size(); ++level) {
    const Level& at = levels_[level];
    const float middle = 0.5F * static_cast<float>(at.grey.width() - 1);
    const float row = north_m / at.texel_m + middle, col = east_m / at.texel_m + middle;
    const auto last = static_cast<float>(at.grey.width() - 1);
    if (row >= 0 && col >= 0 && row < last && col < last) {
      const int r = static_cast<int>(row), c = static_cast<int>(col);
      const float a = row - static_cast<float>(r), b = col - static_cast<float>(c);
      const float* upper = at.grey.row(r) + c;
      const float* lower = upper + at.grey.width();
      const float top = upper[0] + b * (upper[1] - upper[0]);
      const float bottom = lower[0] + b * (lower[1] - lower[0]);
      return top + a * (bottom - top);
    }
  }
  return kBeyond;
}

float GroundPyramid::Between(float level, float north_m, float east_m) const {
  const auto last = static_cast<float>(levels_.size() - 1);
  const float at = std::clamp(level, 0.0F, last);
  const auto finer = static_cast<std::size_t>(at);
  const float share = at - static_cast<float>(finer);
  const float grey = AtLevel(finer, north_m, east_m);
  return share == 0 ? grey : grey + share * (AtLevel(finer + 1, north_m, east_m) - grey);
}

float GroundPyramid::Grey(float north_m, float east_m, float texel_m) const {
  return Between(std::log2(texel_m / levels_.front().texel_m), north_m, east_m);
}

ImageF GroundPyramid::Picture(const PinholeCamera& camera, const RigidTransform& X_WC) const {
  ImageF picture(camera.width, camera.height);
  const Eigen::Vector3f p = X_WC.p.cast<float>();
  const Eigen::Vector3f across = X_WC.R.col(0).cast<float>() / static_cast<float>(camera.fx_px);
  const Eigen::Vector3f down = X_WC.R.col(1).cast<float>() / static_cast<float>(camera.fy_px);
  const float texels_per_m = kTexel_px / (static_cast<float>(camera.fx_px) * levels_[0].texel_m);
  for (int y = 0; y < camera.height; ++y) {
    const Eigen::Vector3f first =
        (X_WC.R * RayFromPixel(camera, Eigen::Vector2d(0, y))).cast<float>();
    float* out = picture.row(y);
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3f ray = first + static_cast<float>(x) * across;
      if (ray.z() <= kLowestRay) {
        out[x] = kSky;
        continue;
      }
      const float level = std::log2(-p.z() / ray.z() * texels_per_m);
      float sum = 0;
      for (const float offset_px : kRayOffsets_px) {
        const Eigen::Vector3f r = ray + offset_px * down;
        const float depth_m = -p.z() / std::max(r.z(), 0.5F * kLowestRay);
        sum += Between(level, p.x() + depth_m * r.x(), p.y() + depth_m * r.y());
      }
      out[x] = sum / static_cast<float>(std::size(kRayOffsets_px));
    }
  }
  SpreadByLens(picture);
  return picture;
}

}  // namespace palace
