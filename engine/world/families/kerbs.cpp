// Asphalt between pavements: kerbs of 0.10 to 0.18 m, walls of 0.2 to 0.3 m, flights of steps, and
// painted lines, which are flat.
#include <cmath>
#include <numbers>

#include "engine/world/families/drawing.h"
#include "engine/world/families/family.h"

namespace palace {
namespace {

using Eigen::Vector2d;

/// Slabs along a strip, each a hair above or below the next as they are laid.
void AddPavement(World& world, RandomStream& random, double turn, double aside_m, double width_m,
                 double high_m) {
  const double albedo = random.Uniform(0.45, 0.7);
  for (double north = -12; north < 52; north += 8) {
    Solid slab =
        MakeSlab(north + 4, aside_m, 7.99, width_m, -0.2, high_m + random.Uniform(-0.002, 0.002));
    world.solids.push_back(Moved(Painted(slab, albedo), turn, Eigen::Vector3d::Zero()));
  }
  for (const double edge : {-1.0, 1.0}) {
    for (double north = -12; north < 52; north += 1) {
      Solid stone =
          MakeSlab(north + 0.5, aside_m + edge * width_m / 2, 0.99, 0.13, -0.2, high_m + 0.004);
      world.solids.push_back(
          Moved(Painted(stone, albedo * random.Uniform(0.8, 1.1)), turn, Eigen::Vector3d::Zero()));
    }
  }
}

void AddSteps(World& world, RandomStream& random, const Vector2d& place) {
  const int steps = 2 + random.Index(4);
  const double rise_m = random.Uniform(0.14, 0.18), tread_m = random.Uniform(0.28, 0.4);
  const double width_m = random.Uniform(1.5, 4), turn = DrawAngle(random);
  const double albedo = random.Uniform(0.4, 0.65);
  std::vector<Solid> flight;
  for (int i = 0; i < steps; ++i) {
    const double length_m = (steps - i) * tread_m + 1;
    flight.push_back(Painted(
        MakeSlab(i * tread_m + length_m / 2, 0, length_m, width_m, i * rise_m, (i + 1) * rise_m),
        albedo * (1 - 0.03 * i)));
  }
  PutOn(world, flight, place, turn);
}

}  // namespace

void DrawKerbs(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material asphalt = DrawMaterial(random, GroundTexture::kAsphalt, {0.8, 1.3}, {0.5, 1.3});
  asphalt.albedo = random.Uniform(0.2, 0.42);
  world.ground.material = asphalt;
  const double turn = random.Uniform(-0.9, 0.9);
  const double heading = turn;
  const Vector2d along(std::cos(heading), std::sin(heading)), across(-along.y(), along.x());

  double aside_m = random.Uniform(-16, -9);
  while (aside_m < 18) {
    const double width_m = random.Uniform(1.2, 4);
    AddPavement(world, random, turn, aside_m, width_m, random.Uniform(0.10, 0.18));
    aside_m += width_m + random.Uniform(6, 13);
  }
  for (int i = 2 + random.Index(4); i > 0; --i) {
    const double at_m = random.Uniform(-12, 12), width_m = random.Uniform(0.08, 0.3);
    Material paint = DrawMaterial(random, GroundTexture::kPaint, {0.8, 1.2}, {0.5, 1});
    paint.albedo = random.Uniform(0.6, 0.85);
    const bool dashed = Chance(random, 0.5);
    const Vector2d from = at_m * across - 8 * along;
    for (double north = 0; north < 56; north += dashed ? 9 : 56) {
      world.ground.patches.push_back(StripPatch(
          from + north * along, from + (north + (dashed ? 3 : 56)) * along, width_m, paint));
    }
  }
  for (const Vector2d& place : DrawPlaces(random, random.Index(4), 6)) {
    const double length_m = random.Uniform(3, 10), yaw = Chance(random, 0.5) ? turn : turn + 1.571;
    const double high_m = random.Uniform(0.2, 0.3), thick_m = random.Uniform(0.15, 0.35);
    Solid wall = Painted(MakeBox(0, 0, length_m, thick_m, high_m), random.Uniform(0.3, 0.6));
    world.solids.push_back(PutOn(world.ground, wall, place, yaw));
  }
  for (const Vector2d& place : DrawPlaces(random, random.Index(3), 8)) {
    AddSteps(world, random, place);
  }
  const double rough_m = random.Uniform(0.002, 0.008);
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf(
      [=](double n, double e) { return rough_m * FractalNoise(n, e, seed, 9, 0.5, 1); }, 9);
}

}  // namespace palace
