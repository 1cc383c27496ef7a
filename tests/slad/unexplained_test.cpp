// Where the pictures differ by what no height explains, on textured ground in closed form.
#include "engine/slad/terrain/unexplained.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/slad/terrain/fine_relief.h"
#include "tests/slad/textured_pair.h"

namespace palace {
namespace {

using testing::Flat;
using testing::Height;
using testing::MakeMap;
using testing::SeeTexture;
using testing::ThatShow;
using testing::WavyTexture;
using testing::WithBox;

constexpr GridGeometry kMap{20, 20, 0.15, -1.5, -1.5};
constexpr double kHeight_m = 5;

/// v of the places of the middle, from pictures whose disparities know of level ground alone.
struct Seen {
  std::vector<float> away, near;  ///< by more than 0.4 m of the middle; by less than 0.15 m
};
/// A bright top 4 px wide, `up_m` above the origin.
void DrawTop(double up_m, testing::TexturedPair& pair) {
  const PinholeCamera& camera = pair.range.camera;
  const Eigen::Vector3d p_C = pair.range.pose->X_WC.Inverse() * Eigen::Vector3d(0, 0, -up_m);
  const auto draw = [&](double baseline_m, ImageU8& picture) {
    const auto x = static_cast<int>(
        std::lround(camera.cx_px + camera.fx_px * (p_C.x() - baseline_m) / p_C.z()));
    const auto y = static_cast<int>(std::lround(camera.cy_px + camera.fy_px * p_C.y() / p_C.z()));
    for (int i = 0; i < 16; ++i) {
      picture.at(x - 2 + i % 4, y - 2 + i / 4) = 220;
    }
  };
  draw(0, pair.left);
  draw(pair.range.baseline_m, pair.right);
}

/// Bright grains on level ground, a third of a pixel wide: one lies in a pixel, or in two.
void DrawGrains(double grey, testing::TexturedPair& pair) {
  constexpr int kGrains = 600;
  constexpr double kWidth_px = 1 / 3.0;
  const PinholeCamera& camera = pair.range.camera;
  RandomStream random(8, "grains");
  for (int k = 0; k < kGrains; ++k) {
    const Eigen::Vector3d p_W(random.Uniform(-1.5, 1.5), random.Uniform(-1.5, 1.5), 0);
    const Eigen::Vector3d p_C = pair.range.pose->X_WC.Inverse() * p_W;
    const auto y = static_cast<int>(std::lround(camera.cy_px + camera.fy_px * p_C.y() / p_C.z()));
    const auto draw = [&](double baseline_m, ImageU8& picture) {
      const double x = camera.cx_px + camera.fx_px * (p_C.x() - baseline_m) / p_C.z() + 0.5;
      if (x < 1 || x > camera.width - 1 || y < 0 || y >= camera.height) {
        return;
      }
      const double end = x + kWidth_px / 2, beyond = end - std::floor(end);
      const double share = std::min(1.0, beyond / kWidth_px);
      const auto last = static_cast<int>(end);
      for (const auto& [at, part] : {std::pair{last, share}, {last - 1, 1 - share}}) {
        const long lit = picture.at(at, y) + std::lround(part * grey);
        picture.at(at, y) = static_cast<std::uint8_t>(std::min(255L, lit));
      }
    };
    draw(0, pair.left);
    draw(pair.range.baseline_m, pair.right);
  }
}

struct Ground {
  Height height = Flat();
  double contrast_grey = 30;
  double top_m = NAN;      ///< of what stands in the middle
  double grains_grey = 0;  ///< bright grains
  double from_m = kHeight_m;
};

Seen See(const Ground& ground) {
  const WavyTexture texture(ground.contrast_grey, 1);
  FineRelief relief;
  relief.MoveTo(kMap);
  for (int i = 0; i < 6; ++i) {
    const double aside_m = ground.grains_grey > 0 ? 0 : 0.02 * i;
    auto pair = SeeTexture(ground.height, texture, ground.from_m, 2,
                           static_cast<std::uint64_t>(i) + 1, aside_m);
    if (ground.grains_grey > 0) {
      DrawGrains(ground.grains_grey, pair);
    }
    if (!std::isnan(ground.top_m)) {
      DrawTop(ground.top_m, pair);
    }
    relief.Add(pair.range, pair.left, pair.right, {}, 50);
  }
  const GridF v = Unexplained(relief.seen());
  const GridGeometry places = FineRelief::PlacesOf(kMap);
  Seen seen;
  for (int r = 0; r < places.rows; ++r) {
    for (int c = 0; c < places.cols; ++c) {
      const double away_m = std::hypot(places.NorthOfRow(r), places.EastOfCol(c));
      if (!std::isnan(v.at(r, c)) && (away_m > 0.4 || away_m < 0.15)) {
        (away_m > 0.4 ? seen.away : seen.near).push_back(v.at(r, c));
      }
    }
  }
  std::sort(seen.away.begin(), seen.away.end());
  std::sort(seen.near.begin(), seen.near.end());
  return seen;
}

TEST(Unexplained, OverBareGroundItIsNoiseWhateverItsTone) {
  for (const double contrast_grey : {0.0, 10.0, 30.0}) {
    SCOPED_TRACE(contrast_grey);
    const Seen seen = See({.contrast_grey = contrast_grey});
    ASSERT_GT(seen.away.size(), 200u);
    EXPECT_LT(seen.away[seen.away.size() / 2], 1);  // less where gradients are steep
    EXPECT_LT(seen.away.back(), 8);
  }
}

TEST(Unexplained, AHeightOfTheGroundExplainsItself) {
  EXPECT_LT(See({.height = WithBox(Flat(), 0, 0, 0.6, 0.02)}).near.back(), 8);
}

// The top of a post seen end-on is 4 px wide, and where it is half a metre high it moved by 7.
// Paint explains itself.
TEST(Unexplained, APostSeenEndOnIsNoHeightOfTheGround) {
  const Seen seen = See({.top_m = 0.5});
  EXPECT_GT(seen.near.back(), 20);
  EXPECT_LT(seen.away[seen.away.size() / 2], 1);
  EXPECT_LT(See({.top_m = 0}).near.back(), 10);
}

// Half a pixel of disparity apart, a grain that lies in one pixel of one picture lies in two of the
// other, in every frame of a still view: v is 26 if it is taken for noise. From 12 on a thing is as
// likely as not. A post among such grains is seen all the same.
TEST(Unexplained, AGrainFinerThanAPixelIsNoMark) {
  constexpr double kHalf_px_m = 300 / 60.5;  // 300 px m of focal length times baseline
  const Seen bare = See({.grains_grey = 110, .from_m = kHalf_px_m});
  ASSERT_GT(bare.away.size(), 200u);
  EXPECT_LT(bare.away.back(), 12);
  EXPECT_GT(See({.top_m = 0.5, .grains_grey = 110, .from_m = kHalf_px_m}).near.back(), 16);
}

TEST(Unexplained, WhatHardlyAnyPixelSawSaysNothing) {
  Grid<FinePlace> places(2, 2);
  places.at(0, 1).of[FinePlace::kPixels] = 100;
  places.at(0, 1).of[FinePlace::kEnergy] = 300;
  const GridF v = Unexplained(places);
  EXPECT_TRUE(std::isnan(v.at(0, 0)));
  EXPECT_FLOAT_EQ(v.at(0, 1), static_cast<float>(2 / std::sqrt(0.01 + 0.01)));
  places.at(0, 1).of[FinePlace::kSampled] = 60;
  EXPECT_FLOAT_EQ(Unexplained(places).at(0, 1),
                  static_cast<float>(2 / std::sqrt(0.01 + 0.01 + 0.36)));
}

TEST(Marks, TellHowHighAThingMustBeToMoveByTwoPixels) {
  ElevationMap map = MakeMap(20, 20, 0.15, Flat());
  map.narrow = ThatShow(map.geometry, 0, 0.01);
  GridF v(40, 40, 1.0F);
  v.at(20, 20) = 30;
  v.at(10, 10) = kUnknownValue;
  const PinholeCamera camera = testing::ThesisCamera();
  TakeMarks(v, {camera, {0, 0, -12}}, 800, map);
  EXPECT_NEAR(map.narrow.mark.at(20, 20), 1, 1e-6);
  EXPECT_LT(map.narrow.mark.at(20, 24), 1e-4);
  EXPECT_EQ(map.narrow.mark.at(10, 10), 0);
  // 800 px m of focal length times baseline: 66.7 px at 12 m, 2 px more at 11.65 m.
  EXPECT_NEAR(map.narrow.mark_from_m.at(20, 20), 2 * 12 * 12 / 800.0, 0.01);
}

}  // namespace
}  // namespace palace
