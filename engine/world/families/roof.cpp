// A flat roof over a street: parapet, vents, ducts, antennas, slanted skylights, and edges.
#include <algorithm>
#include <cmath>

#include "engine/world/families/drawing.h"
#include "engine/world/families/family.h"
#include "engine/world/families/things.h"

namespace palace {
namespace {

using Eigen::Vector2d;

void AddParapet(World& world, RandomStream& random, const Vector2d& low, const Vector2d& high) {
  const double tall_m = random.Uniform(0.25, 0.9), thick_m = random.Uniform(0.15, 0.35);
  const double albedo = random.Uniform(0.4, 0.7);
  const Vector2d size = high - low, middle = (low + high) / 2;
  for (const double north : {low.x(), high.x()}) {
    world.solids.push_back(
        Painted(MakeSlab(north, middle.y(), thick_m, size.y() + thick_m, -0.3, tall_m), albedo));
  }
  for (const double east : {low.y(), high.y()}) {
    world.solids.push_back(Painted(
        MakeSlab(middle.x(), east, size.x() - thick_m, thick_m, -0.3, tall_m), albedo * 0.97));
  }
}

/// A box on feet with a fan, a chimney, or a bent pipe.
void AddVent(World& world, RandomStream& random, const Vector2d& place) {
  const double albedo = random.Uniform(0.35, 0.75), turn = 1.5708 * random.Index(4);
  switch (random.Index(3)) {
    case 0: {
      const double size_m = random.Uniform(0.7, 2.2), tall_m = random.Uniform(0.6, 1.5);
      PutOn(world,
            {Painted(MakeSlab(0, 0, size_m, 0.8 * size_m, 0.12, tall_m), albedo),
             Painted(MakeSlab(0.3 * size_m, 0, 0.1, 0.7 * size_m, 0, 0.12), 0.2),
             Painted(MakeSlab(-0.3 * size_m, 0, 0.1, 0.7 * size_m, 0, 0.12), 0.2),
             Painted(Moved({Cylinder{0.5 * size_m, 0.08}}, 0, {0, 0, -tall_m}), 0.1)},
            place, turn);
      break;
    }
    case 1: {
      const double size_m = random.Uniform(0.3, 0.8), tall_m = random.Uniform(0.5, 1.6);
      PutOn(world,
            {Painted({Box{size_m, size_m, tall_m}}, albedo),
             Painted(MakeSlab(0, 0, 1.2 * size_m, 1.2 * size_m, tall_m, tall_m + 0.07), 0.5)},
            place, turn);
      break;
    }
    default: {
      const double thick_m = random.Uniform(0.08, 0.25), tall_m = random.Uniform(0.2, 0.9);
      PutOn(world,
            {MakePost(thick_m, tall_m, albedo),
             Painted(Moved({Cone{2.2 * thick_m, 0.8 * thick_m}}, 0, {0, 0, -tall_m}), albedo)},
            place, turn);
    }
  }
}

/// A lean-to of glass or tiles.
void AddSlantedPart(World& world, RandomStream& random, const Vector2d& place) {
  const double length_m = random.Uniform(1.5, 5), width_m = random.Uniform(1.2, 6);
  const double slope = random.Uniform(0.17, 0.6);
  const double albedo = random.Uniform(0.15, 0.6);
  world.solids.push_back(PutOn(world.ground,
                               Painted(MakeWedge(0, 0, length_m, width_m, slope), albedo), place,
                               1.5708 * random.Index(4)));
}

}  // namespace

void DrawRoof(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  const Vector2d low = {random.Uniform(-3, 4), random.Uniform(-18, -9)};
  const Vector2d high = {random.Uniform(24, 40), random.Uniform(9, 18)};
  const double drop_m = random.Uniform(4, 12);
  Material street = DrawMaterial(random, GroundTexture::kAsphalt, {1.45, 1.5}, {0.4, 0.9});
  street.albedo = random.Uniform(0.2, 0.35);
  world.ground.material = street;
  const bool ballast = Chance(random, 0.4);
  Material deck = ballast ? DrawMaterial(random, GroundTexture::kGravel, {0.7, 0.78}, {0.4, 1})
                          : DrawMaterial(random, GroundTexture::kConcrete, {0.2, 0.6}, {0.3, 1.2});
  deck.albedo = random.Uniform(0.3, 0.65);
  deck.turn_rad = 0;
  world.ground.patches.push_back({{low, {low.x(), high.y()}, high, {high.x(), low.y()}}, deck});
  for (int i = random.Index(4); i > 0; --i) {
    const Vector2d place = {random.Uniform(6, 30), random.Uniform(-9, 9)};
    Material patch = DrawMaterial(random, GroundTexture::kCloud, {0.3, 0.5}, {0.1, 0.4});
    patch.albedo = deck.albedo * random.Uniform(0.7, 1.1);  // felt where it was mended
    const Vector2d end = place + Vector2d(random.Uniform(1, 4), 0);
    world.ground.patches.push_back(StripPatch(place, end, random.Uniform(0.8, 3), patch));
  }
  const double fall = random.Uniform(0.005, 0.03), fall_course = DrawAngle(random);
  const double sag_m = random.Uniform(0.002, 0.015);
  const std::uint64_t seed = random.NextBits();
  world.ground.relief = ReliefOf([=](double n, double e) {
    const double inside_m = std::min({n - low.x(), high.x() - n, e - low.y(), high.y() - e});
    const double deck_m = fall * (std::cos(fall_course) * (n - 15) + std::sin(fall_course) * e) +
                          sag_m * FractalNoise(n, e, seed, 6, 1, 1);
    const double on = WallShare(inside_m, 0.07);
    return on * deck_m - (1 - on) * drop_m;
  });
  if (Chance(random, 0.85)) {
    AddParapet(world, random, low, high);
  }
  const auto inside = [&](const Vector2d& place, double margin_m) {
    return place.x() > low.x() + margin_m && place.x() < high.x() - margin_m &&
           place.y() > low.y() + margin_m && place.y() < high.y() - margin_m;
  };
  for (const Vector2d& place : DrawPlaces(random, 3 + random.Index(22), 2.5)) {
    if (inside(place, 1.2)) {
      AddVent(world, random, place);
    }
  }
  for (const Vector2d& place : DrawPlaces(random, random.Index(6), 6)) {
    if (inside(place, 3)) {
      AddSlantedPart(world, random, place);
    }
  }
  for (const Vector2d& place : DrawPlaces(random, random.Index(5), 5)) {
    if (inside(place, 4)) {
      const double tall_m = random.Uniform(1.5, 5), thick_m = random.Uniform(0.03, 0.08);
      AddGuyedMast(world, random, place, tall_m, thick_m, random.Uniform(0.004, 0.01));
    }
  }
  for (int i = random.Index(4); i > 0; --i) {
    const double north = random.Uniform(low.x() + 2, high.x() - 2),
                 thick_m = random.Uniform(0.05, 0.3);
    const double from = random.Uniform(low.y() + 1, 0), to = random.Uniform(0, high.y() - 1);
    const double up_m = world.ground.Height(north, 0) + 0.1 + thick_m / 2;
    world.solids.push_back(
        Painted(MakeRod({north, from, -up_m}, {north, to, -up_m}, thick_m), 0.55));
  }
}

}  // namespace palace
