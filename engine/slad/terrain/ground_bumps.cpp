#include "engine/slad/terrain/ground_bumps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/core/median.h"

namespace palace {
namespace {

constexpr double kBlock_m = 1.5;
constexpr int kLeastBlock = 10;
constexpr std::size_t kKnownOneIn = 4;   // of those asked
constexpr std::size_t kQuantile = 4;     // one in so many lies below
constexpr float kOfNormal = 0.31864F;    // that quantile of |x|, x normal
constexpr double kQuantileSigma = 1.79;  // of the quantile, in it, of one normal number
constexpr double kByChance = 2;          // of these sigmas
constexpr int kHalvings = 6;             // of the interval that holds b: 1.5 % of the largest

int BlockCells(double cell_m) {
  const double cells = std::ceil(kBlock_m / cell_m - 1e-9);
  return std::max(kLeastBlock, cells < 1e6 ? static_cast<int>(cells) : 1000000);
}

int Blocks(int cells, int block) { return (cells + block - 1) / block; }

/// What places stand off by and their noise, squared.
struct Places {
  std::vector<float> off2, noise2;
};

/// Whether the lower quartile of off2 / (noise2 + bumps2) is larger than `limit`: no more than a
/// quarter of them are not. Counted in lanes, for whole lists are asked again and again.
bool QuartileExceeds(const Places& places, float bumps2, float limit) {
  constexpr std::size_t kLanes = 8;
  const std::size_t count = places.off2.size(), in_lanes = count / kLanes * kLanes;
  const auto is_below = [&](std::size_t i) {
    return places.off2[i] / (places.noise2[i] + bumps2) > limit ? 0 : 1;
  };
  std::array<int, kLanes> below{};
  for (std::size_t i = 0; i < in_lanes; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      below[lane] += is_below(i + lane);
    }
  }
  int all = std::accumulate(below.begin(), below.end(), 0);
  for (std::size_t i = in_lanes; i < count; ++i) {
    all += is_below(i);
  }
  return static_cast<std::size_t>(all) <= count / kQuantile;
}

/// b^2 of the places, as many of which stand for one by itself.
float BumpsOf(const Places& places, double related, std::vector<float>& work) {
  const auto by_chance =
      static_cast<float>(1 + kByChance * kQuantileSigma *
                                 std::sqrt(related / static_cast<double>(places.off2.size())));
  const auto exceeds = [&](float bumps2, float by) {
    return QuartileExceeds(places, bumps2, by * by * kOfNormal * kOfNormal);
  };
  if (!exceeds(0, by_chance)) {
    return 0;
  }
  work = places.off2;
  // Without any noise b could be no larger.
  float low = 0, high = std::sqrt(UpperQuantile(work, kQuantile)) / kOfNormal;
  for (int k = 0; k < kHalvings; ++k) {
    const float middle = (low + high) / 2;
    (exceeds(middle * middle, 1) ? low : high) = middle;
  }
  return low * low;
}

}  // namespace

GroundBumps::GroundBumps(const GridF& off_m, const GridF& sigma_m, double cell_m, int width)
    : block_(BlockCells(cell_m)),
      bumps_m_(Blocks(off_m.rows(), block_), Blocks(off_m.cols(), block_), 0) {
  const int every = std::max(1, width / 2);
  const double related = std::pow(static_cast<double>(width) / every, 2);
  cv::parallel_for_(cv::Range(0, bumps_m_.rows()), [&](const cv::Range& range) {
    Places places;
    std::vector<float> work;
    for (int i = range.start; i < range.end; ++i) {
      for (int j = 0; j < bumps_m_.cols(); ++j) {
        places.off2.clear();
        places.noise2.clear();
        std::size_t asked = 0;
        const int last_row = std::min((i + 2) * block_, off_m.rows()),
                  last_col = std::min((j + 2) * block_, off_m.cols());
        for (int r = std::max(0, (i - 1) * block_); r < last_row; r += every) {
          for (int c = std::max(0, (j - 1) * block_); c < last_col; c += every) {
            const float off = off_m.at(r, c), sigma = sigma_m.at(r, c);
            ++asked;
            if (!std::isnan(off) && sigma > 0) {
              places.off2.push_back(off * off);
              places.noise2.push_back(sigma * sigma);
            }
          }
        }
        if (!places.off2.empty() && kKnownOneIn * places.off2.size() >= asked) {
          bumps_m_.at(i, j) = std::sqrt(BumpsOf(places, related, work));
        }
      }
    }
  });
}

double GroundBumps::At(int row, int col) const {
  return static_cast<double>(bumps_m_.at(row / block_, col / block_));
}

}  // namespace palace
