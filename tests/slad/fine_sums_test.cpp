// Summed-area tables and their planes, against plain sums.
#include "engine/slad/terrain/fine_sums.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

constexpr GridGeometry kPlaces{30, 40, 0.075, 0, 0};

Grid<FineKnown> Drawn(std::uint64_t seed) {
  Grid<FineKnown> known(kPlaces.rows, kPlaces.cols);
  RandomStream random(seed, "known");
  for (FineKnown& k : known.cells()) {
    k.net = static_cast<float>(random.Uniform(-10, 100));
    k.gross = k.net + 20;
    k.height = k.net * static_cast<float>(random.Normal());
    k.off = k.net * static_cast<float>(random.Normal());
  }
  return known;
}

TEST(FineSums, EverySquareIsThePlainSumOfItsPlaces) {
  const Grid<FineKnown> known = Drawn(3);
  const FineSums sums(known, kPlaces, 7);
  EXPECT_EQ(sums.reference_m(), 7);
  for (const auto& [row, col, side, reach] :
       {std::array{10, 12, 2, 0}, {0, 0, 2, 3}, {29, 39, 1, 0}, {15, 20, 3, 5}, {5, 5, 2, 100}}) {
    FineSum plain;
    for (int r = std::max(0, row - side / 2 - reach);
         r < std::min(kPlaces.rows, row - side / 2 + side + reach); ++r) {
      for (int c = std::max(0, col - side / 2 - reach);
           c < std::min(kPlaces.cols, col - side / 2 + side + reach); ++c) {
        const auto a = static_cast<double>(known.at(r, c).net),
                   j = static_cast<double>(known.at(r, c).height),
                   g = static_cast<double>(known.at(r, c).gross),
                   off = static_cast<double>(known.at(r, c).off);
        const double x = c - kPlaces.cols / 2.0, y = r - kPlaces.rows / 2.0;
        plain +=
            FineSum{{a, a * x, a * y, a * x * x, a * x * y, a * y * y, j, j * x, j * y, g, off}};
      }
    }
    const FineSum fast = sums.Over(row, col, side, reach);
    for (std::size_t k = 0; k < plain.of.size(); ++k) {
      EXPECT_NEAR(fast.of[k], plain.of[k], 1e-6 * (1 + std::abs(plain.of[k]))) << row << ' ' << k;
    }
  }
}

TEST(FineSums, APlaneIsFoundWhereverItIsKnownBetterOrWorse) {
  Grid<FineKnown> known(kPlaces.rows, kPlaces.cols);
  RandomStream random(9, "weights");
  for (int r = 0; r < kPlaces.rows; ++r) {
    for (int c = 0; c < kPlaces.cols; ++c) {
      FineKnown& k = known.at(r, c);
      k.net = k.gross = static_cast<float>(random.Uniform(1, 100));
      k.height = k.net * static_cast<float>(0.3 + 0.01 * (c - 20.0) - 0.02 * (r - 15.0));
    }
  }
  const FineSum sum = FineSums(known, kPlaces, 0).Over(15, 20, 10);
  const FinePlane plane = PlaneThrough(sum);
  ASSERT_TRUE(plane.told);
  EXPECT_NEAR(plane.At(0, 0), 0.3, 1e-5);
  EXPECT_NEAR(plane.per_x_m, 0.01, 1e-6);
  EXPECT_NEAR(plane.per_y_m, -0.02, 1e-6);
  EXPECT_NEAR(plane.Aside(plane.x, plane.y), 0, 1e-12);
  EXPECT_NEAR(plane.Aside(plane.x + std::sqrt(plane.xx), plane.y), 1, 0.02);
  EXPECT_DOUBLE_EQ(plane.variance_m2, 1 / sum.of[FineSum::kA]) << "net is gross";
}

TEST(FineSums, WhatIsKnownToAMillimetreCountsAsKnownToACentimetre) {
  Grid<FineKnown> known(kPlaces.rows, kPlaces.cols);
  for (FineKnown& place : known.cells()) {
    place = {100, 100, 20, 10};  // 0.2 m high, to 10 cm
  }
  known.at(10, 12) = {1e6F, 1e6F, 5e5F, 2e5F};
  const FineSums sums(known, kPlaces, 0);
  const FineSum line = sums.Over(10, 12, 1);
  EXPECT_NEAR(line.height_m(), 0.5, 1e-6);
  EXPECT_NEAR(line.off_laid_m(), 0.2, 1e-6);
  EXPECT_NEAR(line.variance_m2(), 1e-4, 1e-9);
  // Of a window of 19 x 19 places it is a hundred, not ten thousand.
  EXPECT_NEAR(sums.Over(10, 12, 1, 9).of[FineSum::kA], 1e4 + 360 * 100, 1);
  EXPECT_NEAR(sums.Over(10, 30, 1).variance_m2(), 0.01, 1e-9);
}

TEST(FineSums, ALineOrNoiseAloneIsNoPlane) {
  Grid<FineKnown> line(kPlaces.rows, kPlaces.cols);
  for (int c = 0; c < kPlaces.cols; ++c) {
    line.at(15, c) = {50, 50, 5};
  }
  EXPECT_FALSE(PlaneThrough(FineSums(line, kPlaces, 0).Over(15, 20, 20)).told);
  Grid<FineKnown> noise(kPlaces.rows, kPlaces.cols, {-1, 20, 0});
  EXPECT_FALSE(PlaneThrough(FineSums(noise, kPlaces, 0).Over(15, 20, 20)).told);
  EXPECT_FALSE(FineSums(noise, kPlaces, 0).Over(15, 20, 20).known());
  EXPECT_FALSE(PlaneThrough(FineSums({}, {}, 0).Over(0, 0, 4)).told);
  // Beside ground known to a tenth of a millimetre, nothing: what is left is rounding.
  Grid<FineKnown> beside(kPlaces.rows, kPlaces.cols);
  for (int r = 0; r < kPlaces.rows; ++r) {
    for (int c = 0; c < 20; ++c) {
      beside.at(r, c) = {1.1e8F, 1.3e8F, 0.7e7F};
    }
  }
  const FineSums sums(beside, kPlaces, 0);
  for (int c = 24; c < 38; ++c) {
    EXPECT_FALSE(sums.Over(15, c, 2).known()) << c;
  }
}

}  // namespace
}  // namespace palace
