#include "engine/slad/safe_distance.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

double BruteForce(const Grid<std::uint8_t>& safe, int r, int c) {
  double best = HUGE_VAL;
  for (int y = -1; y <= safe.rows(); ++y) {
    for (int x = -1; x <= safe.cols(); ++x) {
      const bool outside = y < 0 || x < 0 || y == safe.rows() || x == safe.cols();
      if (outside || safe.at(y, x) == 0) {
        best = std::min(best, std::hypot(y - r, x - c));
      }
    }
  }
  return best;
}

TEST(SafeDistance, EqualsBruteForceOnRandomMaps) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "edt");
    const int rows = 1 + random.Index(30), cols = 1 + random.Index(30);
    const double hazard_share = random.Uniform(0, 0.2);
    Grid<std::uint8_t> safe(rows, cols, 1);
    for (auto& s : safe.cells()) {
      s = random.Uniform() < hazard_share ? 0 : 1;
    }
    const GridF distance = SafeDistance(safe, 0.5);
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < cols; ++c) {
        ASSERT_NEAR(double(distance.at(r, c)), 0.5 * BruteForce(safe, r, c), 1e-5)
            << "seed " << seed << " cell " << r << ' ' << c;
      }
    }
  }
}

TEST(SafeDistance, EmptyMapStaysEmpty) { EXPECT_TRUE(SafeDistance({}, 1.0).empty()); }

}  // namespace
}  // namespace palace
