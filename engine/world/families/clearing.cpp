// Exactly one safe place: a clearing among mounds, holes and rocks that leave no other gap.
#include "engine/world/families/clearing.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "engine/world/families/family.h"
#include "engine/world/families/hazard_lattice.h"
#include "engine/world/families/stones.h"

namespace palace {

void DrawClearing(World& world, RandomStream& random, const ClearingPlan& plan) {
  world.sun = DrawSun(random);
  Material ground = DrawMaterial(random, GroundTexture::kSoil, {3.3, 4.4}, {0.6, 1.3});
  ground.albedo = random.Uniform(0.3, 0.5);
  world.ground.material = ground;

  const Eigen::Vector2d middle = {random.Uniform(plan.north_m.low, plan.north_m.high),
                                  random.Uniform(plan.east_m.low, plan.east_m.high)};
  const double clear_m = random.Uniform(3.1, 3.9);
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& place : HazardLattice(random, plan.lattice_m, plan.half_m)) {
    if ((place - middle).norm() > clear_m + 0.9) {
      places.push_back(place);
    }
  }
  // The rim itself, so that the clearing is a disc.
  const int around = static_cast<int>(2 * std::numbers::pi * clear_m / 1.2);
  for (int i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * i / around;
    const double away_m = clear_m + 0.5 + random.Uniform(-0.08, 0.08);
    places.push_back(middle + away_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  const double share = random.Uniform(plan.stones.low, plan.stones.high);
  const auto may_be_stone = [&](const Eigen::Vector2d& place) {
    return place.x() > plan.stones_low_m.x() && place.x() < plan.stones_high_m.x() &&
           place.y() > plan.stones_low_m.y() && place.y() < plan.stones_high_m.y();
  };
  MoundsAndStones drawn = DrawHazards(random, places, share, may_be_stone);
  const MoundField field(std::move(drawn.mounds));
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf(
      [&](double n, double e) {
        return field.Height(n, e) + 0.006 * FractalNoise(n, e, seed, 5, 0.4, 0.9);
      },
      plan.relief_levels, plan.relief_m, plan.relief_north_m);
  const StoneMaker stones;
  for (const Eigen::Vector2d& place : drawn.stones_at) {
    const double longest_m = random.Uniform(0.45, 0.75), turn = DrawAngle(random);
    const Solid stone = stones.Make(random, longest_m,
                                    {.flatness = {0.65, 0.95}, .facets = 24, .sunk = {0.1, 0.2}});
    world.solids.push_back(
        PutOn(world.ground, Painted(stone, random.Uniform(0.25, 0.45)), place, turn));
  }
}

void DrawOne(World& world, RandomStream& random) {
  DrawClearing(world, random,
               {.north_m = {9, 30},
                .east_m = {-8, 8},
                .lattice_m = {16, 0},
                .half_m = 33,
                .stones_low_m = {1, -22},
                .stones_high_m = {47, 22},
                .stones = {0.1, 0.45},
                .relief_levels = 10,
                .relief_m = 64,
                .relief_north_m = 16});
}

World MakeSearchedGround(std::uint64_t seed) {
  constexpr double kRim_m = 6, kBeyond_m = 4;
  constexpr double kInside_m = kSearchedHalf_m - kRim_m, kHazards_m = kSearchedHalf_m + kBeyond_m;
  RandomStream random(seed, "search");
  World world;
  world.name = "search";
  DrawClearing(world, random,
               {.north_m = {-kInside_m, kInside_m},
                .east_m = {-kInside_m, kInside_m},
                .lattice_m = {0, 0},
                .half_m = kHazards_m,
                .stones_low_m = {-kHazards_m, -kHazards_m},
                .stones_high_m = {kHazards_m, kHazards_m},
                .stones = {0.02, 0.1},
                .relief_levels = 11,
                .relief_m = 96,
                .relief_north_m = 0});
  return world;
}

}  // namespace palace
