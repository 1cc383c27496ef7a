#include "engine/stereo/semi_global.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/core/check.h"

namespace palace {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Planes = std::array<Bytes, kCensusPlanes>;

constexpr int kRowsPerBand = 120;  // fixed: results do not depend on the threads
constexpr int kWarmUpRows = 24;    // of the path from above, before a band
constexpr int kLargestJump = 61;   // 3 paths of at most 24 + 61 fit in a byte
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
static_assert(kRowsPerBand % kRowsTogether == 0);

/// Rows with three pixels repeated on both sides.
class PaddedRows {
 public:
  PaddedRows(const ImageU8& image, int first_column, int columns)
      : image_(image),
        first_column_(first_column),
        columns_(columns),
        rows_(kSide, Bytes(static_cast<std::size_t>(columns + 2 * kCensusHalf_px))) {}

  /// The seven rows around y; rows beyond the picture repeat its first or last.
  std::array<const std::uint8_t*, 2 * kCensusHalf_px + 1> Around(int y) {
    std::array<const std::uint8_t*, 2 * kCensusHalf_px + 1> around{};
    for (int v = 0; v < kSide; ++v) {
      Bytes& row = rows_[static_cast<std::size_t>(v)];
      const std::uint8_t* from =
          image_.row(std::clamp(y + v - kCensusHalf_px, 0, image_.height() - 1)) + first_column_;
      std::fill_n(row.begin(), kCensusHalf_px, from[0]);
      std::copy_n(from, columns_, row.begin() + kCensusHalf_px);
      std::fill_n(row.end() - kCensusHalf_px, kCensusHalf_px, from[columns_ - 1]);
      around[static_cast<std::size_t>(v)] = row.data();
    }
    return around;
  }

 private:
  static constexpr int kSide = 2 * kCensusHalf_px + 1;
  const ImageU8& image_;
  int first_column_;
  int columns_;
  std::vector<Bytes> rows_;
};

/// Matches one band of rows: buffers and the state of the path from above.
class Band {
 public:
  Band(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
       const SemiGlobalOptions& options, const StereoLoops& loops)
      : window_(window),
        options_(options),
        loops_(loops),
        columns_(left.width() - window.min_px),
        blocks_((window.count + kDisparityBlock - 1) / kDisparityBlock),
        wide_(blocks_ * kDisparityBlock),
        left_rows_(left, window.min_px, columns_),
        right_rows_(right, 0, columns_) {
    const auto columns = static_cast<std::size_t>(columns_);
    const auto wide = static_cast<std::size_t>(wide_);
    for (Planes* planes : {&left_planes_, &right_planes_, &reversed_}) {
      for (Bytes& plane : *planes) {
        plane.resize(columns + wide);
      }
    }
    for (int k = 0; k < kRowsTogether; ++k) {
      cost_.emplace_back(columns * wide);
      sum_.emplace_back(columns * wide);
    }
    for (int k = 0; k < 2; ++k) {
      paths_[k].assign(kPathGuard + columns * (wide + kPathGuard), kPathGuardCost);
      least_[k].assign(columns, 0);
    }
    for (Bytes* bytes : {&best_, &unique_, &best_cost_, &below_, &beyond_}) {
      bytes->resize(columns);
    }
    reverse_.resize(columns + wide);
    reverse_cost_.resize(columns + wide);
  }

  void Match(int first, int end, ImageF& disparity) {
    // Above the first row every path is free: costs and their least are 0 there.
    Bytes& start = paths_[0];
    for (int x = 0; x < columns_; ++x) {
      std::fill_n(
          start.begin() + kPathGuard + static_cast<std::ptrdiff_t>(x) * (wide_ + kPathGuard), wide_,
          std::uint8_t{0});
    }
    for (int y = std::max(0, first - kWarmUpRows); y < first; ++y) {
      Descend(y, 0);
    }
    for (int y = first; y < end; y += kRowsTogether) {
      const int rows = std::min(kRowsTogether, end - y);
      const std::uint8_t* cost[kRowsTogether];
      std::uint8_t* sum[kRowsTogether];
      for (int k = 0; k < kRowsTogether; ++k) {
        if (k < rows) {
          Descend(y + k, k);
        }
        cost[k] = cost_[static_cast<std::size_t>(k)].data();
        sum[k] = sum_[static_cast<std::size_t>(k)].data();
      }
      loops_.along(cost, columns_, blocks_, options_.small_jump_cost, options_.large_jump_cost,
                   sum);
      for (int k = 0; k < rows; ++k) {
        Choose(sum[k], disparity.row(y + k));
      }
    }
  }

