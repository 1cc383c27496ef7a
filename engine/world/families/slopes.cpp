// Pasture of up to 20 degrees: even slopes, ridges across them, terraces with low walls of earth.
#include <algorithm>
#include <cmath>

#include "engine/core/units.h"
#include "engine/world/families/drawing.h"
#include "engine/world/families/family.h"
#include "engine/world/families/plants.h"

namespace palace {
namespace {

double Ridge(double across_m, double apart_m, double high_m, double sharp) {
  const double phase = across_m / apart_m - FastFloor(across_m / apart_m);
  return high_m * std::pow(1 - std::abs(2 * phase - 1), sharp);
}

/// The slope becomes flat treads with steep risers between them.
double Terraces(double up_m, double step_m, double riser) {
  const double level = FastFloor(up_m / step_m), within = up_m / step_m - level;
  return step_m * (level + std::clamp((within - (1 - riser)) / riser, 0.0, 1.0)) - up_m;
}

}  // namespace

void DrawSlopes(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  world.ground.material = DrawMaterial(random, GroundTexture::kGrass, {1.5, 2.5}, {0.4, 1.1});
  world.ground.material->albedo = random.Uniform(0.28, 0.5);
  const double slope = std::tan(Rad(20 * std::pow(random.Uniform(), 1.4)));
  const double aspect = DrawAngle(random);
  world.ground.rise_north = slope * std::cos(aspect);
  world.ground.rise_east = slope * std::sin(aspect);
  const int kind = random.Index(3);
  const double course = DrawAngle(random), apart_m = random.Uniform(6, 16);
  const double high_m = random.Uniform(0.15, 0.5) * apart_m * 0.25;
  const double sharp = random.Uniform(1, 2.5), tread_m = random.Uniform(3.5, 9);
  const double riser = random.Uniform(0.05, 0.2), rough_m = DrawLog(random, {0.005, 0.03});
  const std::uint64_t seed = random.NextBits();
  const double rise_north = world.ground.rise_north, rise_east = world.ground.rise_east;
  world.ground.relief = ReliefOf(
      [=](double n, double e) {
        const double small = rough_m * FractalNoise(n, e, seed, 3, 0.3, 0.8);
        const double broad = FractalNoise(n, e, seed + 50, 20, 5, 1);
        if (kind == 1) {
          const double across = std::cos(course) * n + std::sin(course) * e + 0.6 * broad;
          return small + Ridge(across, apart_m, high_m, sharp);
        }
        if (kind == 2 && slope > 0.03) {
          const double up_m = rise_north * n + rise_east * e;
          return small + Terraces(up_m + 0.1 * broad, slope * tread_m, riser) + 0.05 * broad;
        }
        return small + 0.12 * broad;
      },
      9);
  for (const Eigen::Vector2d& place : DrawPlaces(random, 10 + random.Index(50), 1)) {
    const double radius_m = random.Uniform(0.06, 0.18), tall_m = random.Uniform(0.05, 0.14);
    world.solids.push_back(PutOn(world.ground, MakeTuft(random, radius_m, tall_m, 24), place));
  }
}

}  // namespace palace
