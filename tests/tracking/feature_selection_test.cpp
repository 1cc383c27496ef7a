// Which place of a picture a template is cut from: strong in both directions, unlike its
// neighbours, apart from the others. That the best of them is the best to follow, it cannot prove.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/tracking/template_match.h"
#include "engine/tracking/template_selection.h"
#include "tests/tracking/ground_world.h"

namespace palace {
namespace {

constexpr int kWidth = 320, kHeight = 240;

ImageU8 Even(std::uint8_t grey = 120) { return ImageU8(kWidth, kHeight, grey); }

/// Blocks of random grey, each of its own.
void PaintBlocks(ImageU8& picture, int left, int top, int side, std::uint64_t seed) {
  RandomStream random(seed, "blocks");
  for (int y = 0; y < side; y += 6) {
    for (int x = 0; x < side; x += 6) {
      const auto grey = static_cast<std::uint8_t>(random.Uniform(20, 230));
      for (int v = y; v < std::min(y + 6, side); ++v) {
        std::fill_n(picture.row(top + v) + left + x, std::min(6, side - x), grey);
      }
    }
  }
}

/// Checks of `period` pixels: every template is that of a period away.
ImageU8 Checked(int period) {
  ImageU8 picture = Even();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool dark = (x % period < period / 2) == (y % period < period / 2);
      picture.at(x, y) = dark ? 60 : 190;
    }
  }
  return picture;
}

TEST(TemplateSelection, EvenGroundNoiseAndAnEdgeGiveNothing) {
  EXPECT_TRUE(SelectTemplates(Even(), {}).empty());
  ImageU8 noisy = Even(), edge = Even(40);
  RandomStream random(5);
  for (std::uint8_t& pixel : noisy.pixels()) {
    pixel = static_cast<std::uint8_t>(120 + 2 * random.Normal());
  }
  for (int y = 0; y < kHeight; ++y) {
    std::fill(edge.row(y) + 160, edge.row(y) + kWidth, 180);
  }
  EXPECT_TRUE(SelectTemplates(noisy, {}).empty());
  EXPECT_TRUE(SelectTemplates(edge, {}).empty());
  EXPECT_TRUE(SelectTemplates(ImageU8(40, 300, 7), {}).empty()) << "smaller than the template";
}

TEST(TemplateSelection, TheOneTexturedPlaceIsFound) {
  ImageU8 picture = Even();
  PaintBlocks(picture, 180, 90, 48, 3);
  const auto features = SelectTemplates(picture, {});
  ASSERT_FALSE(features.empty());
  EXPECT_NEAR(features[0].pixel.x(), 203.5, 24);
  EXPECT_NEAR(features[0].pixel.y(), 113.5, 24);
  EXPECT_LT(features[0].self_similarity, 0.8);
}

TEST(TemplateSelection, ARepeatedPatternIsRefused) {
  for (const int period : {8, 12, 20, 28}) {
    EXPECT_TRUE(SelectTemplates(Checked(period), {}).empty()) << period;
    EXPECT_GT(SelfSimilarity(Checked(period), {160, 120}, 41, 32), 0.95) << period;
  }
  // The one place that differs is taken, although the checks have the stronger edges.
  ImageU8 picture = Checked(20);
  PaintBlocks(picture, 60, 60, 60, 9);
  const auto features = SelectTemplates(picture, {});
  ASSERT_FALSE(features.empty());
  for (const TemplateFeature& feature : features) {
    EXPECT_LT((feature.pixel - Eigen::Vector2d(90, 90)).lpNorm<Eigen::Infinity>(), 52);
    EXPECT_LE(feature.self_similarity, 0.8);
  }
}

TEST(TemplateSelection, AnEqualOutsideOfTheWindowIsNoRival) {
  ImageU8 picture = Even();
  PaintBlocks(picture, 60, 90, 48, 3);
  PaintBlocks(picture, 200, 90, 48, 3);
  EXPECT_LT(SelfSimilarity(picture, {83, 113}, 41, 32), 0.8);
  EXPECT_GT(SelfSimilarity(picture, {83, 113}, 41, 145), 0.99);
}

TEST(TemplateSelection, BestFirstSpreadInsideAndUnderTheMask) {
  const PinholeCamera camera{640, 480, 772.548, 772.548, 319.5, 239.5};
  GroundWorld world(4);
  RigidTransform X_WC;
  X_WC.R = CameraRotationFromTilt(Rad(-90));
  X_WC.p = {0, 0, -10};
  const ImageU8 picture = world.Render(camera, X_WC, 2.5F);
  TemplateSelectionOptions options;
  options.max_count = 25;
  options.spacing_px = 60;
  const auto features = SelectTemplates(picture, options);
  ASSERT_EQ(features.size(), 25u);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const TemplateFeature& feature = features[i];
    EXPECT_TRUE(i == 0 || feature.strength <= features[i - 1].strength) << i;
    EXPECT_GE(feature.pixel.minCoeff(), 20);
    EXPECT_LE(feature.pixel.x(), 619);
    EXPECT_LE(feature.pixel.y(), 459);
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GE((feature.pixel - features[k].pixel).norm(), 60);
    }
  }
  ImageU8 mask(640, 480);
  for (int y = 300; y < 480; ++y) {
    std::fill(mask.row(y), mask.row(y) + 640, 255);
  }
  const auto below = SelectTemplates(picture, options, mask);
  ASSERT_FALSE(below.empty());
  for (const TemplateFeature& feature : below) {
    EXPECT_GE(feature.pixel.y(), 300);
  }
}

/// Metamorphic: a picture that moved has its features moved with it.
TEST(TemplateSelection, MovesWithThePicture) {
  ImageU8 picture = Even(), moved = Even();
  PaintBlocks(picture, 100, 80, 48, 3);
  PaintBlocks(moved, 117, 69, 48, 3);
  const auto before = SelectTemplates(picture, {}), after = SelectTemplates(moved, {});
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].pixel - before[i].pixel, Eigen::Vector2d(17, -11));
  }
}

// ---- template match ----

TEST(TemplateMatch, FindsThePlaceAndNoScoreOverFlatGround) {
  ImageU8 window(105, 105, 0), wanted(41, 41);
  PaintBlocks(wanted, 0, 0, 41, 6);
  EXPECT_EQ(MatchTemplate(window, wanted).score, 0);
  EXPECT_EQ(MatchTemplate(wanted, wanted).second_score, 0);
  PaintBlocks(window, 37, 12, 41, 6);
  const TemplateMatch match = MatchTemplate(window, wanted);
  EXPECT_EQ(match.corner, Eigen::Vector2i(37, 12));
  EXPECT_NEAR(match.score, 1, 1e-4);
  EXPECT_LT(match.second_score, 0.7);
}

}  // namespace
}  // namespace palace
