// Plants: many small leaves, each a triangle, with gaps through which the ground is seen.
#pragma once

#include "engine/core/random.h"
#include "engine/world/families/drawing.h"

namespace palace {

struct Foliage {
  double radius_m = 0.5;  ///< sideways
  double height_m = 0.6;  ///< of the lump of leaves
  double foot_m = 0;      ///< of the lump over the ground
  double leaf_m = 0.06;   ///< longest side of a leaf
  int leaves = 400;
  double irregular = 0.35;  ///< how far lobes reach in and out
};
/// Leaves nearer to the outside than to the middle. Soft.
Solid MakeFoliage(RandomStream& random, const Foliage& foliage);

/// Grass or reed: blades that stand up and lean over. Soft.
Solid MakeTuft(RandomStream& random, double radius_m, double height_m, int blades);

struct Tree {
  double height_m = 8;
  double crown_m = 2.5;  ///< radius
  double trunk_m = 0.3;  ///< thickness
  int leaves = 1500;
  double leaf_m = 0.25;  ///< twigs with their leaves
};
/// Trunk, three boughs and a crown.
std::vector<Solid> MakeTree(RandomStream& random, const Tree& tree);
/// A cone of drooping twigs.
std::vector<Solid> MakeConifer(RandomStream& random, const Tree& tree);

}  // namespace palace
