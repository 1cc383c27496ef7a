// A street between houses: pavements, parked and moving cars, lamps, wires across, bins, people.
#include <cmath>

#include "engine/world/families/drawing.h"
#include "engine/world/families/family.h"
#include "engine/world/families/things.h"

namespace palace {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The street lies along north until all is turned.
struct Street {
  double half_m;      ///< from its middle to the kerbs
  double pavement_m;  ///< width of each
  double from_m = -10, to_m = 56;
};

void AddHouses(World& world, RandomStream& random, const Street& street) {
  for (const double side : {-1.0, 1.0}) {
    double north = street.from_m;
    while (north < street.to_m) {
      const double length_m = random.Uniform(8, 16), deep_m = random.Uniform(8, 14);
      const double middle_m = side * (street.half_m + street.pavement_m + deep_m / 2);
      const double tall_m = random.Uniform(3.5, 7);
      if (Chance(random, 0.75)) {
        const double wall = random.Uniform(0.3, 0.65);
        world.solids.push_back(Painted(
            MakeSlab(north + length_m / 2, middle_m, length_m, deep_m, -0.1, tall_m), wall));
        world.solids.push_back(Painted(MakeSlab(north + length_m / 2, middle_m, length_m - 0.6,
                                                deep_m - 0.6, tall_m, tall_m + 0.1),
                                       random.Uniform(0.15, 0.4)));
        for (double window = 1.5; window < length_m - 1; window += 2.4) {
          const double face_m = middle_m - side * (deep_m / 2 + 0.01);
          world.solids.push_back(Painted(MakeSlab(north + window, face_m, 1.1, 0.06, 1, 2.4), 0.1));
        }
      }
      north += length_m;
    }
  }
}

void AddPavements(World& world, RandomStream& random, const Street& street) {
  const double high_m = random.Uniform(0.1, 0.16), albedo = random.Uniform(0.4, 0.6);
  for (const double side : {-1.0, 1.0}) {
    const double middle_m = side * (street.half_m + street.pavement_m / 2);
    for (double north = street.from_m; north < street.to_m; north += 2) {
      world.solids.push_back(
          Painted(MakeSlab(north + 1, middle_m, 1.985, street.pavement_m, -0.1, high_m),
                  albedo * random.Uniform(0.92, 1.06)));
    }
  }
}

void AddTraffic(World& world, RandomStream& random, const Street& street) {
  for (const double side : {-1.0, 1.0}) {
    const double turn = side < 0 ? 3.1416 : 0;
    for (double north = random.Uniform(2, 6); north < 45; north += random.Uniform(5.5, 12)) {
      if (Chance(random, 0.5)) {
        const std::vector<Solid> car = Chance(random, 0.85) ? MakeCar(random) : MakeVan(random);
        const Vector2d place(north, side * (street.half_m - 1.15));
        PutOn(world, car, place, turn + random.Uniform(-0.03, 0.03));
      }
    }
  }
  if (Chance(random, 0.5)) {
    std::vector<Solid> car = MakeCar(random);
    const double lane = Chance(random, 0.5) ? 1 : -1;
    const Vector2d place = {random.Uniform(5, 35), lane * 1.6};
    std::vector<Solid> turned;
    for (const Solid& part : car) {
      turned.push_back(Moved(part, lane < 0 ? 3.1416 : 0, Vector3d::Zero()));
    }
    SetVelocity(turned, {lane * random.Uniform(2, 12), 0, 0});
    PutOn(world, turned, place);
  }
  for (int i = random.Index(6); i > 0; --i) {
    std::vector<Solid> walker = MakeWalker(random);
    const double side = Chance(random, 0.5) ? 1 : -1, speed_mps = random.Uniform(-1.5, 1.5);
    SetVelocity(walker, {speed_mps, 0, 0});
    const double east = side * (street.half_m + random.Uniform(-2, 0.8) * street.pavement_m);
    const Vector2d place = {random.Uniform(4, 40), east};
    PutOn(world, walker, place);
  }
}

void AddFurniture(World& world, RandomStream& random, const Street& street) {
  const double kerb_m = street.half_m + 0.35, apart_m = random.Uniform(9, 16);
  const double tall_m = random.Uniform(5, 8);
  const bool wires = Chance(random, 0.6);
  const double start_m = random.Uniform(-2, 6);
  for (double north = start_m; north < 50; north += apart_m) {
    PutOn(world, MakeStreetLamp(tall_m), {north, -kerb_m}, 0);
    PutOn(world, {MakePost(0.22, tall_m, 0.3)}, {north, kerb_m}, 0);
    if (wires) {
      world.solids.push_back(Painted(
          MakeRod({north, -kerb_m, -0.9 * tall_m}, {north, kerb_m, -0.85 * tall_m}, 0.012), 0.15));
    }
    if (north > start_m) {
      for (const double up : {0.93, 0.98}) {
        world.solids.push_back(Painted(
            MakeRod({north - apart_m, kerb_m, -up * tall_m}, {north, kerb_m, -up * tall_m}, 0.015),
            0.12));
      }
    }
  }
  for (int i = 2 + random.Index(8); i > 0; --i) {
    const double side = Chance(random, 0.5) ? 1 : -1, north = random.Uniform(3, 40);
    const double thick_m = random.Uniform(0.1, 0.5), high_m = random.Uniform(0.5, 1.1);
    const double albedo = random.Uniform(0.1, 0.6);
    PutOn(world, {MakePost(thick_m, high_m, albedo)}, {north, side * (street.half_m + 0.7)}, 0);
  }
}

void PaintStreet(World& world, RandomStream& random, const Street& street) {
  Material paint = DrawMaterial(random, GroundTexture::kPaint, {0.5, 0.8}, {0.5, 1});
  paint.albedo = random.Uniform(0.55, 0.8);
  for (double north = street.from_m; north < street.to_m; north += 6) {
    world.ground.patches.push_back(
        StripPatch({north, 0.0}, {north + 3, 0.0}, random.Uniform(0.1, 0.16), paint));
  }
  if (Chance(random, 0.7)) {
    const double north = random.Uniform(8, 30);
    for (double east = -street.half_m + 0.5; east < street.half_m; east += 1) {
      world.ground.patches.push_back(StripPatch({north, east}, {north + 3, east}, 0.5, paint));
    }
  }
  Material mended = *world.ground.material;
  mended.albedo *= 0.7;
  mended.seed = random.NextBits();
  Material iron = mended;
  iron.albedo = 0.15;
  for (int i = random.Index(5); i > 0; --i) {
    const double north = random.Uniform(2, 40), east = random.Uniform(-3, 3);
    world.ground.patches.push_back(
        StripPatch({north, east}, {north + random.Uniform(1, 6), east}, 0.9, mended));
    world.ground.patches.push_back(DiscPatch(north + 3, east + 1, 0.33, iron));
  }
}

}  // namespace

void DrawCity(World& world, RandomStream& random) {
  world.sun = DrawSun(random);
  Material asphalt = DrawMaterial(random, GroundTexture::kAsphalt, {0.4, 0.7}, {0.4, 1.2});
  asphalt.albedo = random.Uniform(0.2, 0.4);
  world.ground.material = asphalt;
  const Street street{random.Uniform(5, 9), random.Uniform(2, 4)};
  PaintStreet(world, random, street);
  AddPavements(world, random, street);
  AddHouses(world, random, street);
  AddFurniture(world, random, street);
  AddTraffic(world, random, street);
  // All of it turned about the vehicle's start and shifted aside.
  const double turn = random.Uniform(-0.35, 0.35), aside_m = random.Uniform(-4, 4);
  const RigidTransform X_WS = Upright({0, aside_m, 0}, turn);
  for (Solid& solid : world.solids) {
    solid.X_WO = X_WS * solid.X_WO;
    solid.v_WO = X_WS.R * solid.v_WO;
  }
  for (GroundPatch& patch : world.ground.patches) {
    for (Vector2d& corner : patch.outline_m) {
      corner = (X_WS * Vector3d(corner.x(), corner.y(), 0)).head<2>();
    }
  }
}

}  // namespace palace
