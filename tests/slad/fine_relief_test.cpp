// Heights from the pictures of many frames, on textured ground in closed form.
#include "engine/slad/terrain/fine_relief.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slad/textured_pair.h"

namespace palace {
namespace {

using testing::Flat;
using testing::Height;
using testing::SeeTexture;
using testing::WavyTexture;
using testing::WithBox;

constexpr GridGeometry kMap{40, 40, 0.15, -3, -3};
constexpr double kHeight_m = 10;

FineRelief Look(const Height& ground, int frames, double contrast_grey = 30,
                double noise_grey = 2) {
  const WavyTexture texture(contrast_grey, 1);
  FineRelief relief;
  relief.MoveTo(kMap);
  for (int i = 0; i < frames; ++i) {
    const auto pair = SeeTexture(ground, texture, kHeight_m, noise_grey,
                                 static_cast<std::uint64_t>(i) + 1, 0.02 * i);
    relief.Add(pair.range, pair.left, pair.right, {}, 50);
  }
  return relief;
}

/// Of the square of two places about the corner of these places.
FineSum At(const FineRelief& relief, double north_m, double east_m) {
  const GridGeometry places = FineRelief::PlacesOf(kMap);
  return relief.Sums().Over(
      static_cast<int>(std::lround((places.north_max_m() - north_m) / places.cell_m)),
      static_cast<int>(std::lround((east_m - places.east_min_m) / places.cell_m)), 2);
}

double HeightOf(const FineRelief& relief, double north_m, double east_m) {
  return At(relief, north_m, east_m).height_m() + relief.Sums().reference_m();
}

TEST(FineRelief, AThingNarrowerThanStereosWindowHasItsHeight) {
  // 24 cm are 7 px; the disparities that it is given know nothing of it.
  for (const double thing_m : {0.10, -0.10}) {
    const FineRelief relief = Look(WithBox(Flat(), 0, 0, 0.24, thing_m), 6);
    EXPECT_NEAR(HeightOf(relief, 0, 0), thing_m, 0.03);
    EXPECT_NEAR(HeightOf(relief, 1, 0.9), 0, 0.015);
  }
}

TEST(FineRelief, ItsErrorsAreThoseItStates) {
  const FineRelief relief = Look(Flat(), 4, 12, 3);
  std::vector<double> sigmas;
  for (double n = -2; n <= 2; n += 0.3) {
    for (double e = -1.2; e <= 2; e += 0.3) {
      const FineSum sum = At(relief, n, e);
      ASSERT_TRUE(sum.known());
      sigmas.push_back(std::abs(HeightOf(relief, n, e)) / std::sqrt(sum.variance_m2()));
    }
  }
  std::sort(sigmas.begin(), sigmas.end());
  EXPECT_NEAR(sigmas[sigmas.size() / 2], 0.674, 0.2) << "the median of a normal's magnitude";
  EXPECT_LT(sigmas.back(), 4);
}

TEST(FineRelief, MoreFramesAndMoreTextureKnowMore) {
  const double one = At(Look(Flat(), 1, 10), 0, 0).variance_m2();
  EXPECT_NEAR(At(Look(Flat(), 8, 10), 0, 0).variance_m2() / one, 1 / 8.0, 0.05);
  EXPECT_LT(At(Look(Flat(), 1, 30), 0, 0).variance_m2(), one / 4);
  const FineSum bare = At(Look(Flat(), 1, 0), 0, 0);
  EXPECT_TRUE(!bare.known() || bare.variance_m2() > 100 * one) << "no texture tells nothing";
}

TEST(FineRelief, NoiseThatEveryFrameRepeatsIsNotAveragedAway) {
  const WavyTexture texture(10, 1);
  const auto pair = SeeTexture(Flat(), texture, kHeight_m, 2, 1);
  FineRelief still;
  still.MoveTo(kMap);
  for (int i = 0; i < 12; ++i) {
    still.Add(pair.range, pair.left, pair.right, {}, 50);
  }
  const double one = At(Look(Flat(), 1, 10), 0, 0).variance_m2();
  const double repeated = At(still, 0, 0).variance_m2(),
               anew = At(Look(Flat(), 12, 10), 0, 0).variance_m2();
  EXPECT_GT(repeated, 0.6 * one);
  EXPECT_LT(repeated, 2 * one);
  EXPECT_LT(anew, 2 * one / 12);
}

TEST(FineRelief, OnlySoManyFramesAreRemembered) {
  const WavyTexture texture(30, 1);
  FineRelief relief;
  relief.MoveTo(kMap);
  for (std::uint64_t i = 0; i < 12; ++i) {
    const auto pair = SeeTexture(Flat(), texture, kHeight_m, 2, i % 4);
    relief.Add(pair.range, pair.left, pair.right, {}, 2);
  }
  const auto information = [](const FineRelief& of) { return At(of, 0, 0).of[FineSum::kA]; };
  EXPECT_NEAR(information(relief) / information(Look(Flat(), 2)), 1, 0.2);
}

TEST(FineRelief, FollowsTheMapAndForgetsWhatItIsTold) {
  FineRelief relief = Look(WithBox(Flat(), 0, 0, 0.24, 0.10), 6);
  const double before_m = HeightOf(relief, 0, 0);
  GridGeometry moved = kMap;
  moved.north_min_m += 3 * kMap.cell_m;
  moved.east_min_m -= 2 * kMap.cell_m;
  relief.MoveTo(moved);
  relief.MoveTo(kMap);
  EXPECT_EQ(HeightOf(relief, 0, 0), before_m);
  relief.Raise({0.5, 0.1, 0, 0, 0}, 0.5);
  EXPECT_NEAR(HeightOf(relief, 0, 0), before_m + 0.25, 1e-3);
  EXPECT_NEAR(HeightOf(relief, 1, 0.9), 0.30, 0.015) << "and a tilt of 0.05 north";
  for (const Cell cell : {Cell{19, 19}, Cell{19, 20}, Cell{20, 19}, Cell{20, 20}}) {
    relief.Forget(cell);
  }
  EXPECT_FALSE(At(relief, 0, 0).known());
  EXPECT_TRUE(At(relief, 1, 0.9).known());
  GridGeometry coarser = kMap;
  coarser.cell_m *= 2;
  relief.MoveTo(coarser);
  EXPECT_FALSE(relief.Sums().Over(20, 20, 40).known()) << "another cell size begins anew";
}

TEST(FineRelief, SmallPicturesTellNothing) {
  FineRelief relief;
  relief.MoveTo(kMap);
  RangeMap range = SeeTexture(Flat(), WavyTexture(30, 1), kHeight_m, 2, 1).range;
  range.disparity_px = ImageF(60, 60, 30);
  relief.Add(range, ImageU8(60, 60), ImageU8(60, 60), {}, 10);
  EXPECT_TRUE(relief.empty());
}

}  // namespace
}  // namespace palace
