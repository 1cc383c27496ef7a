// A meadow with what lies below it: holes, ditches, drains with steep walls, a strip of furrows.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/world/families/drawing.h"
#include "engine/world/families/family.h"

namespace palace {
namespace {

struct Hole {
  Blob outline;
  double depth_m;
};
struct Ditch {
  Course course;
  double width_m, depth_m;
  double bank_m;  ///< width of its sloping side; a drain has none
};
struct Furrows {
  Blob field;
  double course_rad, apart_m, depth_m;
};

}  // namespace

void DrawDitches(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material grass = DrawMaterial(random, GroundTexture::kGrass, {0.8, 1.2}, {0.5, 1.2});
  grass.albedo = random.Uniform(0.28, 0.48);
  Material earth = DrawMaterial(random, GroundTexture::kSoil, {0.7, 1.1}, {0.6, 1.3});
  earth.albedo = random.Uniform(0.2, 0.4);
  world.ground.material = grass;

  std::vector<Hole> holes;
  for (const Eigen::Vector2d& place : DrawPlaces(random, 3 + random.Index(30), 1.2)) {
    const double radius_m = random.Uniform(0.15, 0.5), depth_m = random.Uniform(0.2, 0.5);
    holes.push_back({Blob(random, place, radius_m, 0.15), depth_m});
    if (Chance(random, 0.7)) {
      world.ground.patches.push_back(Blob(holes.back().outline).Patch(earth));
    }
  }
  std::vector<Ditch> ditches;
  for (int i = random.Index(4); i > 0; --i) {
    const Eigen::Vector2d from = DrawPlace(random);
    const double heading = DrawAngle(random), length_m = random.Uniform(5, 30);
    const bool drain = Chance(random, 0.4);
    const double width_m = drain ? random.Uniform(0.3, 0.5) : random.Uniform(0.4, 1.0);
    const double depth_m = random.Uniform(0.2, 0.5);
    const double bank_m = drain ? 0.07 : random.Uniform(0.07, 0.3);
    ditches.push_back({Course(random, from, heading, length_m, drain ? 1 : 5, drain ? 0 : 0.8),
                       width_m, depth_m, bank_m});
    ditches.back().course.Paint(world.ground, width_m, earth);
  }
  std::optional<Furrows> furrows;
  if (Chance(random, 0.5)) {
    const Eigen::Vector2d place = DrawPlace(random);
    Blob field(random, place, random.Uniform(4, 9), 0.25);
    world.ground.patches.push_back(field.Patch(earth));
    const double course_rad = DrawAngle(random), apart_m = random.Uniform(0.5, 0.9);
    furrows = Furrows{field, course_rad, apart_m, random.Uniform(0.2, 0.3)};
  }
  const double rough_m = DrawLog(random, {0.004, 0.02});
  const std::uint64_t seed = random.NextBits();
  constexpr double kWall_m = 0.07;  // about a cell
  world.ground.relief = ReliefOf([=](double n, double e) {
    double down_m = 0;
    for (const Hole& hole : holes) {
      down_m = std::max(down_m, hole.depth_m * WallShare(hole.outline.Inside(n, e), kWall_m));
    }
    for (const Ditch& ditch : ditches) {
      const double inside_m = (ditch.width_m - ditch.bank_m) / 2 - ditch.course.Distance(n, e);
      down_m = std::max(down_m, ditch.depth_m * WallShare(inside_m, ditch.bank_m));
    }
    if (furrows) {
      const double across = std::cos(furrows->course_rad) * n + std::sin(furrows->course_rad) * e;
      const double wave = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * across / furrows->apart_m);
      down_m = std::max(
          down_m, furrows->depth_m * wave * WallShare(furrows->field.Inside(n, e) - 0.3, 0.6));
    }
    return rough_m * FractalNoise(n, e, seed, 6, 0.3, 0.8) - down_m;
  });
}

}  // namespace palace
