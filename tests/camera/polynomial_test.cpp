// The polynomials of lenses: where one stays positive, and radial ones inverted up to their fold.
#include "engine/camera/polynomial.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

TEST(Polynomial, PositiveOnFindsNarrowDips) {
  EXPECT_TRUE(PositiveOn(std::array<double, 3>{1.0001, -2, 1}, 2));   // (s-1)^2 + 1e-4
  EXPECT_FALSE(PositiveOn(std::array<double, 3>{0.9999, -2, 1}, 2));  // (s-1)^2 - 1e-4
  EXPECT_TRUE(PositiveOn(std::array<double, 3>{0.9999, -2, 1}, 0.98));
  EXPECT_TRUE(PositiveOn(std::array<double, 3>{1, -0.3, 0.1}, 1e14)) << "a dip far from the end";
  EXPECT_FALSE(PositiveOn(std::array<double, 2>{1, NAN}, 1));
  EXPECT_FALSE(PositiveOn(std::array<double, 2>{1, 1}, std::nan("")));
  constexpr std::uint64_t kSeed = 35;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (int i = 0; i < 500; ++i) {
    std::array<double, 7> c{};
    for (double& value : c) {
      value = random.Uniform(-1, 1);
    }
    c[0] = 1;
    double least = 1e9;
    for (int k = 0; k <= 2000; ++k) {
      const double s = 2.0 * k / 2000;
      double value = 0;
      for (std::size_t n = 7; n-- > 0;) {
        value = value * s + c[n];
      }
      least = std::min(least, value);
    }
    if (std::abs(least) > 1e-3) {  // nearer than the sampling can tell
      EXPECT_EQ(PositiveOn(c, 2.0), least > 0) << least;
    }
  }
}

TEST(Polynomial, InvertRadialStopsAtTheFold) {
  const std::array<double, 2> barrel = {1, -1.0 / 3};  // r - r^3/3 folds at r = 1, value 2/3
  for (const double r : {0.0, 1e-12, 0.3, 0.9, 0.9999}) {
    const auto root = InvertRadial(barrel, RadialValue(barrel, r));
    ASSERT_TRUE(root) << r;
    EXPECT_NEAR(*root, r, 1e-11);
  }
  EXPECT_FALSE(InvertRadial(barrel, 0.667));
  EXPECT_FALSE(InvertRadial(barrel, 1e300));
  EXPECT_FALSE(InvertRadial(barrel, NAN));
  EXPECT_FALSE(InvertRadial(std::array<double, 2>{-1, 1}, 0.5)) << "falls at the axis";
}

}  // namespace
}  // namespace palace
