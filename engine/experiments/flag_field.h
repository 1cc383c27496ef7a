// A field seen from a hover with one thing in it that heights alone do not show, and what the
// SLAD flags. For `evaluate site-flags`.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/core/result.h"
#include "engine/experiments/field_trial.h"
#include "engine/world/ray_pictures.h"

namespace palace {

inline constexpr double kFlagInterval_s = 0.2;  ///< between frames

struct FlagField {
  World world;
  HoverView view;
  double middle_north_m = 0;  ///< where the camera looks
};
/// Five boxes and five traffic cones around the middle of the picture.
FlagField MakeFlagField(GroundTexture texture, double height_m, double tilt_rad,
                        std::uint64_t seed);

/// The map after `frames` frames of the field's world, or of one with things added that may move.
/// `ground` is the field's own bake.
Result<std::shared_ptr<const ElevationMap>> FlagsOfField(const FlagField& field, int frames,
                                                         const BakedGround& ground,
                                                         std::uint64_t seed);

}  // namespace palace
