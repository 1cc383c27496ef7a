// The height that a screen tells of a descent, and by whom.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/model/snapshot.h"

namespace palace {

/// Of the skid centre, m, up-positive. NaN: nobody tells it.
struct ToldHeight {
  enum class By : std::uint8_t {
    kEstimate,  ///< in force: what limits and guards ask; above the site
    kGps,       ///< above the site
    kLaser,     ///< above the ground under the beam
  };
  By by = By::kEstimate;
  double height_m = std::numeric_limits<double>::quiet_NaN();
};

/// By the estimate in force; where it is unknown (vision, and no pictures) by the newest GPS, then
/// by the laser: others still tell it.
ToldHeight HeightTold(const EngineSnapshot& snapshot);

}  // namespace palace
