// Rectangles, squares, cylinders and wedges of 4 to 24 in on a floor like a patterned carpet: the
// obstacles of Hintze 2004, 4.4.
#include "engine/world/families/drawing.h"
#include "engine/world/families/family.h"

namespace palace {
namespace {

Solid MakeObstacle(RandomStream& random) {
  constexpr double kInch_m = 0.0254;
  const double high_m = kInch_m * (4 + 2 * random.Index(11)), albedo = random.Uniform(0.15, 0.85);
  const double size_m = random.Uniform(0.12, 1.2);
  switch (random.Index(4)) {
    case 0:
      return Painted(MakeBox(0, 0, size_m * random.Uniform(1.5, 3.5), size_m, high_m), albedo);
    case 1:
      return Painted(MakeBox(0, 0, size_m, size_m, high_m), albedo);
    case 2:
      return Painted({Cylinder{size_m, high_m}}, albedo);
    default:
      return Painted(MakeWedge(0, 0, 2 * size_m, 1.5 * size_m, random.Uniform(0.09, 0.6)), albedo);
  }
}

}  // namespace

void DrawObstacles(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material carpet = DrawMaterial(random, GroundTexture::kCloud, {0.5, 1.4}, {0.3, 1.1});
  carpet.albedo = random.Uniform(0.3, 0.6);
  world.ground.material = carpet;
  for (const Eigen::Vector2d& place : DrawPlaces(random, 10 + random.Index(60), 1)) {
    const Solid obstacle = MakeObstacle(random);
    world.solids.push_back(PutOn(world.ground, obstacle, place, DrawAngle(random)));
  }
}

}  // namespace palace
