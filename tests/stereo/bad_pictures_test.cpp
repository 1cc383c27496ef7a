// Pictures that no matcher can use: no crash, no depth out of nothing, and a health report that
// says what is wrong. And every option of the settings on pictures that are good.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/stereo/accuracy.h"
#include "engine/stereo/prefilter.h"
#include "engine/stereo/stereo.h"
#include "tests/support/synthetic_stereo.h"

namespace palace {
namespace {

using synthetic::Pair;

constexpr double kHeight_m = 50 * kMetresPerFoot;
constexpr DisparityWindow kWindow{16, 64};

const Pair& GoodPair() {
  static const Pair pair = synthetic::MakePair({}, kHeight_m, Rad(-90), 2, 1, 0, 400, 240);
  return pair;
}

ImageU8 Noise(int width, int height, std::uint64_t seed) {
  RandomStream random(seed);
  ImageU8 image(width, height);
  for (auto& pixel : image.pixels()) {
    pixel = static_cast<std::uint8_t>(random.Index(256));
  }
  return image;
}

ImageU8 Checkers(int width, int height) {
  ImageU8 image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y) = (x / 4 + y / 4) % 2 == 0 ? 60 : 190;
    }
  }
  return image;
}

/// Nothing is NaN in one layer and known in another, infinite, negative or zero.
void ExpectConsistent(const RangeMap& range) {
  for (std::size_t i = 0; i < range.depth_m.pixels().size(); ++i) {
    const float d = range.disparity_px.pixels()[i], s = range.disparity_sigma_px.pixels()[i];
    const float z = range.depth_m.pixels()[i], t = range.depth_sigma_m.pixels()[i];
    if (std::isnan(d)) {
      ASSERT_TRUE(std::isnan(s) && std::isnan(z) && std::isnan(t));
    } else {
      ASSERT_TRUE(std::isfinite(d) && std::isfinite(s) && std::isfinite(z) && std::isfinite(t));
      ASSERT_TRUE(d > 0 && s > 0 && z > 0 && t > 0);
    }
  }
}

struct BadRow {
  const char* name;
  std::function<ImageU8()> left;
  std::function<ImageU8()> right;
  double most_coverage;
  bool covered;
  bool same;
};

TEST(BadPictures, GiveNoDepthAndSayWhy) {
  const auto flat = [](int grey) {
    return [grey] { return ImageU8(400, 240, static_cast<std::uint8_t>(grey)); };
  };
  const auto good_left = [] { return GoodPair().left; };
  const auto good_right = [] { return GoodPair().right; };
  for (const BadRow& row : {
           BadRow{"black", flat(0), flat(0), 0, false, false},
           BadRow{"white", flat(255), flat(255), 0, false, false},
           BadRow{"grey", flat(90), flat(90), 0, false, false},
           BadRow{"black and white", flat(0), flat(255), 0, false, false},
           BadRow{"noise", [] { return Noise(400, 240, 1); }, [] { return Noise(400, 240, 2); },
                  0.005, false, false},
           BadRow{"left covered", flat(2), good_right, 0, true, false},
           BadRow{"right covered", good_left, flat(2), 0, true, false},
           BadRow{"same picture", good_left, good_left, 0.02, false, true},
           BadRow{"upside down", good_left,
                  [&] {
                    ImageU8 turned = good_right();
                    std::reverse(turned.pixels().begin(), turned.pixels().end());
                    return turned;
                  },
                  0.02, false, false},
       }) {
    SCOPED_TRACE(row.name);
    StereoMatcher matcher;
    const auto result =
        matcher.Match(row.left(), row.right(), GoodPair().camera, 1, kWindow, {}, {});
    ASSERT_TRUE(result.ok()) << result.error().message;
    ExpectConsistent(result->range);
    const StereoQuality& quality = result->quality;
    std::printf("%-16s coverage %.4f\n", row.name, quality.coverage);
    EXPECT_LE(quality.coverage, row.most_coverage);
    EXPECT_EQ(quality.suspect_covered, row.covered);
    EXPECT_EQ(quality.suspect_same, row.same);
    EXPECT_FALSE(quality.suspect_swapped);
    EXPECT_EQ(std::isnan(quality.median_depth_m), quality.coverage == 0);
  }
}

TEST(BadPictures, RepeatedPatternIsUnknownOrRightButNotAFalseSurface) {
  StereoMatcher matcher;
  const ImageU8 checkers = Checkers(400, 240);
  const auto result = matcher.Match(checkers, checkers, GoodPair().camera, 1, {0, 64}, {}, {});
  ASSERT_TRUE(result.ok());
  EXPECT_LT(result->quality.coverage, 0.05) << "every eighth disparity fits as well";
}

TEST(BadPictures, OddSizesNeitherCrashNorInvent) {
  for (const auto& [width, height] : {std::pair{64, 1}, {48, 2}, {49, 3}, {33, 480}, {641, 17}}) {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    PinholeCamera camera = PinholeFromFov(width, height, Rad(45));
    for (const int levels : {0, 2}) {
      StereoSettings settings;
      settings.pyramid_levels = levels;
      StereoMatcher matcher;
      const auto result = matcher.Match(Noise(width, height, 1), Noise(width, height, 2), camera, 1,
                                        {0, 32}, settings, {});
      ASSERT_TRUE(result.ok()) << result.error().message;
      ExpectConsistent(result->range);
      EXPECT_EQ(result->range.depth_m.width(), width);
      EXPECT_LT(result->quality.coverage, 0.2);
    }
  }
}

