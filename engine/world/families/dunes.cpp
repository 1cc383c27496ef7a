// Sand of hardly any texture: gentle dunes with slip faces on their lee side, ripples on all.
#include <cmath>
#include <numbers>

#include "engine/core/units.h"
#include "engine/world/families/drawing.h"
#include "engine/world/families/family.h"

namespace palace {
namespace {

/// A long windward slope and a short lee, the height of one dune from foot to foot.
double Dune(double phase, double crest) {
  return phase < crest ? 0.5 - 0.5 * std::cos(std::numbers::pi * phase / crest)
                       : (1 - phase) / (1 - crest);
}

}  // namespace

void DrawDunes(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material sand = DrawMaterial(random, GroundTexture::kSand, {0.6, 1.2}, {0.25, 0.8});
  sand.albedo = random.Uniform(0.5, 0.75);
  const double wind = DrawAngle(random);
  sand.turn_rad = wind + random.Uniform(-0.3, 0.3);
  world.ground.material = sand;
  const double apart_m = random.Uniform(7, 18), high_m = apart_m * random.Uniform(0.03, 0.09);
  // A slip face lies at the angle of repose or a little below.
  const double lee = high_m / std::tan(Rad(random.Uniform(20, 33))) / apart_m;
  const double crest = 1 - std::min(0.4, lee), wander_m = random.Uniform(0.5, 3);
  const double ripple_m = random.Uniform(0.002, 0.012), ripple_apart_m = random.Uniform(0.2, 0.4);
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf([=](double n, double e) {
    const double along = std::cos(wind) * n + std::sin(wind) * e;
    const double place = (along + wander_m * FractalNoise(n, e, seed, 14, 6, 1)) / apart_m;
    const double tall = 0.7 + 0.25 * FractalNoise(n, e, seed + 9, 25, 10, 1);
    const double bend = 0.12 * SmoothNoise(n / 1.5, e / 1.5, seed + 20);
    return high_m * tall * Dune(place - FastFloor(place), crest) +
           ripple_m * std::sin(2 * std::numbers::pi * (along + bend) / ripple_apart_m);
  });
}

}  // namespace palace
