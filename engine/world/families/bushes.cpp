// Heath: bushes and shrubs of small leaves through which the sandy ground is seen.
#include "engine/world/families/family.h"
#include "engine/world/families/plants.h"

namespace palace {

void DrawBushes(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material sand = DrawMaterial(random, GroundTexture::kSand, {1.5, 2.5}, {0.8, 1.6});
  sand.albedo = random.Uniform(0.42, 0.65);
  world.ground.material = sand;
  for (int i = 2 + random.Index(8); i > 0; --i) {
    const Eigen::Vector2d place = DrawPlace(random);
    const Blob blob(random, place, random.Uniform(1, 5), 0.35);
    Material litter = DrawMaterial(random, GroundTexture::kSoil, {1.1, 1.2}, {0.7, 1.3});
    litter.albedo = random.Uniform(0.25, 0.45);
    world.ground.patches.push_back(blob.Patch(litter));
  }
  const double rough_m = DrawLog(random, {0.006, 0.03});
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf(
      [=](double n, double e) { return rough_m * FractalNoise(n, e, seed, 5, 0.3, 0.9); }, 9);

  const double dense = random.Uniform(0.5, 1.6);  // leaves for a size
  for (const Eigen::Vector2d& place : DrawPlaces(random, 8 + random.Index(55), 1.1)) {
    Foliage foliage;
    foliage.radius_m = DrawLog(random, {0.15, 1.1});
    foliage.height_m = foliage.radius_m * random.Uniform(0.7, 1.8);
    foliage.foot_m = random.Uniform(0, 0.1);
    foliage.leaf_m = random.Uniform(0.04, 0.08) * (1 + foliage.radius_m);
    foliage.leaves = static_cast<int>(dense * (120 + 900 * foliage.radius_m));
    foliage.irregular = random.Uniform(0.2, 0.6);
    const bool sways = Chance(random, 0.1);
    Solid bush = PutOn(world.ground, MakeFoliage(random, foliage), place);
    if (sways) {
      bush.v_WO = {random.Uniform(-0.05, 0.05), random.Uniform(-0.05, 0.05), 0};
    }
    world.solids.push_back(bush);
  }
  for (const Eigen::Vector2d& place : DrawPlaces(random, 20 + random.Index(80), 0.6)) {
    const double radius_m = random.Uniform(0.05, 0.2), tall_m = random.Uniform(0.06, 0.3);
    world.solids.push_back(PutOn(world.ground, MakeTuft(random, radius_m, tall_m, 30), place));
  }
}

}  // namespace palace
