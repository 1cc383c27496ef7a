// Exactly one safe place: a clearing among mounds, holes and rocks that leave no other gap.
#include <cmath>
#include <numbers>

#include "engine/world/families/family.h"
#include "engine/world/families/hazard_lattice.h"
#include "engine/world/families/stones.h"

namespace palace {

void DrawOne(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material ground = DrawMaterial(random, GroundTexture::kSoil, {3.3, 4.4}, {0.6, 1.3});
  ground.albedo = random.Uniform(0.3, 0.5);
  world.ground.material = ground;

  const Eigen::Vector2d middle = {random.Uniform(9, 30), random.Uniform(-8, 8)};
  const double clear_m = random.Uniform(3.1, 3.9);
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& place : HazardLattice(random)) {
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
  std::vector<Mound> mounds;
  std::vector<Eigen::Vector2d> stones_at;
  const double share = random.Uniform(0.1, 0.45);
  for (const Eigen::Vector2d& place : places) {
    const bool seen = place.x() > 1 && place.x() < 47 && std::abs(place.y()) < 22;
    if (seen && Chance(random, share)) {
      stones_at.push_back(place);
    } else {
      mounds.push_back(DrawMound(random, place));
    }
  }
  const MoundField field(std::move(mounds));
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf([&](double n, double e) {
    return field.Height(n, e) + 0.006 * FractalNoise(n, e, seed, 5, 0.4, 0.9);
  });
  const StoneMaker stones;
  for (const Eigen::Vector2d& place : stones_at) {
    const double longest_m = random.Uniform(0.45, 0.75), turn = DrawAngle(random);
    const Solid stone = stones.Make(random, longest_m,
                                    {.flatness = {0.65, 0.95}, .facets = 24, .sunk = {0.1, 0.2}});
    world.solids.push_back(
        PutOn(world.ground, Painted(stone, random.Uniform(0.25, 0.45)), place, turn));
  }
}

}  // namespace palace
