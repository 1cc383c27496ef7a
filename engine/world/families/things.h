// Things people leave or use: posts, fences, masts, vehicles, walkers. Each stands at the origin of
// a frame of its own, along north where it has a length, and goes onto the ground with PutOn.
#pragma once

#include <vector>

#include "engine/core/random.h"
#include "engine/world/families/drawing.h"

namespace palace {

Solid MakePost(double thick_m, double tall_m, double albedo);
/// Posts from a place to another and wires between them, on the ground.
struct Fence {
  double spacing_m = 3;
  double thick_m = 0.08;
  double tall_m = 1.1;
  int wires = 3;
  double wire_m = 0.004;
  double albedo = 0.3;
};
void AddFence(World& world, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m,
              const Fence& fence);
/// A pole with three guys to the ground.
void AddGuyedMast(World& world, RandomStream& random, const Eigen::Vector2d& place_m, double tall_m,
                  double thick_m, double guy_m);
/// Body, cabin and wheels of a passenger car.
std::vector<Solid> MakeCar(RandomStream& random);
/// A lorry or van: cab and box.
std::vector<Solid> MakeVan(RandomStream& random);
/// Legs, body, head.
std::vector<Solid> MakeWalker(RandomStream& random);
/// Two wings of about a metre, gliding at the height given.
Solid MakeBird(double up_m, double span_m);
/// A lamp on an arm.
std::vector<Solid> MakeStreetLamp(double tall_m);
void SetVelocity(std::vector<Solid>& solids, const Eigen::Vector3d& v_W);

}  // namespace palace
