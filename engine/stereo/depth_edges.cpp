#include "engine/stereo/depth_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace palace {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr int kReach_px = 4;  // how far a surface is carried over its edge
constexpr float kLeastStep_px = 1.5F;
constexpr int kHalf_px = 2;  // of the window compared
constexpr int kTaps = (2 * kHalf_px + 1) * (2 * kHalf_px + 1);
constexpr float kGreyScale = 12;  // greys further from the centre are another surface
constexpr int kGreyUnit = 16;  // greys and weights are whole numbers: their sums run side by side
constexpr int kWeightUnit = 255;
constexpr int kLargestDifference = 20 * kGreyUnit;  // more says no more
constexpr float kClearlyBetter = 0.6F;
constexpr float kClearlyWorse = 1.15F;

using Weights = std::array<int, 256>;

Weights WeightsByGrey() {
  Weights weights{};
  for (std::size_t k = 0; k < weights.size(); ++k) {
    weights[k] =
        static_cast<int>(std::lround(kWeightUnit * std::exp(-static_cast<float>(k) / kGreyScale)));
  }
  return weights;
}

/// The left picture around a pixel, weighted by likeness to it.
struct Support {
  std::array<int, kTaps> weight;
  std::array<int, kTaps> grey;  // without the weighted mean
  int total = 0;
};

Support SupportAt(const ImageU8& left, const Weights& weights, int x, int y) {
  Support support;
  const int centre = left.at(x, y);
  int sum = 0;
  std::size_t k = 0;
  for (int v = -kHalf_px; v <= kHalf_px; ++v) {
    const std::uint8_t* row = left.row(y + v) + x;
    for (int u = -kHalf_px; u <= kHalf_px; ++u, ++k) {
      const int weight = weights[static_cast<std::size_t>(std::abs(row[u] - centre))];
      support.weight[k] = weight;
      support.grey[k] = kGreyUnit * row[u];
      support.total += weight;
      sum += weight * support.grey[k];
    }
  }
  for (int& grey : support.grey) {
    grey -= sum / support.total;
  }
  return support;
}

/// E of the head, not divided by the weights' sum; nothing where the window leaves the right
/// picture.
std::optional<int> Difference(const Support& support, const ImageU8& right, int x, int y,
                              float disparity) {
  const float place = static_cast<float>(x) - disparity;
  if (!(place >= kHalf_px) || place >= static_cast<float>(right.width() - kHalf_px - 1)) {
    return std::nullopt;
  }
  const int whole = static_cast<int>(place);
  const int part = static_cast<int>(kGreyUnit * (place - static_cast<float>(whole)));
  std::array<int, kTaps> grey;
  int sum = 0;
  std::size_t k = 0;
  for (int v = -kHalf_px; v <= kHalf_px; ++v) {
    const std::uint8_t* row = right.row(y + v) + whole;
    for (int u = -kHalf_px; u <= kHalf_px; ++u, ++k) {
      grey[k] = kGreyUnit * row[u] + part * (row[u + 1] - row[u]);
      sum += support.weight[k] * grey[k];
    }
  }
  const int mean = sum / support.total;
  int difference = 0;
  for (k = 0; k < kTaps; ++k) {
    difference += support.weight[k] *
                  std::min(std::abs(support.grey[k] - (grey[k] - mean)), kLargestDifference);
  }
  return difference;
}

/// Farthest and nearest surface beside a pixel, itself included.
struct Sides {
  float far_px;
  float near_px;
};

/// Neighbours that the ones opposite balance are the same, steep, surface.
Sides SidesOf(const float* here, std::ptrdiff_t stride) {
  const float own = *here;
  Sides sides{own, own};
  for (const std::ptrdiff_t direction : {std::ptrdiff_t{1}, stride, stride + 1, stride - 1}) {
    for (int k = 2; k <= kReach_px; k += 2) {
      const float a = here[k * direction];
      const float b = here[-k * direction];
      if (std::abs((a + b) / 2 - own) <= kLeastStep_px) {
        continue;  // not when either is unknown
      }
      for (const float side : {a, b}) {
        if (std::abs(side - own) > kLeastStep_px) {
          sides.far_px = std::min(sides.far_px, side);
          sides.near_px = std::max(sides.near_px, side);
        }
      }
    }
  }
  return sides;
}

float Decide(const ImageU8& left, const ImageU8& right, const ImageF& disparity,
             const Weights& weights, int x, int y) {
  const float here = disparity.at(x, y);
  const Sides sides = SidesOf(disparity.row(y) + x, disparity.width());
  if (sides.far_px == here && sides.near_px == here) {
    return here;
  }
  const Support support = SupportAt(left, weights, x, y);
  const auto own = Difference(support, right, x, y, here);
  if (!own) {
    return here;
  }
  int best = std::numeric_limits<int>::max();
  float choice = here;
  for (const float side : {sides.far_px, sides.near_px}) {
    const auto other = side == here ? std::nullopt : Difference(support, right, x, y, side);
    if (other && *other < best) {
      best = *other;
      choice = side;
    }
  }
  const auto limit = static_cast<float>(*own);
  if (static_cast<float>(best) < kClearlyBetter * limit) {
    return choice;
  }
  return static_cast<float>(best) < kClearlyWorse * limit ? kUnknown : here;
}

/// 255 where known disparities within kReach_px of a pixel differ by more than a step.
cv::Mat NearSteps(const ImageF& disparity) {
  constexpr std::int16_t kFar = 32000;  // unknown: neither least nor greatest
  constexpr float kScale = 7;           // 4500 px fit; steps beyond are not looked for
  constexpr float kMost = 31500;
  cv::Mat high(disparity.height(), disparity.width(), CV_16S);
  cv::Mat low(disparity.height(), disparity.width(), CV_16S);
  for (int y = 0; y < disparity.height(); ++y) {
    const float* from = disparity.row(y);
    auto* up = high.ptr<std::int16_t>(y);
    auto* down = low.ptr<std::int16_t>(y);
    for (int x = 0; x < disparity.width(); ++x) {
      const bool known = from[x] >= 0;  // false for NaN
      const auto scaled =
          static_cast<std::int16_t>(known ? std::min(kScale * from[x], kMost) : 0.0F);
      up[x] = known ? scaled : static_cast<std::int16_t>(-kFar);
      down[x] = known ? scaled : kFar;
    }
  }
  constexpr int side = 2 * kReach_px + 1;
  const cv::Mat element = cv::getStructuringElement(cv::MORPH_RECT, {side, side});
  cv::dilate(high, high, element);
  cv::erode(low, low, element);
  cv::Mat range;
  cv::subtract(high, low, range);  // saturates
  return range > kScale * kLeastStep_px;
}

}  // namespace

ImageF DecideBesideDepthEdges(const ImageU8& left, const ImageU8& right,
                              const ImageF& disparity_px) {
  const Weights weights = WeightsByGrey();
  const cv::Mat near_steps = NearSteps(disparity_px);
  ImageF decided = disparity_px;
  const int last = std::max(kReach_px, disparity_px.height() - kReach_px);
  cv::parallel_for_(cv::Range(kReach_px, last), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      const std::uint8_t* near_step = near_steps.ptr<std::uint8_t>(y);
      const float* disparity = disparity_px.row(y);
      float* out = decided.row(y);
      for (int x = kReach_px; x < disparity_px.width() - kReach_px; ++x) {
        if (near_step[x] != 0 && !std::isnan(disparity[x])) {
          out[x] = Decide(left, right, disparity_px, weights, x, y);
        }
      }
    }
  });
  return decided;
}

}  // namespace palace
