#include "engine/slad/terrain/ground_bumps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

/// Normal, with the standard deviation that `sigma_m(row, col)` says.
template <typename Sigma>
GridF Normal(int rows, int cols, Sigma sigma_m) {
  GridF values(rows, cols, 0.0F);
  RandomStream random(5, "ground");
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      values.at(r, c) = static_cast<float>(sigma_m(r, c) * random.Normal());
    }
  }
  return values;
}

GridF Level(int rows, int cols, double value) {
  return GridF(rows, cols, static_cast<float>(value));
}

TEST(GroundBumps, AreWhatNoiseDoesNotExplain) {
  constexpr double kNoise_m = 0.01;
  for (const double bumps_m : {0.0, 0.01, 0.02, 0.1}) {
    const GridF off_m = Normal(95, 63, [&](int, int) { return std::hypot(kNoise_m, bumps_m); });
    const GroundBumps bumps(off_m, Level(95, 63, kNoise_m), 0.15, 1);
    for (int r = 0; r < 95; r += 7) {
      for (int c = 0; c < 63; c += 7) {
        // Of 225 numbers and more the quartile errs by 12 %: bumps not as high as the noise drown.
        EXPECT_NEAR(bumps.At(r, c), bumps_m, 0.35 * bumps_m + 0.8 * kNoise_m) << r << ' ' << c;
      }
    }
  }
}

// Against sorted lists: what is found solves the header's equation to a 64th of the largest.
TEST(GroundBumps, SolveTheEquationOfTheQuartile) {
  constexpr double kOfNormal = 0.31864;
  for (const int known : {25, 26, 27, 28, 63, 97, 100}) {
    const GridF noise_m(10, 10, 0.004F);
    GridF off_m = Normal(10, 10, [](int, int) { return 0.03; });
    for (int i = known; i < 100; ++i) {
      off_m.cells()[static_cast<std::size_t>(i)] = kUnknownValue;
    }
    const auto quartile = [&](double bumps_m) {
      std::vector<double> squares;
      for (int i = 0; i < known; ++i) {
        const auto off = static_cast<double>(off_m.cells()[static_cast<std::size_t>(i)]);
        squares.push_back(off * off / (0.004 * 0.004 + bumps_m * bumps_m));
      }
      std::sort(squares.begin(), squares.end());
      return std::sqrt(squares[squares.size() / 4]);
    };
    const double largest_m = quartile(0) * 0.004 / kOfNormal;
    const double found_m = GroundBumps(off_m, noise_m, 0.15, 1).At(5, 5);
    ASSERT_GT(found_m, 0) << known;
    EXPECT_GT(quartile(found_m), kOfNormal * (1 - 1e-5)) << known;
    EXPECT_LE(quartile(found_m + 1.01 * largest_m / 64), kOfNormal) << known;
  }
}

TEST(GroundBumps, NoiseThatVariesFromPlaceToPlaceIsNoBump) {
  const auto sigma_m = [](int r, int c) { return (r + c) % 3 == 0 ? 0.002 : 0.02; };
  const GridF off_m = Normal(100, 100, sigma_m);
  GridF said_m(100, 100, 0.0F);
  for (int r = 0; r < 100; ++r) {
    for (int c = 0; c < 100; ++c) {
      said_m.at(r, c) = static_cast<float>(sigma_m(r, c));
    }
  }
  EXPECT_LT(GroundBumps(off_m, said_m, 0.15, 1).At(50, 50), 0.002);
}

TEST(GroundBumps, ThingsOnAThirdOfTheGroundRaiseThemAFewTimes) {
  GridF off_m = Normal(60, 60, [](int, int) { return 0.01; });
  for (int r = 0; r < 60; ++r) {
    for (int c = 0; c < 60; c += 3) {
      off_m.at(r, c) = 0.8F;
    }
  }
  EXPECT_LT(GroundBumps(off_m, Level(60, 60, 1e-4), 0.15, 1).At(30, 30), 0.025);
}

TEST(GroundBumps, BelongToTheirPlace) {
  const GridF off_m = Normal(100, 100, [](int, int c) { return c < 50 ? 0.01 : 0.05; });
  const GroundBumps bumps(off_m, Level(100, 100, 1e-4), 0.15, 1);
  EXPECT_NEAR(bumps.At(50, 20), 0.01, 0.003);
  EXPECT_NEAR(bumps.At(50, 80), 0.05, 0.015);
}

TEST(GroundBumps, UnknownGroundIsLeftOutOrLevel) {
  GridF off_m = Normal(60, 60, [](int, int) { return 0.02; });
  for (int r = 0; r < 60; ++r) {
    for (int c = 0; c < 60; c += 4) {
      off_m.at(r, c) = kUnknownValue;
    }
  }
  EXPECT_NEAR(GroundBumps(off_m, Level(60, 60, 1e-4), 0.15, 1).At(25, 25), 0.02, 0.007);
  const GridF unknown(30, 30, kUnknownValue);
  EXPECT_EQ(GroundBumps(unknown, unknown, 0.15, 1).At(29, 29), 0);
  EXPECT_EQ(GroundBumps(GridF(1, 1, 0.0F), Level(1, 1, 1), 1e-9, 1).At(0, 0), 0);
}

}  // namespace
}  // namespace palace
