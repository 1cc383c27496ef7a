// A lawn and a path under trees and masts that stand outside of the picture, with some stones: hard
// shadows over good and bad ground alike, some of which move with what throws them.
#include <cmath>

#include "engine/core/units.h"
#include "engine/world/families/family.h"
#include "engine/world/families/plants.h"
#include "engine/world/families/stones.h"
#include "engine/world/families/things.h"

namespace palace {
namespace {

using Eigen::Vector2d;

/// Where a thing of that height stands so that its shadow ends at `place`.
Vector2d BehindTheSun(const Sun& sun, const Vector2d& place, double tall_m) {
  const double reach_m = tall_m / std::tan(sun.elevation_rad);
  return place + reach_m * Vector2d(std::cos(sun.azimuth_rad), std::sin(sun.azimuth_rad));
}

}  // namespace

void DrawShadows(World& world, RandomStream& random) {
  // From a side or from behind: trees there are out of the picture.
  const double side = Chance(random, 0.5) ? 1 : -1;
  world.sun.azimuth_rad = side * Rad(random.Uniform(70, 140));
  world.sun.elevation_rad = Rad(random.Uniform(18, 38));
  world.sun.direct = random.Uniform(0.9, 1.3);
  world.sun.diffuse = random.Uniform(0.15, 0.35);
  Material lawn = DrawMaterial(random, GroundTexture::kGrass, {0.4, 0.7}, {0.5, 1.1});
  lawn.albedo = random.Uniform(0.35, 0.55);
  world.ground.material = lawn;
  const Vector2d from = {-5, random.Uniform(-12, 12)};
  const Course path(random, from, random.Uniform(-0.4, 0.4), 55, 7, 1.5);
  Material gravel = DrawMaterial(random, GroundTexture::kGravel, {0.4, 0.7}, {0.5, 1});
  gravel.albedo = random.Uniform(0.5, 0.7);
  path.Paint(world.ground, random.Uniform(1, 2.4), gravel);
  const double rough_m = DrawLog(random, {0.003, 0.02});
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf(
      [=](double n, double e) { return rough_m * FractalNoise(n, e, seed, 8, 0.4, 0.9); }, 9);

  const StoneMaker stones;
  for (const Vector2d& place : DrawPlaces(random, random.Index(40), 0.8)) {
    const double longest_m = DrawPower(random, {0.15, 0.7}, 2), turn = DrawAngle(random);
    const Solid stone = stones.Make(random, longest_m, {.facets = 20, .dents = 0.02});
    world.solids.push_back(
        PutOn(world.ground, Painted(stone, random.Uniform(0.3, 0.55)), place, turn));
  }
  for (int i = 3 + random.Index(5); i > 0; --i) {
    const double tall_m = random.Uniform(5, 11);
    const Vector2d end = DrawPlace(random);
    const Vector2d place = BehindTheSun(world.sun, end, 0.8 * tall_m);
    if (std::abs(place.y()) < 13 && place.x() > 0) {
      continue;  // it would stand in the picture
    }
    if (Chance(random, 0.3)) {
      PutOn(world, {MakePost(0.2, tall_m, 0.4)}, place);
      continue;
    }
    const double crown_m = tall_m * random.Uniform(0.2, 0.35), leaf_m = random.Uniform(0.2, 0.4);
    const Tree tree{.height_m = tall_m, .crown_m = crown_m, .leaves = 1400, .leaf_m = leaf_m};
    std::vector<Solid> parts =
        Chance(random, 0.25) ? MakeConifer(random, tree) : MakeTree(random, tree);
    if (Chance(random, 0.5)) {  // the crown sways
      parts.back().v_WO = {random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3), 0};
    }
    PutOn(world, parts, place, DrawAngle(random));
  }
  if (Chance(random, 0.5)) {
    const double up_m = random.Uniform(9, 20);
    const Vector2d place = BehindTheSun(world.sun, DrawPlace(random), up_m);
    Solid bird = MakeBird(up_m, random.Uniform(0.6, 1.6));
    bird.v_WO = {8, -4 * side, 0};
    world.solids.push_back(PutOn(world.ground, bird, place));
  }
}

}  // namespace palace
