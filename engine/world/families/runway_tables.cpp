// The runway of Hintze 2004 (figure 4.9): asphalt with its lines, folding tables and road cones.
#include <cmath>
#include <numbers>

#include "engine/world/families/drawing.h"
#include "engine/world/families/family.h"

namespace palace {
namespace {

using Eigen::Vector2d;

void PaintRunway(Ground& ground, RandomStream& random, double heading, double middle_m) {
  const Vector2d along(std::cos(heading), std::sin(heading)), across(-along.y(), along.x());
  Material paint = DrawMaterial(random, GroundTexture::kPaint, {0.9, 1.6}, {0.6, 1});
  paint.albedo = random.Uniform(0.65, 0.88);
  const double width_m = random.Uniform(14, 20), line_m = random.Uniform(0.3, 0.9);
  for (const double side : {-1.0, 1.0}) {
    const Vector2d at = (middle_m + side * width_m / 2) * across;
    ground.patches.push_back(StripPatch(at - 20 * along, at + 70 * along, line_m, paint));
  }
  const double dash_m = random.Uniform(5, 12), gap_m = random.Uniform(4, 10);
  for (double north = random.Uniform(-20, -8); north < 60; north += dash_m + gap_m) {
    const Vector2d at = middle_m * across + north * along;
    ground.patches.push_back(StripPatch(at, at + dash_m * along, line_m, paint));
  }
}

}  // namespace

void DrawRunway(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material asphalt = DrawMaterial(random, GroundTexture::kAsphalt, {1.6, 2.2}, {0.5, 1.3});
  asphalt.albedo = random.Uniform(0.25, 0.48);
  world.ground.material = asphalt;
  const double heading = random.Uniform(-0.5, 0.5);
  PaintRunway(world.ground, random, heading, random.Uniform(-5, 5));
  world.ground.rise_north = random.Uniform(-0.015, 0.015);
  world.ground.rise_east = random.Uniform(-0.015, 0.015);
  const int tables = 3 + random.Index(9), cones = 4 + random.Index(14);
  int number = 0;
  for (const Vector2d& place : DrawPlaces(random, tables + cones, 1.6)) {
    if (number++ < tables) {
      const double size_x_m = random.Uniform(1.4, 1.9), size_y_m = random.Uniform(0.7, 0.85);
      const Solid table = {Table{size_x_m, size_y_m, random.Uniform(0.7, 0.78)}};
      const double albedo = random.Uniform(0.2, 0.85);
      world.solids.push_back(PutOn(world.ground, Painted(table, albedo), place, DrawAngle(random)));
    } else {
      const double high_m = Chance(random, 0.6) ? 0.711 : 0.457;  // 28 and 18 in
      PutOn(world, MakeTrafficCone(0, 0, high_m), place, DrawAngle(random));
    }
  }
}

}  // namespace palace
