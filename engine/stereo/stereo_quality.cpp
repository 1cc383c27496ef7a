#include "engine/stereo/stereo_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/stereo/disparity.h"

namespace palace {
namespace {

constexpr int kPatchHalf_px = 4;
constexpr int kRowReach_px = 2;
constexpr int kPointsAcross = 24;
constexpr int kPointsDown = 18;
constexpr std::size_t kLeastPoints = 20;
constexpr double kLeastRowContrast = 8;  // mean squared vertical difference, grey levels squared
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double Median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Mean squared vertical difference of the left patch.
double RowContrast(const ImageU8& left, int x, int y) {
  double sum = 0;
  for (int v = y - kPatchHalf_px; v < y + kPatchHalf_px; ++v) {
    for (int u = x - kPatchHalf_px; u <= x + kPatchHalf_px; ++u) {
      const double difference = left.at(u, v + 1) - left.at(u, v);
      sum += difference * difference;
    }
  }
  return sum / (2 * kPatchHalf_px * (2 * kPatchHalf_px + 1));
}

/// Squared difference of the patches `shift` rows apart, both without their mean.
double PatchDifference(const ImageU8& left, const ImageU8& right, int x, int y, double disparity,
                       int shift) {
  const double place = x - disparity;
  const int whole = static_cast<int>(std::floor(place));
  const double t = place - whole;
  double sum = 0;
  double square = 0;
  int count = 0;
  for (int v = -kPatchHalf_px; v <= kPatchHalf_px; ++v) {
    for (int u = -kPatchHalf_px; u <= kPatchHalf_px; ++u) {
      const double other =
          (1 - t) * right.at(whole + u, y + v + shift) + t * right.at(whole + u + 1, y + v + shift);
      const double difference = left.at(x + u, y + v) - other;
      sum += difference;
      square += difference * difference;
      ++count;
    }
  }
  return square - sum * sum / count;
}

/// Row shift of the best fit, or NaN when it lies at the end of the reach.
double BestRowShift(const ImageU8& left, const ImageU8& right, int x, int y, double disparity) {
  std::array<double, 2 * kRowReach_px + 1> cost{};
  for (int shift = -kRowReach_px; shift <= kRowReach_px; ++shift) {
    cost[static_cast<std::size_t>(shift + kRowReach_px)] =
        PatchDifference(left, right, x, y, disparity, shift);
  }
  const auto best = std::min_element(cost.begin(), cost.end());
  if (best == cost.begin() || best == cost.end() - 1) {
    return kNaN;
  }
  const double curvature = *(best - 1) - 2 * *best + *(best + 1);
  if (!(curvature > 0)) {
    return kNaN;
  }
  return static_cast<double>(best - cost.begin()) - kRowReach_px +
         (*(best - 1) - *(best + 1)) / (2 * curvature);
}

ImageU8 Band(const ImageU8& image, int first, int rows) {
  const auto begin = image.pixels().begin() + static_cast<std::ptrdiff_t>(first) * image.width();
  return ImageU8(
      image.width(), rows,
      std::vector<std::uint8_t>(begin, begin + static_cast<std::ptrdiff_t>(rows) * image.width()));
}

double KnownShare(const ImageF& values) {
  std::size_t known = 0;
  for (const float value : values.pixels()) {
    known += std::isnan(value) ? 0U : 1U;
  }
  return values.empty() ? 0.0
                        : static_cast<double>(known) / static_cast<double>(values.pixels().size());
}

}  // namespace

double MedianRowError(const ImageU8& left, const ImageU8& right, const ImageF& disparity_px) {
  const int margin = kPatchHalf_px + kRowReach_px + 1;
  std::vector<double> shifts;
  for (int j = 0; j < kPointsDown; ++j) {
    const int y = margin + j * (left.height() - 2 * margin) / kPointsDown;
    for (int i = 0; i < kPointsAcross; ++i) {
      const int x = margin + i * (left.width() - 2 * margin) / kPointsAcross;
      if (!left.Contains(x + margin, y + margin)) {
        continue;
      }
      const double disparity = disparity_px.at(x, y);
      if (std::isnan(disparity) || x - disparity < margin ||
          x - disparity > left.width() - 1 - margin ||
          RowContrast(left, x, y) < kLeastRowContrast) {
        continue;
      }
      const double shift = BestRowShift(left, right, x, y, disparity);
      if (!std::isnan(shift)) {
        shifts.push_back(std::abs(shift));
      }
    }
  }
  return shifts.size() < kLeastPoints ? kNaN : Median(shifts);
}

double ExposureRatio(const ImageU8& left, const ImageU8& right) {
  std::int64_t left_sum = 0;
  std::int64_t right_sum = 0;
  for (const std::uint8_t value : left.pixels()) {
    left_sum += value;
  }
  for (const std::uint8_t value : right.pixels()) {
    right_sum += value;
  }
  return left_sum == 0 ? kNaN : static_cast<double>(right_sum) / static_cast<double>(left_sum);
}

bool LooksSwapped(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                  const StereoSettings& settings) {
  const int rows = std::min(left.height(), 120);
  const int first = (left.height() - rows) / 2;
  const ImageU8 left_band = Band(left, first, rows);
  const ImageU8 right_band = Band(right, first, rows);
  const double as_given = KnownShare(MatchWholePixels(left_band, right_band, window, settings));
  const double exchanged = KnownShare(MatchWholePixels(right_band, left_band, window, settings));
  return exchanged > 0.3 && exchanged > 2 * as_given;
}

void SummariseRange(const RangeMap& range, StereoQuality& quality) {
  std::vector<double> depths;
  std::vector<double> sigmas;
  // Every third pixel is plenty for a median.
  for (std::size_t i = 0; i < range.depth_m.pixels().size(); i += 3) {
    const float depth = range.depth_m.pixels()[i];
    if (!std::isnan(depth)) {
      depths.push_back(depth);
      sigmas.push_back(range.disparity_sigma_px.pixels()[i]);
    }
  }
  quality.coverage = KnownShare(range.depth_m);
  quality.median_depth_m = depths.empty() ? kNaN : Median(depths);
  quality.median_sigma_px = sigmas.empty() ? kNaN : Median(sigmas);
}

}  // namespace palace
