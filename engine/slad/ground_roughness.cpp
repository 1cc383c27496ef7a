#include "engine/slad/ground_roughness.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace palace {
namespace {

constexpr int kBlock = 10;
constexpr double kNormalScale = 1.4826;  // standard deviation over median magnitude

int Blocks(int cells) { return (cells + kBlock - 1) / kBlock; }

float Median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Magnitudes of the known values in rows [row, row + rows) and columns alike.
void Collect(const GridF& values, int row, int col, int size, std::vector<float>& known) {
  known.clear();
  for (int r = std::max(0, row); r < std::min(row + size, values.rows()); ++r) {
    for (int c = std::max(0, col); c < std::min(col + size, values.cols()); ++c) {
      if (const float value = values.at(r, c); !std::isnan(value)) {
        known.push_back(std::abs(value));
      }
    }
  }
}

}  // namespace

GroundRoughness::GroundRoughness(const GridF& stands_m)
    : scales_m_(Blocks(stands_m.rows()), Blocks(stands_m.cols()), 0) {
  GridF own(scales_m_.rows(), scales_m_.cols(), kUnknownValue);
  std::vector<float> known;
  for (int r = 0; r < own.rows(); ++r) {
    for (int c = 0; c < own.cols(); ++c) {
      Collect(stands_m, r * kBlock, c * kBlock, kBlock, known);
      if (known.size() >= kBlock * kBlock / 4) {
        own.at(r, c) = Median(known);
      }
    }
  }
  for (int r = 0; r < own.rows(); ++r) {
    for (int c = 0; c < own.cols(); ++c) {
      Collect(own, r - 1, c - 1, 3, known);
      scales_m_.at(r, c) = known.empty() ? 0.0F : Median(known);
    }
  }
}

double GroundRoughness::At(int row, int col) const {
  return kNormalScale * static_cast<double>(scales_m_.at(row / kBlock, col / kBlock));
}

}  // namespace palace
