#include "engine/stereo/stereo_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/median.h"
#include "engine/stereo/disparity.h"

namespace palace {
namespace {

constexpr int kPatchHalf_px = 4;
constexpr int kRowReach_px = 2;
constexpr int kPointsAcross = 24;
constexpr int kPointsDown = 18;
constexpr std::size_t kLeastPoints = 20;
constexpr double kLeastRowContrast = 8;  // mean squared vertical difference, grey levels squared
constexpr double kCoveredDeviation = 3;  // grey levels: camera noise and nothing else
constexpr double kSeeingDeviation = 8;
constexpr double kClippedShare = 0.5;
constexpr std::uint8_t kBlack = 1, kWhite = 254;
constexpr std::size_t kMedianSamples = 20000;  // known well enough from so many
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

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

/// Mean and standard deviation of every second pixel of every second row, and the share of them
/// that is black or white to the end of the scale.
struct Grey {
  double mean = 0;
  double deviation = 0;
  double clipped = 0;
  bool ShowsNothing() const { return deviation < kCoveredDeviation || clipped > kClippedShare; }
};

Grey GreyOf(const ImageU8& image) {
  std::int64_t count = 0, sum = 0, square = 0, clipped = 0;
  for (int y = 0; y < image.height(); y += 2) {
    const std::uint8_t* row = image.row(y);
    for (int x = 0; x < image.width(); x += 2) {
      ++count;
      sum += row[x];
      square += row[x] * row[x];
      clipped += row[x] <= kBlack || row[x] >= kWhite ? 1 : 0;
    }
  }
  if (count == 0) {
    return {};
  }
  const double n = static_cast<double>(count);
  const double mean = static_cast<double>(sum) / n;
  return {mean, std::sqrt(std::max(0.0, static_cast<double>(square) / n - mean * mean)),
          static_cast<double>(clipped) / n};
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

void MeasureRowError(const ImageU8& left, const ImageU8& right, const ImageF& disparity_px,
                     StereoQuality& quality) {
  quality.row_error_px = quality.row_shift_px = quality.row_spread_px = kNaN;
  const int margin = kPatchHalf_px + kRowReach_px + 1;
  std::vector<double> shifts;
  for (int j = 0; j < kPointsDown; ++j) {
    const int y = margin + j * (left.height() - 2 * margin) / kPointsDown;
    for (int i = 0; i < kPointsAcross; ++i) {
      const int x = margin + i * (left.width() - 2 * margin) / kPointsAcross;
      if (!left.Contains(x - margin, y - margin) || !left.Contains(x + margin, y + margin)) {
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
        shifts.push_back(shift);
      }
    }
  }
  if (shifts.size() < kLeastPoints) {
    return;
  }
  std::vector<double> sizes;
  for (const double shift : shifts) {
    sizes.push_back(std::abs(shift));
  }
  quality.row_error_px = UpperMedian(sizes);
  quality.row_shift_px = UpperMedian(shifts);
  for (double& shift : shifts) {
    shift = std::abs(shift - quality.row_shift_px);
  }
  quality.row_spread_px = kSigmaPerMad * UpperMedian(shifts);
}

void SuspectPictures(const ImageU8& left, const ImageU8& right, StereoQuality& quality) {
  const Grey a = GreyOf(left);
  const Grey b = GreyOf(right);
  quality.exposure_ratio = a.mean > 0 ? b.mean / a.mean : kNaN;
  quality.suspect_covered = std::min(a.deviation, b.deviation) < kCoveredDeviation &&
                            std::max(a.deviation, b.deviation) >= kSeeingDeviation;
  quality.left_blank = a.ShowsNothing();
  quality.right_blank = b.ShowsNothing();
  quality.suspect_same = !left.empty() && a.deviation > 0 && left.pixels() == right.pixels();
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
  const std::vector<float>& depth = range.depth_m.pixels();
  std::vector<double> depths;
  std::vector<double> sigmas;
  // Odd, so that it walks through all columns of an even width.
  const std::size_t stride = depth.size() / kMedianSamples | 1;
  for (std::size_t i = 0; i < depth.size(); i += stride) {
    if (!std::isnan(depth[i])) {
      depths.push_back(depth[i]);
      sigmas.push_back(range.disparity_sigma_px.pixels()[i]);
    }
  }
  quality.coverage = KnownShare(range.depth_m);
  quality.median_depth_m = depths.empty() ? kNaN : UpperMedian(depths);
  quality.median_sigma_px = sigmas.empty() ? kNaN : UpperMedian(sigmas);
}

}  // namespace palace
