// No safe place: scree with holes, a slope that is too steep, flooded ground, or a thicket, each
// without a gap that a disc fits into.
#include <cmath>
#include <memory>

#include "engine/core/units.h"
#include "engine/world/families/family.h"
#include "engine/world/families/hazard_lattice.h"
#include "engine/world/families/plants.h"
#include "engine/world/families/stones.h"

namespace palace {
namespace {

void DrawScree(World& world, RandomStream& random) {
  const double share = random.Uniform(0, 0.45);
  MoundsAndStones drawn = DrawHazards(
      random, HazardLattice(random), share,
      [](const Eigen::Vector2d& place) { return place.x() > 1 && std::abs(place.y()) < 22; });
  const MoundField field(std::move(drawn.mounds));
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf([&](double n, double e) {
    return field.Height(n, e) + 0.015 * FractalNoise(n, e, seed, 4, 0.3, 0.8);
  });
  const StoneMaker stones;
  for (const Eigen::Vector2d& place : drawn.stones_at) {
    const double longest_m = random.Uniform(0.45, 0.8), turn = DrawAngle(random);
    const Solid stone =
        stones.Make(random, longest_m, {.flatness = {0.65, 0.9}, .facets = 9, .sunk = {0.1, 0.2}});
    world.solids.push_back(
        PutOn(world.ground, Painted(stone, random.Uniform(0.3, 0.5)), place, turn));
  }
}

void DrawSteep(World& world, RandomStream& random) {
  const double slope = std::tan(Rad(random.Uniform(15, 24))), aspect = DrawAngle(random);
  world.ground.rise_north = slope * std::cos(aspect);
  world.ground.rise_east = slope * std::sin(aspect);
  const double rough_m = random.Uniform(0.005, 0.03);
  const std::uint64_t seed = random.NextBits();
  // Long waves stay weak: nowhere may they level the slope.
  world.ground.relief = ReliefOf(
      [=](double n, double e) { return rough_m * FractalNoise(n, e, seed, 3, 0.3, 0.8); }, 9);
}

/// Water with islands smaller than a lander.
void DrawFlood(World& world, RandomStream& random) {
  Material water = DrawMaterial(random, GroundTexture::kWater, {0.7, 1.6}, {0.5, 2});
  water.albedo = random.Uniform(0.15, 0.5);
  const Material dry = *world.ground.material;
  world.ground.material = water;
  std::vector<Blob> islands;
  for (const Eigen::Vector2d& place : DrawPlaces(random, 10 + random.Index(30), 3)) {
    islands.emplace_back(random, place, random.Uniform(0.3, 1.2), 0.2);
    world.ground.patches.push_back(islands.back().Patch(dry));
  }
  world.ground.relief = ReliefOf([&](double n, double e) {
    double up_m = 0;
    for (const Blob& island : islands) {
      up_m = std::max(up_m, 0.12 * WallShare(island.Inside(n, e) - 0.25, 0.5));
    }
    return up_m;
  });
}

void DrawThicket(World& world, RandomStream& random) {
  std::vector<Mound> far;
  for (const Eigen::Vector2d& place : HazardLattice(random)) {
    if (place.x() < -1 || place.x() > 47 || std::abs(place.y()) > 24) {
      far.push_back(DrawMound(random, place));
      continue;
    }
    const double radius_m = random.Uniform(0.25, 0.6), height_m = random.Uniform(0.4, 0.9);
    const Foliage foliage{.radius_m = radius_m, .height_m = height_m, .leaf_m = 0.12, .leaves = 90};
    // With a stem, for leaves alone may leave a gap where the truth looks.
    world.solids.push_back(PutOn(world.ground, MakeFoliage(random, foliage), place));
    world.solids.push_back(PutOn(world.ground, Painted({Box{0.06, 0.06, 0.3}}, 0.2), place));
  }
  const MoundField field(std::move(far));
  world.ground.relief = ReliefOf([&](double n, double e) { return field.Height(n, e); });
}

}  // namespace

void DrawNowhere(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material ground = DrawMaterial(random, GroundTexture::kGravel, {2.8, 4.2}, {0.5, 1.2});
  ground.albedo = random.Uniform(0.3, 0.55);
  world.ground.material = ground;
  switch (random.Index(4)) {
    case 0:
      return DrawScree(world, random);
    case 1:
      return DrawSteep(world, random);
    case 2:
      return DrawFlood(world, random);
    default:
      return DrawThicket(world, random);
  }
}

}  // namespace palace
