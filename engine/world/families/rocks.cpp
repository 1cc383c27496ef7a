// Rocks on bare soil: N(> d) falls as a power of d, at densities from a few to a field of them.
#include "engine/world/families/family.h"
#include "engine/world/families/stones.h"

namespace palace {

void DrawRocks(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material soil = DrawMaterial(random, GroundTexture::kSoil, {1.2, 2}, {0.5, 1.3});
  soil.albedo = random.Uniform(0.3, 0.55);
  world.ground.material = soil;
  for (int i = random.Index(5); i > 0; --i) {
    const Eigen::Vector2d place = DrawPlace(random);
    const Blob blob(random, place, random.Uniform(1.5, 6), 0.3);
    Material other = DrawMaterial(random, GroundTexture::kSoil, {0.7, 1}, {0.4, 1.2});
    other.albedo = soil.albedo * random.Uniform(0.8, 1.2);
    world.ground.patches.push_back(blob.Patch(other));
  }
  const double swell_m = DrawLog(random, {0.01, 0.08});
  const std::uint64_t swell_seed = random.NextBits();
  world.ground.relief = ReliefOf(
      [=](double n, double e) { return swell_m * FractalNoise(n, e, swell_seed, 12, 0.4, 1); }, 9);

  const double per_m2 = DrawLog(random, {0.02, 0.7}), exponent = random.Uniform(1.5, 2.6);
  const StoneKind kind{.flatness = {0.35, random.Uniform(0.6, 1.0)},
                       .facets = 6 + random.Index(14),
                       .dents = random.Uniform(0.01, 0.08)};
  const double tone = random.Uniform(0.6, 1.2) * soil.albedo;
  const StoneMaker stones;
  for (const Eigen::Vector2d& place :
       DrawPlaces(random, static_cast<int>(per_m2 * 42 * 40), 0.15)) {
    const double longest_m = DrawPower(random, {0.08, 1.2}, exponent);
    const double turn = DrawAngle(random);
    Solid stone = stones.Make(random, longest_m, kind);
    stone.albedo = tone * random.Uniform(0.75, 1.3);
    world.solids.push_back(PutOn(world.ground, stone, place, turn));
  }
}

}  // namespace palace
