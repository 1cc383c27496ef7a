// The decision beside depth edges, on ray-cast boxes and ground with exact disparities.
#include "engine/stereo/depth_edges.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/core/units.h"
#include "engine/stereo/accuracy.h"
#include "engine/stereo/semi_global.h"
#include "engine/stereo/subpixel.h"
#include "engine/world/ray_pictures.h"

namespace palace {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr double kHeight_m = 4;

/// Boxes 0.3 to 1 m high, seen from 4 m: steps of 5 to 60 px.
StereoView BoxesFrom(double tilt_rad, GroundTexture texture) {
  const double north_m = tilt_rad < Rad(-60) ? 0 : kHeight_m;
  World world;
  world.ground.texture = texture;
  for (int k = 0; k < 20; ++k) {
    world.solids.push_back(MakeBox(north_m - 2 + 1.1 * (k / 4), -2 + 1.4 * (k % 4),
                                   0.3 + 0.14 * (k % 5), 0.3 + 0.14 * (k % 5),
                                   0.3 + 0.14 * (k % 6)));
  }
  return ViewFrom(world, PinholeFromFov(640, 480, Rad(45)), kHeight_m, tilt_rad, 2);
}

DisparityAccuracy Compare(const StereoView& view, const SubpixelDisparity& found) {
  return CompareDisparity(found.disparity_px, found.sigma_px,
                          DisparityFromDepth(view.depth_m, view.camera.fx_px * view.baseline_m));
}

TEST(DepthEdges, FewerPixelsAreGivenToTheWrongSurface) {
  for (const double tilt_deg : {-90.0, -45.0}) {
    for (const auto texture : {GroundTexture::kGravel, GroundTexture::kAsphalt}) {
      const StereoView view = BoxesFrom(Rad(tilt_deg), texture);
      const ImageU8 left = Expose(view.left_grey, {2}, 1);
      const ImageU8 right = Expose(view.right_grey, {2, 1, 20}, 2);  // brighter
      const ImageF whole = MatchSemiGlobal(left, right, {80, 176}, {});
      const DisparityAccuracy before = Compare(view, RefineDisparity(left, right, whole, {}));
      const DisparityAccuracy after = Compare(
          view, RefineDisparity(left, right, DecideBesideDepthEdges(left, right, whole), {}));
      std::printf("%3.0f deg, texture %d: wrong %.4f of %.3f, then %.4f of %.3f\n", tilt_deg,
                  static_cast<int>(texture), before.outliers, before.coverage, after.outliers,
                  after.coverage);
      EXPECT_LT(after.outliers, 0.75 * before.outliers);
      EXPECT_GT(after.coverage, before.coverage - 0.02);
    }
  }
}

TEST(DepthEdges, GroundWithoutEdgesStaysAsItIs) {
  const Exposure noise{4};
  const StereoView view = ViewFrom({.ground = {.texture = GroundTexture::kAsphalt}},
                                   PinholeFromFov(320, 240, Rad(45)), kHeight_m, Rad(-45), 1);
  ImageF truth = DisparityFromDepth(view.depth_m, view.camera.fx_px * view.baseline_m);
  for (int x = 0; x < truth.width(); x += 7) {
    truth.at(x, x % truth.height()) = kUnknown;
  }
  const ImageF decided = DecideBesideDepthEdges(Expose(view.left_grey, noise, 1),
                                                Expose(view.right_grey, noise, 2), truth);
  for (int y = 0; y < truth.height(); ++y) {
    for (int x = 0; x < truth.width(); ++x) {
      const float was = truth.at(x, y), is = decided.at(x, y);
      ASSERT_TRUE(is == was || (std::isnan(is) && std::isnan(was))) << x << ' ' << y;
    }
  }
}

TEST(DepthEdges, SmallPicturesAndUnknownOnesAreHarmless) {
  for (const int size : {1, 5, 9, 40}) {
    const ImageU8 grey(size, size, 100);
    const ImageF unknown(size, size, kUnknown);
    const ImageF decided = DecideBesideDepthEdges(grey, grey, unknown);
    for (const float value : decided.pixels()) {
      EXPECT_TRUE(std::isnan(value));
    }
  }
}

}  // namespace
}  // namespace palace
