// Fields of one kind of thing of the limits' size, many a field: what `evaluate things` looks for.
//
// Each field draws its ground anew: material, texture, contrast, light, gentle roughness. Things
// stand or gape on a jittered lattice, so far apart that none hides or touches another. Frames: W,
// metres, heights up-positive. Same kind, size and seed: same field.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Dense>

#include "engine/world/world.h"

namespace palace {

enum class ThingKind {
  kNone,  ///< bare ground, for false alarms
  kHole,  ///< round, steep, 0.4 m wide and 0.2 m deep
  kRock,  ///< 0.15 m high, 1 to 1.6 times as wide
  kKerb,  ///< 0.15 m high, 0.12 to 0.3 m wide, 1.2 m long
  kPost,  ///< 8 cm thick, 0.8 to 1.2 m high
  kBush,  ///< leaves, 0.5 to 0.8 m wide, 0.3 to 0.5 m high
  kSlab   ///< flat top, 0.15 m high, 0.6 to 1 m wide
};
inline constexpr ThingKind kThingKinds[] = {ThingKind::kNone, ThingKind::kHole, ThingKind::kRock,
                                            ThingKind::kKerb, ThingKind::kPost, ThingKind::kBush,
                                            ThingKind::kSlab};
const char* NameOf(ThingKind kind);

struct ThingField {
  World world;
  std::vector<Eigen::Vector2d> places_m;  ///< of the things' middles
  double reach_m = 0;                     ///< no thing lies farther from its middle
};

/// `size` times the sizes above.
ThingField MakeThingField(ThingKind kind, double size, std::uint64_t seed);

}  // namespace palace