struct OptionRow {
  const char* name;
  std::function<void(StereoSettings&)> change;
  double most_rms_px;
};

TEST(StereoOptions, EveryChoiceMeasuresTheSameGround) {
  const Pair& pair = GoodPair();
  const ImageF truth = DisparityFromDepth(pair.depth_m, pair.camera.fx_px * pair.baseline_m);
  for (const OptionRow& row :
       {OptionRow{"default", [](StereoSettings&) {}, 0.08},
        OptionRow{"sgbm", [](StereoSettings& s) { s.method = StereoMethod::kSgbm; }, 0.08},
        OptionRow{"pyramid 1", [](StereoSettings& s) { s.pyramid_levels = 1; }, 0.1},
        OptionRow{"pyramid 3", [](StereoSettings& s) { s.pyramid_levels = 3; }, 0.15},
        OptionRow{"laplacian", [](StereoSettings& s) { s.prefilter = StereoPrefilter::kLaplacian; },
                  0.08},
        OptionRow{"bilateral", [](StereoSettings& s) { s.prefilter = StereoPrefilter::kBilateral; },
                  0.08},
        OptionRow{"window 5", [](StereoSettings& s) { s.refine_window_px = 5; }, 0.15},
        OptionRow{"window 21", [](StereoSettings& s) { s.refine_window_px = 21; }, 0.08}}) {
    SCOPED_TRACE(row.name);
    StereoSettings settings;
    row.change(settings);
    StereoMatcher matcher;
    const auto result = matcher.Match(pair.left, pair.right, pair.camera, 1, kWindow, settings, {});
    ASSERT_TRUE(result.ok()) << result.error().message;
    ExpectConsistent(result->range);
    const DisparityAccuracy accuracy =
        CompareDisparity(result->range.disparity_px, result->range.disparity_sigma_px, truth);
    std::printf("%-10s rms %.3f px, coverage %.3f\n", row.name, accuracy.rms_px, accuracy.coverage);
    EXPECT_LT(accuracy.rms_px, row.most_rms_px);
    EXPECT_LT(accuracy.outliers, 0.005);
    EXPECT_GT(accuracy.coverage, 0.85);
  }
}

TEST(StereoOptions, AWindowWiderThanTheSearchIsHalved) {
  const Pair& pair = GoodPair();
  StereoMatcher matcher;
  const auto result = matcher.Match(pair.left, pair.right, pair.camera, 1, {0, 320}, {}, {});
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_GT(result->quality.coverage, 0.7);
  EXPECT_NEAR(result->quality.median_depth_m, kHeight_m, 0.1);
}

TEST(StereoOptions, PicturesFilteredFirstGoThroughTheSameRectification) {
  StereoRig rig;
  rig.left.pinhole = rig.right.pinhole = GoodPair().camera;
  rig.baseline_m = 1;
  rig.rectified = true;
  const auto rectifier = StereoRectifier::Make(rig);
  ASSERT_TRUE(rectifier.ok()) << rectifier.error().message;
  const StereoFrame raw{{}, GoodPair().left, GoodPair().right};
  StereoSettings settings;
  EXPECT_FALSE(FilterThenRectify(raw, *rectifier, settings)) << "not asked for";
  settings.filter_order = FilterOrder::kFilterFirst;
  EXPECT_FALSE(FilterThenRectify(raw, *rectifier, settings)) << "no filter chosen";
  settings.prefilter = StereoPrefilter::kLaplacian;
  const auto filtered = FilterThenRectify(raw, *rectifier, settings);
  ASSERT_TRUE(filtered.has_value());
  EXPECT_EQ(filtered->left->pixels(), Prefilter(raw.left, settings.prefilter).pixels());
  StereoMatcher matcher;
  const auto result =
      matcher.Match(raw.left, raw.right, rectifier->camera(), 1, kWindow, settings, {}, &*filtered);
  ASSERT_TRUE(result.ok());
  EXPECT_GT(result->quality.coverage, 0.7);
}

TEST(Prefilter, LaplacianIgnoresBrightnessAndBilateralKeepsEdges) {
  ImageU8 step(40, 20, 50);
  for (int y = 0; y < 20; ++y) {
    for (int x = 20; x < 40; ++x) {
      step.at(x, y) = 150;
    }
  }
  ImageU8 brighter = step;
  for (auto& pixel : brighter.pixels()) {
    pixel = static_cast<std::uint8_t>(pixel + 40);
  }
  EXPECT_EQ(Prefilter(step, StereoPrefilter::kLaplacian).pixels(),
            Prefilter(brighter, StereoPrefilter::kLaplacian).pixels());
  const ImageU8 kept = Prefilter(step, StereoPrefilter::kBilateral);
  EXPECT_LE(kept.at(19, 10), 55);
  EXPECT_GE(kept.at(20, 10), 145);
  EXPECT_EQ(Prefilter(step, StereoPrefilter::kNone).pixels(), step.pixels());
}

}  // namespace
}  // namespace palace
