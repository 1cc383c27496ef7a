// The lit ground: tiles worked out on demand hold what a plain loop over all texels gives.
#include "engine/world/ground_picture.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>
#include <opencv2/core/utility.hpp>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/world/lattice_noise.h"

namespace palace {
namespace {

using Eigen::Vector3d;

World Meadow(bool relief) {
  World world;
  world.ground.material = Material{GroundTexture::kSoil, 3, NAN, 1, 1, 0.3};
  world.ground.patches = {StripPatch({-4, -3}, {12, 3}, 0.6, {GroundTexture::kPaint, 5}),
                          DiscPatch(2, 1, 3, {GroundTexture::kGravel, 8}),
                          DiscPatch(3, 0, 0.7, {GroundTexture::kWater, 9})};
  world.ground.rise_north = 0.04;
  world.ground.rise_east = -0.02;
  if (relief) {
    world.ground.relief = std::make_shared<const HeightField>(
        HeightField::Place{-8, -8, 24, 7},
        [](double n, double e) { return 0.2 * FractalNoise(n, e, 11, 6, 0.5, 0.8); });
  }
  world.sun.elevation_rad = Rad(12);
  return world;
}

bool Lit(const Vector3d& p_W) { return FractalNoise(p_W.x(), p_W.y(), 4, 2, 0.5, 0.8) > -0.5; }

/// The header's equation, a texel at a time.
std::uint8_t Plain(const World& world, int side, int x, int y) {
  const GroundSquare square = SquareOf(world.ground);
  const double per_texel = side / square.size_m;
  const double north = square.north_m + (y + 0.5) / per_texel;
  const double east = square.east_m + (x + 0.5) / per_texel;
  const Ground& ground = world.ground;
  const Vector3d normal = ground.NormalAt(north, east);
  const double normal_dot_sun = normal.dot(world.sun.Direction());
  const bool lit = normal_dot_sun > 0 &&
                   Lit(Vector3d(north, east, -ground.Height(north, east)) + 0.004 * normal);
  MaterialPainter painter(ground.MaterialAt(north, east));
  const double grey = 255 * painter.Albedo(north, east) *
                      (world.sun.diffuse + world.sun.direct * (lit ? normal_dot_sun : 0));
  return static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
}

TEST(GroundPicture, TilesHoldWhatAPlainLoopGives) {
  for (const bool relief : {false, true}) {
    const World world = Meadow(relief);
    const GroundPicture picture(world, 0.055, Lit);
    const ImageU8 texels = picture.Texels();
    const int side = texels.width();
    RandomStream random(6);
    for (int i = 0; i < 4000; ++i) {
      const int x = random.Index(side), y = random.Index(side);
      ASSERT_EQ(texels.at(x, y), Plain(world, side, x, y)) << x << " " << y;
    }
  }
}

TEST(GroundPicture, IsTheSameInWhateverOrderItIsAsked) {
  const World world = Meadow(true);
  const GroundPicture whole(world, 0.055, Lit), asked(world, 0.055, Lit);
  const ImageU8 texels = whole.Texels();
  const auto ask = [&](const cv::Range& places) {
    for (int i = places.start; i < places.end; ++i) {
      RandomStream random(static_cast<std::uint64_t>(i));
      // The square and its mirror images.
      const double north = random.Uniform(-40, 40), east = random.Uniform(-40, 40);
      ASSERT_EQ(asked.Grey(north, east), whole.Grey(north, east)) << north << " " << east;
    }
  };
  cv::parallel_for_(cv::Range(0, 3000), ask);
  EXPECT_EQ(asked.Texels().pixels(), texels.pixels());
}

}  // namespace
}  // namespace palace
