// Thin things on a gravel yard: posts of 5 to 10 cm, pegs, stumps, fences with wires, guyed masts.
#include "engine/world/families/family.h"
#include "engine/world/families/things.h"

namespace palace {

void DrawPosts(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material yard = DrawMaterial(random, GroundTexture::kGravel, {1.8, 2.6}, {0.4, 1.0});
  yard.albedo = random.Uniform(0.35, 0.6);
  world.ground.material = yard;
  for (int i = random.Index(3); i > 0; --i) {
    const Eigen::Vector2d from = {random.Uniform(-4, 4), random.Uniform(-15, 15)};
    const Course track(random, from, random.Uniform(-0.5, 0.5), 48, 6, 1.5);
    Material worn = DrawMaterial(random, GroundTexture::kSoil, {2.2, 3}, {0.4, 0.9});
    worn.albedo = yard.albedo * random.Uniform(0.7, 1);
    track.Paint(world.ground, random.Uniform(0.8, 2.2), worn);
  }
  const double rough_m = DrawLog(random, {0.004, 0.025});
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf(
      [=](double n, double e) { return rough_m * FractalNoise(n, e, seed, 7, 0.4, 0.9); }, 9);

  const double tall_m = random.Uniform(0.7, 1.4);
  for (const Eigen::Vector2d& place : DrawPlaces(random, 4 + random.Index(30), 1.5)) {
    const double thick_m = random.Uniform(0.05, 0.10), high_m = tall_m * random.Uniform(0.8, 1.1);
    world.solids.push_back(
        PutOn(world.ground, MakePost(thick_m, high_m, random.Uniform(0.1, 0.8)), place));
  }
  for (const Eigen::Vector2d& place : DrawPlaces(random, random.Index(25), 0.8)) {
    const double thick_m = random.Uniform(0.015, 0.04), high_m = random.Uniform(0.15, 0.35);
    world.solids.push_back(
        PutOn(world.ground, MakePost(thick_m, high_m, random.Uniform(0.1, 0.8)), place));
  }
  for (const Eigen::Vector2d& place : DrawPlaces(random, random.Index(8), 2)) {
    const double thick_m = random.Uniform(0.2, 0.6), high_m = random.Uniform(0.12, 0.5);
    world.solids.push_back(
        PutOn(world.ground, MakePost(thick_m, high_m, random.Uniform(0.25, 0.5)), place));
  }
  for (int i = random.Index(4); i > 0; --i) {
    const Eigen::Vector2d from = DrawPlace(random), to = DrawPlace(random);
    const double thick_m = random.Uniform(0.05, 0.1), spacing_m = random.Uniform(2, 4);
    AddFence(world, from, to,
             {.spacing_m = spacing_m,
              .thick_m = thick_m,
              .tall_m = random.Uniform(0.8, 1.4),
              .wires = 1 + random.Index(4),
              .wire_m = random.Uniform(0.002, 0.008),
              .albedo = random.Uniform(0.15, 0.6)});
  }
  for (const Eigen::Vector2d& place : DrawPlaces(random, random.Index(3), 8)) {
    const double high_m = random.Uniform(3, 7), thick_m = random.Uniform(0.04, 0.09);
    AddGuyedMast(world, random, place, high_m, thick_m, random.Uniform(0.004, 0.012));
  }
}

}  // namespace palace
