#include "engine/slad/terrain/ground_roughness.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/core/median.h"

namespace palace {
namespace {

constexpr double kBlock_m = 1.5;
constexpr int kLeastBlock = 10;
constexpr std::size_t kKnownOneIn = 4;  // cells of a block

int BlockCells(double cell_m) {
  const double cells = std::ceil(kBlock_m / cell_m - 1e-9);
  return std::max(kLeastBlock, cells < 1e6 ? static_cast<int>(cells) : 1000000);
}

int Blocks(int cells, int block) { return (cells + block - 1) / block; }

/// Magnitudes of the known values of a square; what lies outside the grid is left out.
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

GroundRoughness::GroundRoughness(const GridF& prominence_m, double cell_m)
    : block_(BlockCells(cell_m)),
      scales_m_(Blocks(prominence_m.rows(), block_), Blocks(prominence_m.cols(), block_), 0) {
  GridF own(scales_m_.rows(), scales_m_.cols(), kUnknownValue);
  std::vector<float> known;
  for (int r = 0; r < own.rows(); ++r) {
    for (int c = 0; c < own.cols(); ++c) {
      Collect(prominence_m, r * block_, c * block_, block_, known);
      const int rows = std::min(block_, prominence_m.rows() - r * block_);
      const int cols = std::min(block_, prominence_m.cols() - c * block_);
      if (kKnownOneIn * known.size() >=
          static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols)) {
        own.at(r, c) = UpperMedian(known);
      }
    }
  }
  for (int r = 0; r < own.rows(); ++r) {
    for (int c = 0; c < own.cols(); ++c) {
      Collect(own, r - 1, c - 1, 3, known);
      scales_m_.at(r, c) = known.empty() ? 0.0F : UpperMedian(known);
    }
  }
}

double GroundRoughness::At(int row, int col) const {
  return kSigmaPerMad * static_cast<double>(scales_m_.at(row / block_, col / block_));
}

}  // namespace palace
