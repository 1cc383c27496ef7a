// Rough gravel ground, a fractal of 2 to 10 cm rms, with smooth pads in it.
#include <algorithm>

#include "engine/world/families/drawing.h"
#include "engine/world/families/family.h"

namespace palace {

void DrawRough(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material gravel = DrawMaterial(random, GroundTexture::kGravel, {0.8, 1.6}, {0.4, 1.2});
  gravel.albedo = random.Uniform(0.32, 0.58);
  world.ground.material = gravel;
  world.ground.rise_north = random.Uniform(-0.06, 0.06);
  world.ground.rise_east = random.Uniform(-0.06, 0.06);
  std::vector<Blob> pads;
  for (int i = 1 + random.Index(5); i > 0; --i) {
    const Eigen::Vector2d place = {random.Uniform(6, 38), random.Uniform(-12, 12)};
    pads.emplace_back(random, place, random.Uniform(2.2, 5.5), 0.2);
    Material swept = gravel;
    swept.seed = random.NextBits();
    swept.albedo = gravel.albedo * random.Uniform(0.9, 1.1);
    world.ground.patches.push_back(pads.back().Patch(swept));
  }
  const double rms_m = DrawLog(random, {0.02, 0.10}), rim_m = random.Uniform(0.2, 1.0);
  const double longest_m = random.Uniform(1.2, 5), hurst = random.Uniform(0.5, 0.95);
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf([=](double n, double e) {
    double inside_m = -rim_m;
    for (const Blob& pad : pads) {
      inside_m = std::max(inside_m, pad.Inside(n, e));
    }
    const double share = 1 - 0.94 * std::clamp(1 + inside_m / rim_m, 0.0, 1.0);
    return rms_m * share * FractalNoise(n, e, seed, longest_m, 0.15, hurst);
  });
}

}  // namespace palace
