#include "engine/slad/hazards/safe_distance.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

double Aside(int d, DistanceTo to) {
  return to == DistanceTo::kCentre ? std::abs(d) : std::max(0.0, std::abs(d) - 0.5);
}

double BruteForce(const Grid<std::uint8_t>& hazard, int r, int c, DistanceTo to) {
  double best = HUGE_VAL;
  for (int y = -1; y <= hazard.rows(); ++y) {
    for (int x = -1; x <= hazard.cols(); ++x) {
      const bool outside = y < 0 || x < 0 || y == hazard.rows() || x == hazard.cols();
      if (outside || hazard.at(y, x) != 0) {
        best = std::min(best, std::hypot(Aside(y - r, to), Aside(x - c, to)));
      }
    }
  }
  return best;
}

TEST(SafeDistance, EqualsBruteForceOnRandomMaps) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    // A few are wide and nearly empty: the other way through a row is taken there.
    const bool wide = seed % 20 == 0;
    RandomStream random(seed, "edt");
    const int rows = wide ? 135 : 1 + random.Index(30), cols = wide ? 140 : 1 + random.Index(30);
    const double hazard_share = wide ? 2e-4 : random.Uniform(0, 0.2);
    Grid<std::uint8_t> hazard(rows, cols, 0);
    for (auto& h : hazard.cells()) {
      h = random.Uniform() < hazard_share ? 1 : 0;
    }
    for (const DistanceTo to : {DistanceTo::kCentre, DistanceTo::kSquare}) {
      const GridF distance = SafeDistance(hazard, 0.5, to);
      for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < cols; ++c) {
          ASSERT_NEAR(double(distance.at(r, c)), 0.5 * BruteForce(hazard, r, c, to), 1e-5)
              << "seed " << seed << " cell " << r << ' ' << c;
        }
      }
    }
  }
}

TEST(SafeDistance, EmptyMapStaysEmpty) { EXPECT_TRUE(SafeDistance({}, 1.0).empty()); }

}  // namespace
}  // namespace palace
