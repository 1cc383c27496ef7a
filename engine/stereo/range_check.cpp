#include "engine/stereo/range_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/camera/pinhole.h"
#include "engine/core/median.h"

namespace palace {
namespace {

constexpr int kHalfWindow_px = 4;  // the spot of a 1 cm beam, and the pixel's own uncertainty

/// Median stereo depth around the pixel; nothing when half of the window is unknown.
std::optional<double> DepthAround(const RangeMap& range, const Eigen::Vector2d& pixel) {
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  std::vector<double> depths;
  for (int row = y - kHalfWindow_px; row <= y + kHalfWindow_px; ++row) {
    for (int col = x - kHalfWindow_px; col <= x + kHalfWindow_px; ++col) {
      if (row >= 0 && col >= 0 && row < range.depth_m.height() && col < range.depth_m.width() &&
          std::isfinite(range.depth_m.at(col, row))) {
        depths.push_back(static_cast<double>(range.depth_m.at(col, row)));
      }
    }
  }
  constexpr int kSide = 2 * kHalfWindow_px + 1;
  if (2 * depths.size() < static_cast<std::size_t>(kSide * kSide)) {
    return std::nullopt;
  }
  return UpperMedian(depths);
}

}  // namespace

std::optional<double> DepthAtSpot(const RangeMap& range, const Eigen::Vector3d& p_CL) {
  const auto pixel = ProjectPinhole(range.camera, p_CL);
  return pixel && InPicture(range.camera, *pixel) ? DepthAround(range, *pixel) : std::nullopt;
}

void RangeCheck::Add(const RangeMap& range, const Eigen::Vector3d& p_CL) {
  const std::optional<double> depth_m = DepthAtSpot(range, p_CL);
  if (!depth_m) {
    return;
  }
  ratios_.push_back(*depth_m / p_CL.z());
  if (ratios_.size() > kMostPairs) {
    ratios_.pop_front();
  }
}

RangeAgreement RangeCheck::agreement() const {
  RangeAgreement agreement;
  agreement.pairs = static_cast<int>(ratios_.size());
  if (agreement.pairs < kLeastPairs) {
    return agreement;
  }
  std::vector<double> ratios(ratios_.begin(), ratios_.end());
  agreement.ratio = UpperMedian(ratios);
  std::vector<double> deviations;
  for (const double ratio : ratios_) {
    deviations.push_back(std::abs(ratio - agreement.ratio));
  }
  constexpr double kMedianLoss = 1.2533;  // sigma of a median over sigma of a mean, Gaussian
  agreement.sigma = kMedianLoss * kSigmaPerMad * UpperMedian(deviations) /
                    std::sqrt(static_cast<double>(agreement.pairs));
  return agreement;
}

}  // namespace palace
