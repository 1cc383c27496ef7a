// After rain: pools, mud (water with soil in it) and wet asphalt, which is ground.
#include <algorithm>

#include "engine/world/families/family.h"
#include "engine/world/families/plants.h"

namespace palace {

void DrawWater(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material soil = DrawMaterial(random, GroundTexture::kSoil, {0.4, 0.68}, {0.5, 1.2});
  soil.albedo = random.Uniform(0.28, 0.48);
  world.ground.material = soil;
  if (Chance(random, 0.6)) {  // a road through it, wet in places
    const Eigen::Vector2d from = {-5, random.Uniform(-10, 10)};
    const Course road(random, from, random.Uniform(-0.3, 0.3), 56, 3, 0.5);
    Material asphalt = DrawMaterial(random, GroundTexture::kAsphalt, {1.35, 1.4}, {0.5, 1});
    asphalt.albedo = random.Uniform(0.3, 0.4);
    road.Paint(world.ground, random.Uniform(3.5, 5.5), asphalt);
    Material wet = asphalt;
    wet.albedo = 0.45 * asphalt.albedo;
    wet.contrast = 0.6;
    for (int i = 2 + random.Index(5); i > 0; --i) {
      const double along = random.Uniform(0.1, 0.9);
      const Eigen::Vector2d place =
          (1 - along) * road.corners_m().front() + along * road.corners_m().back();
      const Blob blob(random, place, random.Uniform(0.6, 1.7), 0.3);
      world.ground.patches.push_back(blob.Patch(wet));
    }
  }
  std::vector<Blob> pools;
  Material water = DrawMaterial(random, GroundTexture::kWater, {0.8, 1.5}, {0.5, 2});
  water.albedo = random.Uniform(0.12, 0.6);  // of what the sky shows in it
  Material mud = DrawMaterial(random, GroundTexture::kWater, {0.1, 0.3}, {1.5, 4});
  mud.albedo = soil.albedo * random.Uniform(0.5, 0.8);
  for (const Eigen::Vector2d& place : DrawPlaces(random, 3 + random.Index(14), 2)) {
    const double radius_m = DrawLog(random, {0.35, 4.5});
    pools.emplace_back(random, place, radius_m, 0.35);
    Material damp = soil;
    damp.albedo = 0.65 * soil.albedo;
    const Blob& pool = pools.back();
    world.ground.patches.push_back(pool.Widened(random.Uniform(0.1, 0.5)).Patch(damp));
    world.ground.patches.push_back(pool.Patch(Chance(random, 0.3) ? mud : water));
  }
  const double depth_m = random.Uniform(0.02, 0.08), rough_m = DrawLog(random, {0.004, 0.02});
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf([=](double n, double e) {
    double inside_m = -1;
    for (const Blob& pool : pools) {
      inside_m = std::max(inside_m, pool.Inside(n, e));
    }
    const double dry = std::clamp(-inside_m / 0.4, 0.0, 1.0);  // the bank
    return dry * (rough_m * FractalNoise(n, e, seed, 8, 0.3, 0.9)) - (1 - dry) * depth_m;
  });
  for (const Eigen::Vector2d& place : DrawPlaces(random, 10 + random.Index(40), 0.8)) {
    const double radius_m = random.Uniform(0.06, 0.2), tall_m = random.Uniform(0.08, 0.35);
    world.solids.push_back(PutOn(world.ground, MakeTuft(random, radius_m, tall_m, 26), place));
  }
}

}  // namespace palace
