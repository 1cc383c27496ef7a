#include "engine/experiments/thing_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/world/families/drawing.h"
#include "engine/world/families/plants.h"
#include "engine/world/families/stones.h"
#include "engine/world/families/things.h"

namespace palace {
namespace {

constexpr double kApart_m = 3;
constexpr double kReliefSize_m = 40, kReliefNorth_m = 10;

Material DrawGround(RandomStream& random) {
  struct Kind {
    GroundTexture texture;
    Range albedo;
  };
  constexpr Kind kKinds[] = {
      {GroundTexture::kGrass, {0.25, 0.45}},   {GroundTexture::kSoil, {0.25, 0.45}},
      {GroundTexture::kGravel, {0.3, 0.55}},   {GroundTexture::kAsphalt, {0.2, 0.4}},
      {GroundTexture::kConcrete, {0.4, 0.65}}, {GroundTexture::kSand, {0.4, 0.65}}};
  const Kind& kind = kKinds[random.Index(std::size(kKinds))];
  Material material = DrawMaterial(random, kind.texture, {0.7, 1.6}, {0.6, 1.4});
  material.albedo = Draw(random, kind.albedo);
  return material;
}

std::vector<Eigen::Vector2d> DrawLattice(RandomStream& random) {
  std::vector<Eigen::Vector2d> places;
  for (double n = kReliefNorth_m - kReliefSize_m / 2 + 2;
       n < kReliefNorth_m + kReliefSize_m / 2 - 2; n += kApart_m) {
    for (double e = -kReliefSize_m / 2 + 2; e < kReliefSize_m / 2 - 2; e += kApart_m) {
      const double north = n + random.Uniform(-0.6, 0.6), east = e + random.Uniform(-0.6, 0.6);
      places.emplace_back(north, east);
    }
  }
  return places;
}

/// Depth of holes with steep walls at a place, quickly among many.
double HoleDepth(const std::vector<Blob>& holes, double depth_m, double north_m, double east_m) {
  constexpr double kWall_m = 0.05;
  for (const Blob& hole : holes) {
    if ((hole.middle_m() - Eigen::Vector2d(north_m, east_m)).cwiseAbs().maxCoeff() <
        2 * hole.radius_m()) {
      return depth_m * WallShare(hole.Inside(north_m, east_m), kWall_m);
    }
  }
  return 0;
}

/// About the origin; how far it reaches goes into `reach_m`.
Solid DrawThing(ThingKind kind, double size, RandomStream& random, double& reach_m) {
  const double albedo = random.Uniform(0.15, 0.6);
  switch (kind) {
    case ThingKind::kRock: {
      const double high_m = 0.15 * size, wide_m = high_m * random.Uniform(1, 1.6);
      reach_m = std::max(reach_m, wide_m);
      const Solid stone = StoneMaker().Make(random, wide_m,
                                            {.flatness = {high_m / wide_m, high_m / wide_m},
                                             .slimness = {0.7, 1},
                                             .facets = 8 + random.Index(8),
                                             .sunk = {0, 0}});
      return Painted(stone, albedo);
    }
    case ThingKind::kKerb: {
      const double wide_m = random.Uniform(0.12, 0.3);
      reach_m = std::max(reach_m, 0.65 * size);
      return Painted({Box{1.2 * size, wide_m * size, 0.15 * size}}, albedo);
    }
    case ThingKind::kPost:
      reach_m = std::max(reach_m, 0.06 * size);
      return MakePost(0.08 * size, random.Uniform(0.8, 1.2), albedo);
    case ThingKind::kBush: {
      Foliage foliage{.radius_m = size * random.Uniform(0.25, 0.4),
                      .height_m = size * random.Uniform(0.3, 0.5)};
      foliage.leaves = 150 + random.Index(250);
      reach_m = std::max(reach_m, 1.4 * foliage.radius_m);
      return MakeFoliage(random, foliage);
    }
    default: {
      const double north_m = size * random.Uniform(0.6, 1), east_m = size * random.Uniform(0.6, 1);
      reach_m = std::max(reach_m, std::hypot(north_m, east_m) / 2);
      return Painted({Box{north_m, east_m, 0.15 * size}}, albedo);
    }
  }
}

}  // namespace

const char* NameOf(ThingKind kind) {
  static constexpr const char* kNames[] = {"none", "hole", "rock", "kerb", "post", "bush", "slab"};
  return kNames[static_cast<int>(kind)];
}

ThingField MakeThingField(ThingKind kind, double size, std::uint64_t seed) {
  RandomStream random(seed, std::string("field of things: ") + NameOf(kind));
  ThingField field;
  World& world = field.world;
  world.name = NameOf(kind);
  world.sun = DrawSun(random);
  world.ground.material = DrawGround(random);
  const double rough_m = DrawLog(random, {0.003, 0.015});
  const std::uint64_t rough_seed = random.NextBits();
  if (kind != ThingKind::kNone) {
    field.places_m = DrawLattice(random);
  }
  std::vector<Blob> holes;
  if (kind == ThingKind::kHole) {
    Material earth = DrawMaterial(random, GroundTexture::kSoil, {0.7, 1.1}, {0.6, 1.3});
    earth.albedo = random.Uniform(0.2, 0.4);
    for (const Eigen::Vector2d& place : field.places_m) {
      holes.emplace_back(random, place, 0.2 * size, 0.1);
      if (Chance(random, 0.6)) {
        world.ground.patches.push_back(holes.back().Patch(earth));
      }
    }
    field.reach_m = 0.23 * size;
  }
  world.ground.relief = ReliefOf(
      [&](double n, double e) {
        return rough_m * FractalNoise(n, e, rough_seed, 6, 0.4, 0.9) -
               HoleDepth(holes, 0.2 * size, n, e);
      },
      10, kReliefSize_m, kReliefNorth_m);
  if (kind != ThingKind::kNone && kind != ThingKind::kHole) {
    for (const Eigen::Vector2d& place : field.places_m) {
      const Solid thing = DrawThing(kind, size, random, field.reach_m);
      world.solids.push_back(PutOn(world.ground, thing, place, DrawAngle(random)));
    }
  }
  return field;
}

}  // namespace palace
