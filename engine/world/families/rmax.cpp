// A dry field as an RMAX sees it from 150 ft with the camera 35 degrees down: 40 to 130 m ahead,
// with boxes, rocks, vehicles and a tree line. Wider and coarser than the other families.
#include <cmath>

#include "engine/world/families/family.h"
#include "engine/world/families/plants.h"
#include "engine/world/families/stones.h"
#include "engine/world/families/things.h"

namespace palace {
namespace {

using Eigen::Vector2d;

Vector2d DrawFarPlace(RandomStream& random) {
  const double north_m = random.Uniform(20, 120);
  return {north_m, random.Uniform(-0.42, 0.42) * (25 + north_m)};
}

}  // namespace

void DrawRmax(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material grass = DrawMaterial(random, GroundTexture::kGrass, {3, 5}, {0.4, 1});
  grass.albedo = random.Uniform(0.35, 0.55);
  world.ground.material = grass;
  for (int i = 6 + random.Index(14); i > 0; --i) {
    const Vector2d place = DrawFarPlace(random);
    const Blob blob(random, place, random.Uniform(2, 12), 0.35);
    Material bare = DrawMaterial(random, GroundTexture::kSoil, {3.2, 4.5}, {0.4, 1});
    bare.albedo = grass.albedo * random.Uniform(0.75, 1.25);
    world.ground.patches.push_back(blob.Patch(bare));
  }
  if (Chance(random, 0.6)) {
    const Vector2d from = {20, random.Uniform(-25, 25)};
    const Course track(random, from, random.Uniform(-0.6, 0.6), 120, 10, 2.5);
    Material dirt = DrawMaterial(random, GroundTexture::kSand, {2.6, 3.5}, {0.6, 1});
    dirt.albedo = grass.albedo * 1.2;
    track.Paint(world.ground, random.Uniform(2.2, 3.5), dirt);
  }
  const double swell_m = random.Uniform(0.1, 0.6), rough_m = random.Uniform(0.01, 0.05);
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf(
      [=](double n, double e) {
        return swell_m * FractalNoise(n, e, seed, 40, 8, 1) +
               rough_m * FractalNoise(n, e, seed + 30, 5, 0.4, 0.8);
      },
      10, 128, 60);

  for (int i = 4 + random.Index(16); i > 0; --i) {
    const Vector2d place = DrawFarPlace(random);
    const double size_m = random.Uniform(0.6, 2.4), tall_m = random.Uniform(0.4, 1.8);
    const Solid box =
        Painted({Box{size_m, size_m * random.Uniform(0.5, 1), tall_m}}, random.Uniform(0.15, 0.8));
    world.solids.push_back(PutOn(world.ground, box, place, DrawAngle(random)));
  }
  const StoneMaker stones;
  for (int i = random.Index(60); i > 0; --i) {
    const Vector2d place = DrawFarPlace(random);
    const Solid stone = stones.Make(random, DrawPower(random, {0.4, 2.5}, 1.6), {.facets = 14});
    world.solids.push_back(PutOn(world.ground, Painted(stone, random.Uniform(0.2, 0.5)), place, 0));
  }
  for (int i = random.Index(3); i > 0; --i) {
    const Vector2d place = DrawFarPlace(random);
    PutOn(world, Chance(random, 0.5) ? MakeVan(random) : MakeCar(random), place,
          random.Uniform(0, 6.28));
  }
  const double line_m = random.Uniform(70, 125), bend = random.Uniform(-0.5, 0.5);
  for (double east = -50; east < 50; east += random.Uniform(4, 9)) {
    const Vector2d place = {line_m + bend * east + random.Uniform(-2, 2), east};
    const double tall_m = random.Uniform(4, 11), crown_m = tall_m * random.Uniform(0.2, 0.4);
    const std::vector<Solid> tree = MakeTree(
        random, {.height_m = tall_m, .crown_m = crown_m, .leaves = 700, .leaf_m = 0.05 * tall_m});
    PutOn(world, tree, place, DrawAngle(random));
  }
  if (Chance(random, 0.4)) {
    std::vector<Solid> walker = MakeWalker(random);
    SetVelocity(walker, {random.Uniform(-1.4, 1.4), random.Uniform(-1.4, 1.4), 0});
    PutOn(world, walker, DrawFarPlace(random));
  }
}

}  // namespace palace
