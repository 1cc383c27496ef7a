// Heights from the pictures of many frames, on textured ground in closed form.
#include "engine/slad/terrain/fine_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/frames.h"
#include "engine/slad/terrain/laid_over.h"
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

/// The sums of fine_relief.h, pixel by pixel, in doubles, from points in W.
Grid<FinePlace> PlainSums(const testing::TexturedPair& pair, const PlaneCorrection& off) {
  const GridGeometry places = FineRelief::PlacesOf(kMap);
  const LaidOver laid = LayOver(pair.left, pair.right, pair.range.disparity_px);
  const PinholeCamera& camera = pair.range.camera;
  const RigidTransform& X_WC = pair.range.pose->X_WC;
  const double reference_m = HeightFromDown(X_WC.p.z());
  std::vector<std::array<double, FinePlace::kCount>> sums(
      static_cast<std::size_t>(places.rows * places.cols));
  const auto gradient = [&](int x, int y) {
    const auto grey = [&](int dx) { return static_cast<double>(laid.left.at(x + dx, y)); };
    return (grey(-2) - 8 * grey(-1) + 8 * grey(1) - grey(2)) / 12;
  };
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 2; x < camera.width - 2; ++x) {
      const auto d = static_cast<double>(laid.disparity_px.at(x, y));
      if (laid.known.at(x, y) == 0) {
        continue;
      }
      const double depth_m = pair.range.FocalTimesBaseline() / d;
      const Eigen::Vector3d ray_W = X_WC.R * Eigen::Vector3d((x - camera.cx_px) / camera.fx_px,
                                                             (y - camera.cy_px) / camera.fy_px, 1);
      const Eigen::Vector3d p_W = X_WC.p + depth_m * ray_W;
      const auto cell = places.CellFromPoint(p_W.x(), p_W.y());
      if (!cell) {
        continue;
      }
      const double height_m = HeightFromDown(p_W.z()) - reference_m - off.At(p_W.x(), p_W.y());
      const double k = ray_W.z() * depth_m / d, g = gradient(x, y),
                   c = gradient(x, y + 8 < camera.height ? y + 8 : y - 8);
      const auto e = static_cast<double>(laid.residual.at(x, y));
      const auto s2 = static_cast<double>(
          laid.noise2.at(std::min(x / LaidOver::kPatch_px, laid.noise2.width() - 1),
                         std::min(y / LaidOver::kPatch_px, laid.noise2.height() - 1)));
      const double w = 1 / (k * k * s2);
      auto& of = sums[static_cast<std::size_t>(cell->row * places.cols + cell->col)];
      of[FinePlace::kNet] += (g * g - 0.30 * s2) * w;
      of[FinePlace::kGross] += g * g * w;
      of[FinePlace::kHeight] += height_m * (g * g - 0.30 * s2) * w - e * g * k * w;
      of[FinePlace::kOff] -= e * g * k * w;
      of[FinePlace::kOtherGross] += c * c * w;
      of[FinePlace::kOther] -= e * c * k * w;
      of[FinePlace::kShared] += g * c * w;
      const auto grey = [&](int dx) { return static_cast<double>(laid.left.at(x + dx, y)); };
      const double h = (grey(-1) - 2 * grey(0) + grey(1)) / 2, q = 0.04 * g * g + 0.12 * h * h;
      of[FinePlace::kEnergy] += e * e / (s2 + q);
      of[FinePlace::kSampled] += q / (s2 + q);
      of[FinePlace::kPixels] += 1;
    }
  }
  Grid<FinePlace> plain(places.rows, places.cols);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (std::size_t k = 0; k < sums[i].size(); ++k) {
      plain.cells()[i].of[k] = static_cast<float>(sums[i][k]);
    }
  }
  return plain;
}

TEST(FineRelief, ItsStripesSumToWhatOnePlainLoopSums) {
  // From such a height no row of pixels falls on a border between places.
  const auto pair =
      SeeTexture(WithBox(Flat(), 0.5, 0.5, 0.3, 0.1), WavyTexture(30, 1), 9.713, 2, 1, 0.307);
  const PlaneCorrection off{0.04, 0.01, -0.02, 0, 0};
  FineRelief relief;
  relief.MoveTo(kMap);
  relief.Add(pair.range, pair.left, pair.right, off, 50);
  const Grid<FinePlace> plain = PlainSums(pair, off);
  int same = 0, seen = 0;
  std::array<double, FinePlace::kCount> all{}, all_plain{};
  for (std::size_t i = 0; i < plain.cells().size(); ++i) {
    const auto &of = relief.seen().cells()[i].of, &slow = plain.cells()[i].of;
    seen += slow[FinePlace::kPixels] > 0 ? 1 : 0;
    bool alike = slow[FinePlace::kPixels] > 0;
    for (std::size_t k = 0; k < of.size(); ++k) {
      all[k] += static_cast<double>(of[k]);
      all_plain[k] += static_cast<double>(slow[k]);
      // Sums of both signs keep fewer digits than the largest of their terms.
      const double scale = std::max(1.0, static_cast<double>(slow[FinePlace::kGross]));
      alike = alike && std::abs(static_cast<double>(of[k] - slow[k])) < 2e-3 * scale;
    }
    same += alike ? 1 : 0;
  }
  EXPECT_GT(seen, 1000);
  EXPECT_GT(same, 0.98 * seen) << "of the rest a pixel lies on a border";
  EXPECT_EQ(all[FinePlace::kPixels], all_plain[FinePlace::kPixels]);
  for (const auto k : {FinePlace::kNet, FinePlace::kGross, FinePlace::kHeight,
                       FinePlace::kOtherGross, FinePlace::kEnergy, FinePlace::kSampled}) {
    EXPECT_NEAR(all[k] / all_plain[k], 1, 1e-3) << k;
  }
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