 private:
  /// Costs of row y and their path from above, into buffer k.
  void Descend(int y, int k) {
    std::array<std::uint8_t*, kCensusPlanes> to{};
    std::array<const std::uint8_t*, kCensusPlanes> left{};
    std::array<const std::uint8_t*, kCensusPlanes> right{};
    for (std::size_t p = 0; p < kCensusPlanes; ++p) {
      to[p] = left_planes_[p].data();
      left[p] = left_planes_[p].data();
      right[p] = reversed_[p].data();
    }
    loops_.census(left_rows_.Around(y).data(), columns_, to.data());
    for (std::size_t p = 0; p < kCensusPlanes; ++p) {
      to[p] = right_planes_[p].data();
    }
    loops_.census(right_rows_.Around(y).data(), columns_, to.data());
    for (std::size_t p = 0; p < kCensusPlanes; ++p) {
      const auto end = right_planes_[p].begin() + columns_;
      std::reverse_copy(right_planes_[p].begin(), end, reversed_[p].begin());
      std::fill(reversed_[p].begin() + columns_, reversed_[p].end(), right_planes_[p].front());
    }
    std::uint8_t* cost = cost_[static_cast<std::size_t>(k)].data();
    loops_.match(left.data(), right.data(), columns_, blocks_, cost);
    loops_.down(cost, columns_, blocks_, options_.small_jump_cost, options_.large_jump_cost,
                paths_[above_].data() + kPathGuard, least_[above_].data(),
                paths_[1 - above_].data() + kPathGuard, least_[1 - above_].data(),
                sum_[static_cast<std::size_t>(k)].data());
    above_ = 1 - above_;
  }

  void Choose(const std::uint8_t* sum, float* disparity) {
    const RowChoice choice{best_.data(), unique_.data(), best_cost_.data(), below_.data(),
                           beyond_.data()};
    loops_.choose(sum, columns_, blocks_, options_.uniqueness_percent, choice);
    std::fill(reverse_cost_.begin(), reverse_cost_.end(), std::uint8_t{255});
    for (int x = 0; x < columns_; ++x) {
      const int match = x - choice.best[x];
      if (match >= 0 && choice.cost[x] < reverse_cost_[static_cast<std::size_t>(match)]) {
        reverse_cost_[static_cast<std::size_t>(match)] = choice.cost[x];
        reverse_[static_cast<std::size_t>(match)] = choice.best[x];
      }
    }
    const int reach = static_cast<int>(std::lround(options_.max_left_right_px));
    std::fill_n(disparity, window_.min_px, kUnknown);
    for (int x = 0; x < columns_; ++x) {
      const int d = choice.best[x];
      const int match = x - d;
      const int back = match >= 0 ? reverse_[static_cast<std::size_t>(match)] : 0;
      const bool known =
          match >= 0 && d < window_.count && choice.unique[x] != 0 && std::abs(back - d) <= reach;
      const float steep =
          static_cast<float>(std::max(choice.below[x], choice.above[x]) - choice.cost[x]);
      const float shift =
          steep > 0 ? static_cast<float>(choice.below[x] - choice.above[x]) / (2 * steep) : 0.0F;
      disparity[window_.min_px + x] =
          known ? static_cast<float>(window_.min_px + d) + shift : kUnknown;
    }
  }

  DisparityWindow window_;
  SemiGlobalOptions options_;
  const StereoLoops& loops_;
  int columns_;
  int blocks_;
  int wide_;
  PaddedRows left_rows_;
  PaddedRows right_rows_;
  Planes left_planes_;
  Planes right_planes_;
  Planes reversed_;
  std::vector<Bytes> cost_;
  std::vector<Bytes> sum_;
  Bytes paths_[2];
  Bytes least_[2];
  int above_ = 0;  // which of the two belongs to the row above
  Bytes best_, unique_, best_cost_, below_, beyond_;
  Bytes reverse_, reverse_cost_;
};

}  // namespace

ImageF MatchSemiGlobal(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                       const SemiGlobalOptions& options, const StereoLoops& loops) {
  const int width = left.width();
  const int height = left.height();
  PALACE_CHECK(width == right.width() && height == right.height(), width, right.width(), height,
               right.height());
  PALACE_CHECK(window.min_px >= 0 && window.min_px + 16 <= width, window.min_px, width);
  PALACE_CHECK(window.count >= 1 && window.count <= 256, window.count);
  PALACE_CHECK(options.small_jump_cost >= 0 && options.small_jump_cost <= options.large_jump_cost &&
                   options.large_jump_cost <= kLargestJump,
               options.small_jump_cost, options.large_jump_cost);
  PALACE_CHECK(options.uniqueness_percent >= 0 && options.uniqueness_percent < 100,
               options.uniqueness_percent);
  ImageF disparity(width, height);
  const int bands = (height + kRowsPerBand - 1) / kRowsPerBand;
  cv::parallel_for_(cv::Range(0, bands), [&](const cv::Range& range) {
    for (int band = range.start; band < range.end; ++band) {
      Band(left, right, window, options, loops)
          .Match(band * kRowsPerBand, std::min(height, (band + 1) * kRowsPerBand), disparity);
    }
  });
  return disparity;
}

}  // namespace palace
