#include "engine/slad/terrain/ground_roughness.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

GridF Noise(int rows, int cols, double sigma_m) {
  GridF prominence_m(rows, cols, 0.0F);
  RandomStream random(5, "ground");
  for (float& value : prominence_m.cells()) {
    value = static_cast<float>(sigma_m * random.Normal());
  }
  return prominence_m;
}

TEST(GroundRoughness, IsTheStandardDeviationOfNoise) {
  for (const double sigma_m : {0.002, 0.03, 1.5}) {
    const GroundRoughness roughness(Noise(95, 63, sigma_m), 0.15);
    for (int r = 0; r < 95; r += 7) {
      for (int c = 0; c < 63; c += 7) {
        EXPECT_NEAR(roughness.At(r, c), sigma_m, 0.25 * sigma_m) << r << ' ' << c;
      }
    }
  }
}

TEST(GroundRoughness, ThingsOnAThirdOfTheGroundRaiseItAFewTimes) {
  GridF prominence_m = Noise(60, 60, 0.01);
  for (int r = 0; r < 60; ++r) {
    for (int c = 0; c < 60; c += 3) {
      prominence_m.at(r, c) = 0.8F;
    }
  }
  EXPECT_LT(GroundRoughness(prominence_m, 0.15).At(30, 30), 0.025);
}

TEST(GroundRoughness, BelongsToItsPlace) {
  GridF prominence_m = Noise(100, 100, 0.01);
  for (int r = 0; r < 100; ++r) {
    for (int c = 50; c < 100; ++c) {
      prominence_m.at(r, c) *= 5;
    }
  }
  const GroundRoughness roughness(prominence_m, 0.15);
  EXPECT_NEAR(roughness.At(50, 20), 0.01, 0.002);
  EXPECT_NEAR(roughness.At(50, 80), 0.05, 0.01);
}

TEST(GroundRoughness, BlocksHaveASizeInMetres) {
  // A thing a metre wide, far more cells than a block of ten.
  GridF prominence_m = Noise(240, 240, 0.01);
  for (int r = 100; r < 150; ++r) {
    for (int c = 100; c < 150; ++c) {
      prominence_m.at(r, c) = 0.5F;
    }
  }
  EXPECT_LT(GroundRoughness(prominence_m, 0.02).At(125, 125), 0.02);
}

TEST(GroundRoughness, UnknownGroundIsLeftOutOrLevel) {
  GridF prominence_m = Noise(60, 60, 0.02);
  for (int r = 0; r < 60; ++r) {
    for (int c = 0; c < 60; ++c) {
      if ((r + c) % 2 == 0) {
        prominence_m.at(r, c) = kUnknownValue;
      }
    }
  }
  EXPECT_NEAR(GroundRoughness(prominence_m, 0.15).At(25, 25), 0.02, 0.004);
  EXPECT_EQ(GroundRoughness(GridF(30, 30, kUnknownValue), 0.15).At(29, 29), 0);
  EXPECT_EQ(GroundRoughness(GridF(1, 1, 0.0F), 1e-9).At(0, 0), 0);
}

}  // namespace
}  // namespace palace
