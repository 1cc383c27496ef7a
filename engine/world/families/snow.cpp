// Drifted snow: bright, of weak tones, with tracks, and what sticks out of it.
#include <cmath>
#include <numbers>

#include "engine/world/families/family.h"
#include "engine/world/families/plants.h"
#include "engine/world/families/stones.h"
#include "engine/world/families/things.h"

namespace palace {
namespace {

using Eigen::Vector2d;

struct Track {
  Course course;
  double width_m, depth_m, apart_m;  ///< two ruts, or one where apart is 0
};

}  // namespace

void DrawSnow(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material snow = DrawMaterial(random, GroundTexture::kSnow, {0.7, 1.6}, {0.4, 1.6});
  snow.albedo = random.Uniform(0.7, 0.88);
  world.ground.material = snow;
  world.ground.rise_north = random.Uniform(-0.08, 0.08);
  world.ground.rise_east = random.Uniform(-0.08, 0.08);
  std::vector<Track> tracks;
  for (int i = random.Index(4); i > 0; --i) {
    const Vector2d from = DrawPlace(random);
    const double heading = DrawAngle(random);
    const Course course(random, from, heading, random.Uniform(15, 45), 8, 1.2);
    const double width_m = random.Uniform(0.1, 0.4), depth_m = random.Uniform(0.02, 0.12);
    tracks.push_back({course, width_m, depth_m, Chance(random, 0.6) ? 1.5 : 0});
  }
  const double wind = DrawAngle(random), drift_m = DrawLog(random, {0.02, 0.15});
  const double longest_m = random.Uniform(3, 9), crust_m = random.Uniform(0.002, 0.01);
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf([=](double n, double e) {
    const double along = std::cos(wind) * n + std::sin(wind) * e;
    const double across = std::cos(wind) * e - std::sin(wind) * n;
    // Drifts are drawn out along the wind.
    double up_m = drift_m * FractalNoise(0.4 * along, across, seed, longest_m, 1, 1) +
                  crust_m * FractalNoise(0.5 * along, across, seed + 40, 0.8, 0.15, 0.6);
    for (const Track& track : tracks) {
      const double off_m = std::abs(track.course.Distance(n, e) - track.apart_m / 2);
      up_m -= track.depth_m * WallShare(track.width_m / 2 - off_m, 0.1);
    }
    return up_m;
  });
  const StoneMaker stones;
  for (const Vector2d& place : DrawPlaces(random, random.Index(25), 1.2)) {
    const double longest_m2 = DrawPower(random, {0.2, 1}, 1.8), turn = DrawAngle(random);
    const Solid stone = stones.Make(random, longest_m2, {.facets = 30, .sunk = {0.3, 0.8}});
    world.solids.push_back(
        PutOn(world.ground, Painted(stone, random.Uniform(0.15, 0.4)), place, turn));
  }
  for (const Vector2d& place : DrawPlaces(random, random.Index(14), 1)) {
    const double tall_m = random.Uniform(0.1, 0.5);
    world.solids.push_back(PutOn(world.ground, MakeTuft(random, 0.1, tall_m, 20), place));
  }
  for (const Vector2d& place : DrawPlaces(random, random.Index(6), 4)) {
    const double tall_m = random.Uniform(1.2, 4), crown_m = 0.3 * tall_m;
    PutOn(world,
          MakeConifer(random, {.height_m = tall_m,
                               .crown_m = crown_m,
                               .trunk_m = 0.03 * tall_m,
                               .leaves = 900,
                               .leaf_m = 0.07 * tall_m}),
          place, DrawAngle(random));
  }
  if (Chance(random, 0.4)) {
    const Vector2d from = DrawPlace(random), to = DrawPlace(random);
    AddFence(world, from, to,
             {.spacing_m = 2.5, .thick_m = 0.12, .tall_m = random.Uniform(0.2, 0.6), .wires = 1});
  }
}

}  // namespace palace
