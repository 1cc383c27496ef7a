// A field seen from a hover with one thing in it that heights alone do not show, and what the
// SLAD flags. For `evaluate site-flags`.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/experiments/field_trial.h"
#include "engine/world/painted_things.h"

namespace palace {

/// At most one of them.
struct FlagThing {
  std::optional<PaintedWire> wire{};
  std::optional<PaintedPool> pool{};
  /// A box 0.5 m wide and 1.6 m tall that starts here and moves east.
  std::optional<Eigen::Vector2d> walker{};
  double walker_mps = 0;
};

struct FlagField {
  StereoWorld world;
  HoverView view;
  double middle_north_m = 0;  ///< where the camera looks
};
/// Five boxes and five traffic cones around the middle of the picture.
FlagField MakeFlagField(GroundTexture texture, double height_m, double tilt_rad,
                        std::uint64_t seed);

/// The map after `frames` frames, 0.2 s apart. `ground` is the field's own bake.
Result<std::shared_ptr<const ElevationMap>> FlagsOfField(const FlagField& field,
                                                         const FlagThing& thing, int frames,
                                                         const BakedGround& ground,
                                                         std::uint64_t seed);
BakedGround BakeFlagField(const FlagField& field, int frames, std::uint64_t seed);

}  // namespace palace
