// Fields of known shapes for `evaluate site-shapes`: what stands where, and how much of the ground
// the hovering rig sees whole.
//
// Heights are above level ground at the origin of W, up-positive. Same view, number and seed: same
// field.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/experiments/field_trial.h"
#include "engine/world/ray_pictures.h"

namespace palace {

enum class ShapeFieldKind {
  kObjects,   ///< twelve small boxes, cylinders and wedges on level ground
  kSlope,     ///< an even slope of 0 to 7 degrees, nothing on it
  kHouse,     ///< a roof with parapet, vents and antennas; a table; a ramp
  kPlatform,  ///< a bare raised top on which the lander has room; a ramp
};
const char* NameOf(ShapeFieldKind kind);

/// One thing on the field: some of the world's solids.
struct PlacedShape {
  std::string name;  ///< "cube 6 in"
  std::size_t first_solid = 0;
  std::size_t solids = 1;
  double slope_rad = 0;  ///< of its top
};

struct ShapeField {
  ShapeFieldKind kind = ShapeFieldKind::kObjects;
  World world;
  std::vector<PlacedShape> shapes{};
};

/// `number` counts the fields of one kind: the shapes take turns from field to field.
ShapeField MakeShapeField(ShapeFieldKind kind, const HoverView& view, int number,
                          std::uint64_t seed);

/// Horizontal distance from a place to the shape's outline, metres; 0 over it.
double DistanceToShape(const ShapeField& field, const PlacedShape& shape, double north_m,
                       double east_m);
/// How far inside the outline of its first solid a place lies, metres; 0 outside.
double DepthInShape(const ShapeField& field, const PlacedShape& shape, double north_m,
                    double east_m);

/// Level ground that both cameras see in every frame of a nadir hover heading north, but for rare
/// excursions: the picture's footprint less drift and attitude motion.
struct GroundInView {
  double north_min_m = 0, north_max_m = 0, east_min_m = 0, east_max_m = 0;
};
GroundInView GroundSeenBy(const HoverView& view);

}  // namespace palace
