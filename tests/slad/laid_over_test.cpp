#include "engine/slad/terrain/laid_over.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/slad/textured_pair.h"

namespace palace {
namespace {

using testing::Flat;
using testing::SeeTexture;
using testing::TexturedPair;
using testing::WavyTexture;

const WavyTexture kTexture(30, 1);

TEST(LaidOver, LevelGroundLeavesOnlyTheNoiseOfBothPictures) {
  for (const double noise_grey : {0.0, 2.0, 4.0}) {
    const TexturedPair pair = SeeTexture(Flat(), kTexture, 10, noise_grey, 7);
    const LaidOver laid = LayOver(pair.left, pair.right, pair.range.disparity_px);
    double sum2 = 0, sum = 0;
    int known = 0;
    for (std::size_t i = 0; i < laid.known.pixels().size(); ++i) {
      known += laid.known.pixels()[i] > 0 ? 1 : 0;
      sum += static_cast<double>(laid.residual.pixels()[i]);
      sum2 += std::pow(static_cast<double>(laid.residual.pixels()[i]), 2);
    }
    // (1, 2, 1) / 4 passes 3/8 of a picture's noise, and the spline a half to all of the right's.
    // Rounding adds 1/12 a picture, and what the spline blurs.
    EXPECT_GT(known, 280 * 240);
    EXPECT_NEAR(sum / known, 0, 0.05);
    EXPECT_LT(std::sqrt(sum2 / known), std::sqrt(0.75 * noise_grey * noise_grey + 0.5));
    EXPECT_GT(std::sqrt(sum2 / known), std::sqrt(0.56 * noise_grey * noise_grey));
    EXPECT_NEAR(static_cast<double>(laid.noise2.at(50, 30)), sum2 / known,
                0.3 * sum2 / known + 0.5);
  }
}

/// By how much level ground seems off, with that disparity, as its residuals and gradients say.
double SeemsOff_px(double disparity_px, std::uint64_t texture) {
  const TexturedPair pair = SeeTexture(Flat(), WavyTexture(30, texture), 300 / disparity_px, 0, 7);
  const LaidOver laid = LayOver(pair.left, pair.right, pair.range.disparity_px);
  double answer = 0, information = 0;
  for (int y = 0; y < 240; ++y) {
    const float *l = laid.left.row(y), *e = laid.residual.row(y);
    for (int x = 40; x < 318; ++x) {
      const auto g = static_cast<double>(l[x + 1] - l[x - 1]) / 2;
      answer -= static_cast<double>(e[x]) * g;
      information += g * g;
    }
  }
  return answer / information;
}

TEST(LaidOver, LevelGroundDoesNotWaveWithTheFractionOfADisparity) {
  for (const double disparity_px : {30.0, 30.25, 30.5, 30.75, 24.25, 24.75}) {
    double sum_px = 0;
    for (std::uint64_t texture = 1; texture <= 8; ++texture) {
      sum_px += SeemsOff_px(disparity_px, texture);
    }
    EXPECT_NEAR(sum_px / 8, 0, 0.004) << disparity_px;
  }
}

TEST(LaidOver, GainAndOffsetBetweenThePicturesAreNoResidual) {
  const TexturedPair pair = SeeTexture(Flat(), kTexture, 10, 1, 7, 0, 0.7, 25);
  const LaidOver laid = LayOver(pair.left, pair.right, pair.range.disparity_px);
  EXPECT_LT(laid.noise2.at(40, 30), 6)
      << "the right picture's noise, 1.4 times as strong, and ours";
}

TEST(LaidOver, NothingIsKnownBeyondTheRightPictureNorWhereStereoKnewNothing) {
  TexturedPair pair = SeeTexture(Flat(), kTexture, 10, 1, 7);
  for (int y = 0; y < 240; ++y) {
    for (int x = 200; x < 320; ++x) {
      pair.range.disparity_px.at(x, y) = std::nanf("");
    }
  }
  const LaidOver laid = LayOver(pair.left, pair.right, pair.range.disparity_px);
  for (int y = 0; y < 240; y += 11) {
    EXPECT_EQ(laid.known.at(20, y), 0) << "30 px of disparity";
    EXPECT_EQ(laid.known.at(100, y), 1);
    EXPECT_EQ(laid.known.at(260, y), 0);
    EXPECT_EQ(laid.residual.at(260, y), 0);
  }
}

TEST(LaidOver, TheGroundIsAPlaneThroughNoisyDisparitiesAndFollowsWhatIsFarOff) {
  TexturedPair pair = SeeTexture(Flat(), kTexture, 10, 1, 7);
  RandomStream random(3, "stereo");
  for (float& d : pair.range.disparity_px.pixels()) {
    d += static_cast<float>(0.2 * random.Normal());
  }
  for (int y = 100; y < 140; ++y) {
    for (int x = 150; x < 190; ++x) {
      pair.range.disparity_px.at(x, y) += 3;
    }
  }
  const LaidOver laid = LayOver(pair.left, pair.right, pair.range.disparity_px);
  double worst_px = 0;
  for (int y = 20; y < 60; ++y) {
    for (int x = 60; x < 300; ++x) {
      worst_px = std::max(worst_px, std::abs(static_cast<double>(laid.disparity_px.at(x, y)) - 30));
    }
  }
  EXPECT_LT(worst_px, 0.04) << "0.2 px over 784 pixels, at the window's rim twice as much";
  EXPECT_NEAR(laid.disparity_px.at(170, 120), 33, 0.2);
}

TEST(LaidOver, NothingIsLaidAcrossADepthEdge) {
  const TexturedPair pair = SeeTexture(Flat(), kTexture, 10, 0, 7);
  for (const float step_px : {0.5F, 3.0F}) {
    ImageF disparity_px = pair.range.disparity_px;
    for (int y = 0; y < disparity_px.height(); ++y) {
      for (int x = 160; x < disparity_px.width(); ++x) {
        disparity_px.row(y)[x] += step_px;
      }
    }
    const LaidOver laid = LayOver(pair.left, pair.right, disparity_px);
    const bool is_edge = step_px > 1;
    EXPECT_EQ(laid.known.at(159, 120) > 0, !is_edge) << step_px;
    EXPECT_EQ(laid.known.at(160, 120) > 0, !is_edge) << step_px;
    EXPECT_GT(laid.known.at(150, 120), 0) << step_px;
    EXPECT_GT(laid.known.at(170, 120), 0) << step_px;
  }
}

TEST(LaidOver, PicturesWithoutContrastGiveNumbers) {
  TexturedPair pair = SeeTexture(Flat(), kTexture, 10, 1, 7);
  for (const int grey : {0, 255}) {
    for (const bool both : {true, false}) {
      const ImageU8 blank(320, 240, static_cast<std::uint8_t>(grey));
      const LaidOver laid = LayOver(blank, both ? blank : pair.right, pair.range.disparity_px);
      for (const float e : laid.residual.pixels()) {
        ASSERT_TRUE(std::isfinite(e)) << grey;
      }
    }
  }
}

}  // namespace
}  // namespace palace
